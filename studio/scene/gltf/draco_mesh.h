// SPDX-License-Identifier: Apache-2.0
// Primitives of KHR_draco_mesh_compression, by libdraco.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "studio/scene/gltf/accessor.h"

namespace penumbra::studio::gltf {

/// The geometry of one compressed primitive, in place of its accessors' data.
class DracoMesh {
  public:
    /// `primitive` is the primitive and `json` its extension's object. Throws PlaceError where the compressed
    /// data is damaged, is not what the primitive's accessors announce, or needs more memory than the budget
    /// has.
    DracoMesh(const JsonView& primitive, const JsonView& json, const Accessors& accessors, Budget& budget);

    const Accessor& indices() const { return indices_.accessor; }
    /// Null where the attribute is not compressed with the others.
    const Accessor* attribute(const std::string& name) const;

  private:
    /// An accessor and the bytes that it reads.
    struct Decoded {
        Bytes bytes;
        Accessor accessor;
    };
    Decoded indices_;
    std::map<std::string, Decoded> attributes_;
};

}  // namespace penumbra::studio::gltf

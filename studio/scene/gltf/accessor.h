// SPDX-License-Identifier: Apache-2.0
// Checked reading of buffers, buffer views and accessors.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studio/scene/gltf/budget.h"
#include "studio/scene/gltf/document.h"

namespace penumbra::studio::gltf {

enum class ComponentType { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

std::size_t sizeOf_bytes(ComponentType type);

struct BufferView {
    std::span<const std::byte> bytes;
    std::uint64_t offset_bytes = 0;  ///< in its buffer
    std::size_t stride_bytes = 0;    ///< 0: tightly packed
};

/// An accessor whose every byte is known to lie within its buffer.
struct Accessor {
    struct Sparse {
        std::vector<std::uint32_t> indices;  ///< strictly increasing, each < count
        std::span<const std::byte> values;   ///< tightly packed
    };

    std::string pointer;
    ComponentType componentType = ComponentType::f32;
    std::string type;            ///< "SCALAR", "VEC3", ...
    std::size_t components = 1;  ///< of one element
    bool normalized = false;
    std::uint64_t count = 0;           ///< elements, >= 1
    std::span<const std::byte> bytes;  ///< from the first element on; empty: all zero
    std::size_t stride_bytes = 0;
    std::optional<Sparse> sparse;
};

/// All of a document's binary data. Everything is validated on construction, used or not.
class Accessors {
  public:
    Accessors(const Document& document, const std::filesystem::path& folder, Budget& budget);

    std::size_t size() const { return accessors_.size(); }
    std::size_t viewCount() const { return views_.size(); }
    const BufferView& view(int index) const { return views_[std::size_t(index)]; }
    const Accessor& operator[](int index) const { return accessors_[std::size_t(index)]; }

  private:
    void readBuffers(const Document& document, const std::filesystem::path& folder, Budget& budget);
    /// The bytes of a buffer that an object's `buffer`, `byteOffset` and `byteLength` name.
    std::span<const std::byte> rangeOf(const JsonView& json, std::uint64_t& offset) const;
    void readViews(const JsonView& root, Budget& budget);
    Accessor readAccessor(const JsonView& json, Budget& budget) const;

    std::vector<std::optional<Bytes>> buffers_;  ///< without a value: neither uri nor GLB chunk
    std::deque<Bytes> decompressed_;             ///< of views that are compressed
    std::vector<BufferView> views_;
    std::vector<Accessor> accessors_;
};

/// Throws PlaceError at `where` unless the accessor has the type and one of the component types.
void requireFormat(const Accessor& accessor, const std::string& where, const std::string& type,
                   std::initializer_list<ComponentType> componentTypes);

/// All components of all elements, finite; integers scaled where the accessor is normalized, converted
/// otherwise.
std::vector<float> readFloats(const Accessor& accessor, Budget& budget);

/// The same as vectors of accessor.components floats.
std::vector<glm::vec2> readVec2s(const Accessor& accessor, Budget& budget);
std::vector<glm::vec3> readVec3s(const Accessor& accessor, Budget& budget);

/// All components of all elements of an accessor of unsigned integers.
std::vector<std::uint32_t> readUnsigned(const Accessor& accessor, Budget& budget);

}  // namespace penumbra::studio::gltf

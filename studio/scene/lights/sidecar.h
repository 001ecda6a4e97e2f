// SPDX-License-Identifier: Apache-2.0
// SCENE.lights.json: the lights of a scene, written by hand. docs/lights.md is the manual,
// docs/lights.schema.json the schema. Names, units and axes are UsdLux's (without `inputs:`).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studio/scene/model_reading.h"
#include "studio/scene/scene.h"

namespace penumbra::studio {

/// The profile of a light, or a luminaire's.
struct SidecarProfile {
    std::string file;  ///< relative to the sidecar's folder
    int line = 0;
    /// The light is the luminaire: its shape and size are those of the file, too.
    bool isLuminaire = false;
    float angleScale = 0;    ///< UsdLux's
    bool normalize = false;  ///< divided by its mean over the sphere
    float turn_deg = 0;      ///< of C0, from +X towards +Y
};

/// A light as the file states it.
struct SidecarLight {
    Light light;  ///< all but what depends on the scene and on other files: its transform, the texture's
                  ///< index, the profile, and the shape of a luminaire
    glm::dmat4 parentFromLight{1};  ///< rigid
    std::string node;               ///< the parent, by name; empty: the coordinates of the scene's file
    bool isInWorld = false;         ///< has Y up whatever the scene's file has: the sun
    /// The parent is the middle of the node's underside, with the world's axes.
    bool isBelow = false;
    std::optional<SidecarProfile> profile;
    std::string textureFile;  ///< relative to the file's folder, or empty
    int nodeLine = 0, textureLine = 0;
};

/// What the file says about the nodes, or the materials, of a name or a pattern.
struct SurfaceRule {
    std::string name;
    std::optional<bool> casts, receives;  ///< unset: as the scene has it
    int line = 0;
};

/// In the order of the file: later ones win. Those of nodes win over those of their materials.
struct SurfaceRules {
    std::vector<SurfaceRule> materials, nodes;
};

struct Sidecar {
    std::string fileName;                             ///< for messages
    ModelReading reading;                             ///< of the scene's file, before all else
    std::optional<std::vector<SidecarLight>> lights;  ///< unset: the scene keeps its own
    SurfaceRules surfaces;
};

/// Parses the text of a sidecar. Whatever is not understood is an InputError of the form "FILE:LINE:
/// PROBLEM": unknown keys, wrong types, values out of range, names that are given twice.
Sidecar parseSidecar(std::string_view json, const std::string& fileName);

/// Reads and parses a file. Throws InputError.
Sidecar readSidecar(const std::filesystem::path& file);

/// The text of a file that parseSidecar reads as `sidecar`. Emission, size and place of a light come back as
/// the same floats; angles and the rotation may differ in the last bit, having been degrees and a quaternion.
std::string formatSidecar(const Sidecar& sidecar);
/// Of one light, as it stands in the file's list.
std::string formatLight(const SidecarLight& light);

/// Where the light's parent is at that moment: its node, the middle of that node's underside, or what a file
/// of the scene's own coordinates is measured from. Throws InputError as applySidecar does.
glm::dmat4 worldFromParent(const SidecarLight& light, const Scene& scene, const SceneMoment& moment);

/// Replaces the scene's lights (if the sidecar has any say in them) and classifies its surfaces, at all
/// times; its `reading` is for whoever opens the scene's file. A light that hangs on a node follows its place
/// and rotation, not its scale. Textures are read from beneath `folder` only. Throws InputError for an
/// unknown or ambiguous node and for a texture that cannot be read.
void applySidecar(Scene& scene, const Sidecar& sidecar, const std::filesystem::path& folder);

}  // namespace penumbra::studio

// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/lights/sidecar_place.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "studio/scene/builtin/placing.h"
#include "studio/scene/sun/sun.h"

namespace penumbra::studio {
namespace {

/// Rotation of the light's frame; a quaternion (x, y, z, w) of length 1, give or take what six digits leave.
glm::dmat4 readRotation(const SidecarReader& reader, const LocatedJson& value) {
    const auto xyzw = reader.vector<4>(value, "'rotation'");
    const float length = glm::length(xyzw);
    if (!(std::abs(length - 1) <= 1e-3f))
        reader.fail(
            value.line,
            fmt::format("'rotation' must be a quaternion [x, y, z, w] of length 1, not {:.4g}", length));
    return glm::mat4_cast(glm::normalize(glm::quat(xyzw.w, xyzw.x, xyzw.y, xyzw.z)));
}

/// Metres, with all of their digits: scenes may lie far from the origin.
glm::dvec3 readPoint(const SidecarReader& reader, const LocatedJson& value, std::string_view what) {
    reader.vector<3>(value, what);
    return {value.items[0].number, value.items[1].number, value.items[2].number};
}

/// -Z of a light at `from` points at `aim`, X lies level.
glm::dmat4 aimedAt(const SidecarReader& reader, const LocatedJson& value, const glm::dvec3& from) {
    const glm::dvec3 way = readPoint(reader, value, "'aim'") - from;
    const double length = glm::length(way);
    if (!(length > 1e-6 * (1 + glm::length(from))))
        reader.fail(value.line, "'aim' must be a point other than the light's own place");
    return worldFromLookAt(glm::vec3(0), glm::vec3(way / length));
}

/// Names the first two of `keys` that an object has both of.
void forbidTogether(const SidecarReader& reader, const LocatedJson& object,
                    std::initializer_list<std::string_view> keys) {
    std::string_view first;
    for (const std::string_view key : keys) {
        const LocatedJson* value = member(object, key);
        if (!value) continue;
        if (!first.empty())
            reader.fail(value->line, fmt::format("'{}' and '{}' say the same: keep one of them", first, key));
        first = key;
    }
}

}  // namespace

void readPlace(const SidecarReader& reader, const LocatedJson& object, SidecarLight& read) {
    forbidTogether(reader, object, {"rotation", "aim", "azimuth"});
    forbidTogether(reader, object, {"rotation", "aim", "altitude"});
    forbidTogether(reader, object, {"node", "below"});
    for (const std::string_view key : {"node", "below"}) {
        const LocatedJson* value = member(object, key);
        if (!value) continue;
        read.node = reader.text(*value, fmt::format("'{}'", key));
        read.nodeLine = value->line;
        read.isBelow = key == "below";
    }
    glm::dvec3 translation(0);
    if (const LocatedJson* value = member(object, "translation"))
        translation = readPoint(reader, *value, "'translation'");
    // What hangs below something shines down.
    if (read.isBelow) read.parentFromLight = worldFromLookAt(glm::vec3(0), glm::vec3(0, -1, 0));
    if (const LocatedJson* value = member(object, "rotation"))
        read.parentFromLight = readRotation(reader, *value);
    if (const LocatedJson* value = member(object, "aim"))
        read.parentFromLight = aimedAt(reader, *value, translation);
    if (member(object, "azimuth") || member(object, "altitude")) {
        read.parentFromLight = worldFromDistantLight(reader.number(object, "azimuth", 180, {-360, 360}),
                                                     reader.number(object, "altitude", 0, {-90, 90}));
        read.isInWorld = true;
    }
    if (member(object, "translation")) read.parentFromLight[3] = glm::dvec4(translation, 1);
}

}  // namespace penumbra::studio

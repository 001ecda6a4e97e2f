// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/lights/sidecar_place.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "studio/scene/builtin/placing.h"
#include "studio/scene/sun/sun.h"

namespace penumbra::studio {
namespace {

/// Rotation of the light's frame; a quaternion (x, y, z, w) of length 1, give or take what six digits leave.
glm::dmat4 readRotation(const JsonView& value) {
    const std::vector<float> xyzw = value.asNumbers(4);
    const glm::quat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    const float length = glm::length(rotation);
    if (!(std::abs(length - 1) <= 1e-3f))
        value.fail(
            fmt::format("'rotation' must be a quaternion [x, y, z, w] of length 1, not {:.4g}", length));
    return glm::mat4_cast(glm::normalize(rotation));
}

/// -Z of a light at `from` points at `aim`, X lies level.
glm::dmat4 aimedAt(const JsonView& aim, const glm::dvec3& at, const glm::dvec3& from) {
    const glm::dvec3 way = at - from;
    const double length = glm::length(way);
    if (!(length > 1e-6 * (1 + glm::length(from))))
        aim.fail("'aim' must be a point other than the light's own place");
    return worldFromLookAt(glm::vec3(0), glm::vec3(way / length));
}

/// Names the first two of `keys` that an object has both of.
void forbidTogether(const JsonView& object, std::initializer_list<std::string_view> keys) {
    std::string_view first;
    for (const std::string_view key : keys) {
        const auto value = object.find(key);
        if (!value) continue;
        if (!first.empty())
            value->fail(fmt::format("'{}' and '{}' say the same: keep one of them", first, key));
        first = key;
    }
}

}  // namespace

void readPlace(const LinedJson& document, const JsonView& object, SidecarLight& read) {
    forbidTogether(object, {"rotation", "aim", "azimuth"});
    forbidTogether(object, {"rotation", "aim", "altitude"});
    forbidTogether(object, {"node", "below"});
    for (const std::string_view key : {"node", "below"}) {
        const auto value = object.find(key);
        if (!value) continue;
        read.node = value->asName();
        read.nodeLine = document.lineOf(*value);
        read.isBelow = key == "below";
    }
    // Metres, with all of their digits: scenes may lie far from the origin.
    const glm::dvec3 translation = object.dvec3("translation", glm::dvec3(0));
    // What hangs below something shines down.
    if (read.isBelow) read.parentFromLight = worldFromLookAt(glm::vec3(0), glm::vec3(0, -1, 0));
    if (const auto rotation = object.find("rotation")) read.parentFromLight = readRotation(*rotation);
    if (const auto aim = object.find("aim"))
        read.parentFromLight = aimedAt(*aim, object.dvec3("aim", translation), translation);
    if (object.has("azimuth") || object.has("altitude")) {
        read.parentFromLight = worldFromDistantLight(object.number("azimuth", 180, {-360, 360}),
                                                     object.number("altitude", 0, {-90, 90}));
        read.isInWorld = true;
    }
    if (object.has("translation")) read.parentFromLight[3] = glm::dvec4(translation, 1);
}

}  // namespace penumbra::studio

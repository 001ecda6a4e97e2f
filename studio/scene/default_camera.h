// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studio/scene/scene.h"

namespace penumbra::studio {

/// A camera for a scene without one that sees something: in a room that is closed, at eye height, from its
/// far end along its longest free line; else from outside, the whole of `bounds`. A room is told from a
/// closed thing by its surfaces, which face inwards, and from a hollow one by its height: a person can stand
/// in it.
Camera defaultCamera(const Scene& scene, const SceneMoment& moment, const Bounds& bounds);

}  // namespace penumbra::studio

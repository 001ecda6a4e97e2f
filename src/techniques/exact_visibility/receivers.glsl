// SPDX-License-Identifier: Apache-2.0
// What of a receiver does not depend on the light.
#include "src/techniques/common/view.glsl"
#include "src/techniques/exact_visibility/exact_io.h"

layout(std140) uniform FrameBlock { ExactFrame frame; };

// Parts of a tile are eight in a row, which is what software runs together. They stand in 4 x 2 pixels: closer to each other
// than in 8 x 1.
ivec2 placeInTile(ivec2 thread) { return ivec2((thread.x & 3) + 4 * (thread.y & 1), (thread.x >> 2) + (thread.y & 6)); }

// Where rays start: off the surface, so that they do not meet it again. A position from a depth buffer carries some ten
// roundings of 2^-24 each, relative to its distance from the eye and to its coordinates; 4e-6 is six times their sum.
vec3 apexOf(Receiver receiver) {
    vec3 size = abs(receiver.posLight);
    float largest = max(size.x, max(size.y, size.z));
    return receiver.posLight + 4e-6 * (largest + distance(receiver.posLight, frame.eye)) * receiver.normalLight;
}

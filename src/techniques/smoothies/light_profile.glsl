// SPDX-License-Identifier: Apache-2.0
// Which part of the light lies on one side of a line. Variants: COLORED, for textured lights, whose channels differ.
// Includer includes smoothies.glsl.
#ifdef COLORED
#define Seen vec3
uniform sampler2D lightProfile;

// Where (u, v) in [-1, 1] along the light's axes has dot(along, (u, v)) > -x, |along.x| + |along.y| = 1. Columns of the
// profile go round the diamond of all such directions, starting at (1, 0); rows are x from -1 to 1.
Seen partBeside(int camera, LightExtent extent, float x) {
    float turn = extent.along.y >= 0.0 ? 1.0 - extent.along.x : 3.0 + extent.along.x;
    vec2 place = vec2(0.25 * turn * float(profileDirections), 0.5 * (clamp(x, -1.0, 1.0) + 1.0) * float(profileOffsets - 1));
    return textureLod(lightProfile, (place + 0.5) / vec2(profileDirections + 1, profileOffsets), 0.0).rgb;
}
#else
#define Seen float

Seen partBeside(int camera, LightExtent extent, float x) { return lightVisible(camera, x, extent.spread); }
#endif

// Visibility at x in [-1, 1] from the penumbra's inner to its outer border; x = 0 is the edge as the centre sees it.
Seen falloff(int camera, LightExtent extent, float x) {
    x = clamp(x, -1.0, 1.0);
    int kind = smoothies[camera].falloff;
    if (kind == falloffLinear) return Seen(0.5 + 0.5 * x);
    if (kind == falloffSinusoidal) return Seen(clamp(0.5 + 0.5 * sin(1.57079633 * x), 0.0, 1.0));
    return partBeside(camera, extent, x);
}

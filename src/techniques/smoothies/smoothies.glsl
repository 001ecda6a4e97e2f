// SPDX-License-Identifier: Apache-2.0
// How wide a smoothie is, and how visibility changes across it.
//
// A "place" is a point in a light camera's window: tangents (x/z, y/z), or metres where the camera is orthographic.
// "Nearness" is 1/z of a perspective camera and -z of an orthographic one. Both are linear in the window along a
// straight edge. Let an edge at nearness nb shade a receiver at nearness nr. A point of the light s (in face space, from
// the light's centre) throws the edge's shadow not to the edge's place q but to
//     q - (s.xy - s.z q) (nb - nr)                   (perspective)
// so that half the penumbra's width across the edge's normal n is
//     w = h (nb - nr),   h = max over s of dot(n, s.xy - s.z q).
// With t = h nb that is t (1 - b/r): equation 1, with the size of the smoothie that the light asks for. For a distant
// light h is the tangent of half its angle.
#include "src/techniques/common/map_depth.glsl"
#include "src/techniques/smoothies/smoothies_io.h"

// A uniform block, since storage blocks are read lane by lane on software rasterisers.
layout(std140) uniform SmoothieBlock { SmoothieConstants smoothies[maxSmoothieCameras]; };

bool isOrthographic(int camera) { return smoothies[camera].camera.depth.isOrthographic; }

float nearnessOf(int camera, float depth_m) { return isOrthographic(camera) ? -depth_m : 1.0 / depth_m; }

// The same for a value in the depth map; where that is empty, of the farthest receiver.
float storedNearness(int camera, float stored) {
    if (stored == 0.0) return smoothies[camera].farthestReceiver;
    return storedNearness(smoothies[camera].camera.depth, stored);
}

vec2 placeOf(int camera, vec2 uv) {
    MapWindow window = smoothies[camera].camera.window;
    return uv / window.perExtent + window.min;
}

vec2 uvOf(int camera, vec2 place) {
    MapWindow window = smoothies[camera].camera.window;
    return (place - window.min) * window.perExtent;
}

ivec2 texelOf(int camera, vec2 place, int size_px) {
    return clamp(ivec2(floor(uvOf(camera, place) * float(size_px))), ivec2(0), ivec2(size_px - 1));
}

// The light's extent along a direction in the window, and how it is spread.
struct LightExtent {
    float half_m;
    float spread;  // of a rect the part (of both halves) along its shorter-looking axis: 0 seen edge on, 1/2 both alike
    vec2 along;    // of a rect its axes' shares, with signs
};

LightExtent rectExtent(float x, float y) {
    float sum = abs(x) + abs(y);
    return LightExtent(sum, min(abs(x), abs(y)) / max(sum, 1e-30), vec2(x, y) / max(sum, 1e-30));
}

LightExtent lightExtent(int camera, vec2 place, vec2 normal) {
    SmoothieConstants c = smoothies[camera];
    if (c.light.shape == shapeDistant) return LightExtent(c.radius, 0.0, vec2(0.0));
    if (c.light.shape == shapeSphere) {
        float along = dot(place, normal);
        return LightExtent(c.radius * sqrt(1.0 + along * along), 0.0, vec2(0.0));
    }
    float x = dot(c.halfX.xy - c.halfX.z * place, normal);
    float y = dot(c.halfY.xy - c.halfY.z * place, normal);
    if (c.light.shape == shapeDisk) return LightExtent(length(vec2(x, y)), 0.0, vec2(0.0));
    return rectExtent(x, y);
}

// Half the penumbra's width in the window; never less than a texel, below which a map cannot show it.
float smoothieWidth(int camera, float half_m, float blocker, float receiver) {
    SmoothieConstants c = smoothies[camera];
    if (c.fixedWidth > 0.0) {
        // The paper's t. Orthographic cameras measure b and r from the nearest caster, having no light to start from.
        float whole = isOrthographic(camera) ? c.fixedFrom - receiver : blocker;
        return c.isRemapped ? max(c.fixedWidth * (blocker - receiver) / max(whole, 1e-30), c.smallestWidth) : c.fixedWidth;
    }
    return clamp(half_m * (blocker - (c.isRemapped ? receiver : c.farthestReceiver)), c.smallestWidth, c.largestWidth);
}

// The part of a rect light on one side of a line at x in [-1, 1]: its projection is two boxes convolved.
float rectVisible(float x, float spread) {
    float flat_ = 1.0 - 2.0 * spread;  // half the plateau's width
    float beyond = max(abs(x) - flat_, 0.0);
    float area = 0.5 * abs(x) / (1.0 - spread);
    if (spread > 0.0) area -= beyond * beyond / (8.0 * spread * (1.0 - spread));
    return 0.5 + sign(x) * clamp(area, 0.0, 0.5);
}

// The part of a disk on one side of a line at x in [-1, 1].
float diskVisible(float x) {
    return clamp(0.5 + (asin(x) + x * sqrt(max(1.0 - x * x, 0.0))) / 3.14159265, 0.0, 1.0);
}

// The exact part of the light on one side of a line at x in [-1, 1].
float lightVisible(int camera, float x, float spread) {
    x = clamp(x, -1.0, 1.0);
    return smoothies[camera].light.shape == shapeRect ? rectVisible(x, spread) : diskVisible(x);
}

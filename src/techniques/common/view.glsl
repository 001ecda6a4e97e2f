// SPDX-License-Identifier: Apache-2.0
// The receivers, in light space: metres, the light's centre at the origin, emission along -Z. Working there keeps
// coordinates small wherever in the world the light stands.
#include "src/techniques/common/view_io.h"

layout(std140, binding = 0) uniform ViewBlock { ViewConstants view; };
layout(binding = 0) uniform sampler2D viewDepth;
layout(binding = 1) uniform sampler2D viewNormals;
layout(binding = 2) uniform sampler2D viewReceivers;

struct Receiver {
    vec3 posLight;
    vec3 normalLight;  // geometric, unit length, on the camera's side
};

bool isBackground(float depth) { return depth == view.clipZFromDepth.z; }

vec3 positionLight(vec2 pixel, float depth) {
    vec2 ndc = 2.0 * (pixel + 0.5) / vec2(view.size_px.xy) - 1.0;
    vec4 pos = view.lightFromClip * vec4(ndc, depth * view.clipZFromDepth.x + view.clipZFromDepth.y, 1.0);
    return pos.xyz / pos.w;
}

// The step to a neighbour along `axis`, on the side where the depth changes less: the same surface, most likely.
vec3 tangentLight(ivec2 pixel, float depth, vec3 pos, ivec2 axis) {
    ivec2 before = max(pixel - axis, ivec2(0));
    ivec2 after = min(pixel + axis, view.size_px.xy - 1);
    float depthBefore = texelFetch(viewDepth, before, 0).r;
    float depthAfter = texelFetch(viewDepth, after, 0).r;
    bool useAfter = before == pixel || (after != pixel && abs(depthAfter - depth) < abs(depthBefore - depth));
    return useAfter ? positionLight(after, depthAfter) - pos : pos - positionLight(before, depthBefore);
}

// False where the pixel shows no surface, or one that receives no shadow: its visibility is 1.
bool isReceiver(ivec2 pixel) {
    return !isBackground(texelFetch(viewDepth, pixel, 0).r) &&
           (view.size_px.w == 0 || texelFetch(viewReceivers, pixel, 0).r >= 0.5);
}

// The same, and where and what it is.
bool loadReceiver(ivec2 pixel, out Receiver receiver) {
    if (!isReceiver(pixel)) return false;
    float depth = texelFetch(viewDepth, pixel, 0).r;
    receiver.posLight = positionLight(pixel, depth);
    receiver.normalLight =
        view.size_px.z == 1
            ? mat3(view.lightFromWorld) * texelFetch(viewNormals, pixel, 0).rgb
            : cross(tangentLight(pixel, depth, receiver.posLight, ivec2(1, 0)),
                    tangentLight(pixel, depth, receiver.posLight, ivec2(0, 1)));
    receiver.normalLight = normalize(receiver.normalLight);
    return true;
}

// SPDX-License-Identifier: Apache-2.0
// The receivers, in light space: metres, the light's centre at the origin, emission along -Z. Working there keeps
// coordinates small wherever in the world the light stands.
#include "src/techniques/common/view_io.h"

layout(std140) uniform ViewBlock { ViewConstants view; };
uniform sampler2D viewDepth;
uniform sampler2D viewNormals;
uniform sampler2D viewReceivers;

struct Receiver {
    vec3 posLight;
    vec3 normalLight;  // geometric, unit length, on the camera's side
};

bool isBackground(float depth) { return depth == view.backgroundDepth; }

// Nearness is 0 at the background, as reversed depth is. A depth of the other kind lies close below 1, and taking it from 1
// is exact; in the matrix's own sums 1 would cancel out only after it has rounded them, by as many metres as a whole step
// of the depth is wide.
vec3 positionLight(vec2 pixel, float depth) {
    vec2 ndc = 2.0 * (pixel + 0.5) / vec2(view.size_px) - 1.0;
    vec4 pos = view.lightFromPicture * vec4(ndc, depth * view.nearnessScale + view.nearnessOffset, 1.0);
    return pos.xyz / pos.w;
}

float depthAt(ivec2 pixel) { return texelFetch(viewDepth, clamp(pixel, ivec2(0), view.size_px - 1), 0).r; }

// The step to a neighbour along `axis`, on the side whose next two pixels lie in line with this one: the same face, most
// likely. (Depths of a plane are linear over the picture, in perspective too.) Between equals, the nearer.
vec3 tangentLight(ivec2 pixel, float depth, vec3 pos, ivec2 axis) {
    ivec2 before = pixel - axis, after = pixel + axis;
    float depthBefore = depthAt(before), depthAfter = depthAt(after);
    float bendBefore = abs(2.0 * depthBefore - depthAt(before - axis) - depth);
    float bendAfter = abs(2.0 * depthAfter - depthAt(after + axis) - depth);
    bool useAfter = any(lessThan(before, ivec2(0))) ||
                    (all(lessThan(after, view.size_px)) &&
                     (bendAfter == bendBefore ? abs(depthAfter - depth) < abs(depthBefore - depth)
                                              : bendAfter < bendBefore));
    return useAfter ? positionLight(after, depthAfter) - pos : pos - positionLight(before, depthBefore);
}

// Where an includer knows that there are normals, software rasterizers, which run both sides of a branch, are spared the
// other one.
#ifdef WITH_NORMALS
const bool hasNormals = true;
#else
bool hasNormals = view.hasNormals;
#endif

// False where the pixel shows no surface, or one that receives no shadow: its visibility is 1.
bool isReceiver(ivec2 pixel) {
    return !isBackground(texelFetch(viewDepth, pixel, 0).r) &&
           (!view.hasReceiverMask || texelFetch(viewReceivers, pixel, 0).r >= 0.5);
}

// The same, and where and what it is.
bool loadReceiver(ivec2 pixel, out Receiver receiver) {
    if (!isReceiver(pixel)) return false;
    vec4 stored = texelFetch(viewDepth, pixel, 0);
    float depth = stored.r;
    receiver.posLight = view.isOfPoints ? (view.lightFromWorld * vec4(stored.gba, 1.0)).xyz : positionLight(pixel, depth);
    receiver.normalLight =
        hasNormals
            ? mat3(view.lightFromWorld) * texelFetch(viewNormals, pixel, 0).rgb
            : cross(tangentLight(pixel, depth, receiver.posLight, ivec2(1, 0)),
                    tangentLight(pixel, depth, receiver.posLight, ivec2(0, 1)));
    receiver.normalLight = normalize(receiver.normalLight);
    return true;
}

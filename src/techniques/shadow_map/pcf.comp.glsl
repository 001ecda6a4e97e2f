// SPDX-License-Identifier: Apache-2.0
#version 450
// Percentage-closer filtering: every texel under a kernel is compared by itself, and the answers are averaged. Depths
// are gathered and weighted here, since the weights of a sampler's own comparison differ from maker to maker.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_map/shadow_map_io.h"
#include "src/techniques/shadow_map/compare.glsl"

layout(std430) readonly buffer PoissonDisk { vec2 poissonDisk[]; };  // points of the unit disk

uniform writeonly image2D visibility;
layout(std140) uniform Constants { PcfConstants pcf; };

// The integral, from minus infinity to x, of a tent of unit area that is 2 * halfWidth wide.
float tentBelow(float x, float halfWidth) {
    float inside = clamp(x / halfWidth, -1.0, 1.0);
    return 0.5 + inside - 0.5 * inside * abs(inside);
}

// The weight of a texel whose centre lies `x` texels away. Each is a partition of unity: it sums to 1 over all texels.
float weightAt(float x) {
    if (pcf.kernel == kernelTent3) return tentBelow(x + 0.5, 1.5) - tentBelow(x - 0.5, 1.5);
    if (pcf.kernel == kernelTent5) return tentBelow(x + 0.5, 2.5) - tentBelow(x - 0.5, 2.5);
    x = abs(x);
    if (pcf.kernel == kernelBicubic) {  // the cubic B-spline
        float outer = max(0.0, 2.0 - x), inner = max(0.0, 1.0 - x);
        return (outer * outer * outer - 4.0 * inner * inner * inner) / 6.0;
    }
    return max(0.0, 1.0 - x);
}

// The share of the 2 * reach_px squared texels around `place_px` that is lit, each under its weight.
float filteredLit(int camera, MapPoint point, vec3 normalFace, vec2 place_px, int reach_px) {
    int size_px = textureSize(depthMaps, 0).x;
    ivec2 first = ivec2(floor(place_px - 0.5)) + 1 - reach_px;
    float lit = 0.0;
    for (int y = 0; y < 2 * reach_px; y += 2) {
        for (int x = 0; x < 2 * reach_px; x += 2) {
            // Gathered at the corner where four texels meet, so that no rounding can choose others.
            ivec2 corner = first + ivec2(x, y) + 1;
            vec4 stored = textureGather(depthMaps, vec3(vec2(corner) / float(size_px), camera));
            vec2 offset = vec2(corner) - 0.5 - place_px;
            vec2 weightX = vec2(weightAt(offset.x), weightAt(offset.x + 1.0));
            vec2 weightY = vec2(weightAt(offset.y), weightAt(offset.y + 1.0));
            vec4 weights = vec4(weightX, weightX.yx) * vec4(weightY.yy, weightY.xx);
            bvec4 isLit = bvec4(isDepthLit(camera, point, normalFace, corner + ivec2(-1, 0), stored.x, size_px),
                                isDepthLit(camera, point, normalFace, corner, stored.y, size_px),
                                isDepthLit(camera, point, normalFace, corner + ivec2(0, -1), stored.z, size_px),
                                isDepthLit(camera, point, normalFace, corner - 1, stored.w, size_px));
            lit += dot(weights, vec4(isLit));
        }
    }
    return lit;
}

float seenBy(Receiver receiver) {
    if (!isFacingCenter(receiver, pcf.light)) return 0.0;
    MapPoint point;
    int camera = findCamera(pcf.mapCount, receiver.posLight, point);
    if (camera < 0) return 1.0;
    vec3 normalFace = mat3(lightCameras[camera].faceFromLight) * receiver.normalLight;
    vec2 place_px = point.uv * float(textureSize(depthMaps, 0).x);
    if (pcf.kernel == kernelPoisson) {
        float lit = 0.0;
        for (int i = 0; i < pcf.poissonCount; ++i) {
            lit += filteredLit(camera, point, normalFace, place_px + pcf.radius_px * poissonDisk[i], 1);
        }
        return lit / float(pcf.poissonCount);
    }
    int reach_px = pcf.kernel == kernelBilinear ? 1 : pcf.kernel == kernelTent5 ? 3 : 2;
    return filteredLit(camera, point, normalFace, place_px, reach_px);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    float seen = loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0;
    imageStore(visibility, pixel, vec4(clamp(seen, 0.0, 1.0)));
}

// SPDX-License-Identifier: Apache-2.0
#version 450
// The pyramid's base: each work group goes through the texels of one tile.
layout(local_size_x = 8, local_size_y = 8) in;

#define DEPTH_MAP_UNIT 3
#define DEPTH_MAP_BLOCK 0
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_map/nearest_tiles.glsl"

layout(std430, binding = 3) writeonly buffer NearestTiles { float nearestTiles[]; };
layout(location = 0) uniform int tile_px;
layout(location = 1) uniform bool hasPlane;  // rect and disk lights

const float nothing = -3.4e38;
shared float closest[64];

float closeness(int camera, ivec2 texel, int size_px) {
    LightCameraConstants c = lightCameras[camera];
    float stored = texelFetch(depthMaps, ivec3(texel, camera), 0).r;
    if (stored == 0.0) return nothing;
    float depth_m = depthFace_m(camera, stored);
    if (c.depth.z == 1.0) return -depth_m;
    vec3 direction = vec3((vec2(texel) + 0.5) / float(size_px) / c.window.zw + c.window.xy, 1.0);
    // Column 2 is the light's z axis as the camera sees it.
    float distance_m = depth_m * (hasPlane ? abs(dot(c.faceFromLight[2].xyz, direction)) : length(direction));
    return 1.0 / max(distance_m, 1e-30);
}

void main() {
    int camera = int(gl_WorkGroupID.z);
    int size_px = textureSize(depthMaps, 0).x;
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    float mine = nothing;
    for (int y = int(gl_LocalInvocationID.y); y < tile_px; y += 8) {
        for (int x = int(gl_LocalInvocationID.x); x < tile_px; x += 8) {
            ivec2 texel = tile * tile_px + ivec2(x, y);
            if (all(lessThan(texel, ivec2(size_px)))) mine = max(mine, closeness(camera, texel, size_px));
        }
    }
    uint self = gl_LocalInvocationIndex;
    closest[self] = mine;
    for (uint step = 32u; step > 0u; step >>= 1) {
        barrier();
        if (self < step) closest[self] = max(closest[self], closest[self + step]);
    }
    if (self == 0u) nearestTiles[camera * tilesPerMap + tile.y * tilesAcross + tile.x] = closest[0];
}

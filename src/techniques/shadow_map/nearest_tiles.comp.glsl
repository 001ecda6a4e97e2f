// SPDX-License-Identifier: Apache-2.0
#version 450
// The pyramid's base: each work group goes through the texels of one tile.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_map/nearest_tiles.glsl"
#include "src/techniques/shadow_map/shadow_map_io.h"

layout(std430) writeonly buffer NearestTiles { float nearestTiles[]; };
layout(std140) uniform Constants { NearestTilesConstants constants; };

shared float nearest[64];

// Of a blocker at any place in the tile whose stored depth is `stored`: never less than the truth.
float closeness(int camera, vec2 tile, float stored, int size_px) {
    LightCameraConstants c = lightCameras[camera];
    if (stored == 0.0) return -3.4e38;
    float depth_m = depthFace_m(camera, stored);
    if (c.depth.z == 1.0) return -depth_m;
    vec2 low = tile * float(constants.tile_px) / float(size_px) / c.window.zw + c.window.xy;
    vec2 high = (tile + 1.0) * float(constants.tile_px) / float(size_px) / c.window.zw + c.window.xy;
    float distance_m;
    if (constants.hasPlane) {
        // Column 2 is the light's z axis as the camera sees it; the distance from its plane is linear over the tile.
        vec3 axis = c.faceFromLight[2].xyz;
        vec4 corners = vec4(dot(axis, vec3(low, 1.0)), dot(axis, vec3(high, 1.0)),
                            dot(axis, vec3(low.x, high.y, 1.0)), dot(axis, vec3(high.x, low.y, 1.0)));
        bool isCrossed = any(greaterThan(corners, vec4(0.0))) && any(lessThan(corners, vec4(0.0)));
        corners = abs(corners);
        distance_m = isCrossed ? 0.0 : depth_m * min(min(corners.x, corners.y), min(corners.z, corners.w));
    } else {
        distance_m = depth_m * length(vec3(max(max(low, -high), 0.0), 1.0));
    }
    return 1.0 / max(distance_m, 1e-30);
}

void main() {
    int camera = int(gl_WorkGroupID.z);
    int size_px = textureSize(depthMaps, 0).x;
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    float stored = 0.0;
    for (int y = 2 * int(gl_LocalInvocationID.y); y < constants.tile_px; y += 16) {
        for (int x = 2 * int(gl_LocalInvocationID.x); x < constants.tile_px; x += 16) {
            vec2 corner = vec2(tile * constants.tile_px + ivec2(x, y) + 1) / float(size_px);
            vec4 four = textureGather(depthMaps, vec3(corner, camera));
            stored = max(stored, max(max(four.x, four.y), max(four.z, four.w)));
        }
    }
    uint self = gl_LocalInvocationIndex;
    nearest[self] = stored;
    for (uint step = 32u; step > 0u; step >>= 1) {
        barrier();
        if (self < step) nearest[self] = max(nearest[self], nearest[self + step]);
    }
    if (self == 0u) {
        nearestTiles[camera * tilesPerMap + tile.y * tilesAcross + tile.x] =
            closeness(camera, vec2(tile), nearest[0], size_px);
    }
}

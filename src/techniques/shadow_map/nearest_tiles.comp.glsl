// SPDX-License-Identifier: Apache-2.0
#version 450
// The pyramid's base: each work group goes through the texels of one tile.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_map/nearest_tiles.glsl"
#include "src/techniques/shadow_map/shadow_map_io.h"

layout(std430) writeonly buffer NearestTiles { float nearestTiles[][tangents]; };
layout(std140) uniform Constants { NearestTilesConstants constants; };

shared float nearest[64];

// The least magnitude of a linear function over a tile, from its values at the corners.
float leastOver(vec4 corners) {
    bool isCrossed = any(greaterThan(corners, vec4(0.0))) && any(lessThan(corners, vec4(0.0)));
    corners = abs(corners);
    return isCrossed ? 0.0 : min(min(corners.x, corners.y), min(corners.z, corners.w));
}

// Of blockers at any place in the tile, at the depth `stored` or farther: never less than the truth. x: closeness, y: the
// distance beside the light's outline.
vec2 closenessAndAside(int camera, vec2 tile, float stored, int size_px) {
    LightCameraConstants c = lightCameras[camera];
    if (stored == 0.0) return vec2(-3.4e38, 0.0);
    float depth_m = depthFace_m(camera, stored);
    if (c.depth.isOrthographic) return vec2(-depth_m, 0.0);
    vec2 low = tile * float(constants.tile_px) / float(size_px) / c.window.perExtent + c.window.min;
    vec2 high = (tile + 1.0) * float(constants.tile_px) / float(size_px) / c.window.perExtent + c.window.min;
    vec2 halfSize = constants.light.halfSize;
    if (constants.light.shape == shapeSphere) {
        // Beside the line to a receiver by no more than the sphere's radius.
        float distance_m = depth_m * length(vec3(max(max(low, -high), 0.0), 1.0));
        float along_m = sqrt(max(distance_m * distance_m - halfSize.x * halfSize.x, 0.0));
        return vec2(1.0 / max(along_m, 1e-30), 0.0);
    }
    // The columns are the light's axes as the camera sees it; a place in the tile is linear in each.
    mat4x3 corners = mat4x3(vec3(low, 1.0), vec3(high, 1.0), vec3(low.x, high.y, 1.0), vec3(high.x, low.y, 1.0));
    vec3 least_m = depth_m * vec3(leastOver(c.faceFromLight[0].xyz * corners), leastOver(c.faceFromLight[1].xyz * corners),
                                  leastOver(c.faceFromLight[2].xyz * corners));
    return vec2(1.0 / max(least_m.z, 1e-30), length(max(least_m.xy - halfSize, 0.0)));
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
        vec2 closest = closenessAndAside(camera, vec2(tile), nearest[0], size_px);
        for (int i = 0; i < tangents; ++i) {
            nearestTiles[camera * tilesPerMap + tile.y * tilesAcross + tile.x][i] =
                closest.y > 0.0 ? min(closest.x, tangentAt(i) / closest.y) : closest.x;
        }
    }
}

// SPDX-License-Identifier: Apache-2.0
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_map/shadow_map_io.h"
#include "src/techniques/shadow_map/compare.glsl"

uniform writeonly image2D visibility;
layout(std140) uniform Constants { HardConstants hard; };

float seenBy(Receiver receiver) {
    if (!isFacingCenter(receiver, hard.light)) return 0.0;
    MapPoint point;
    int camera = findCamera(hard.mapCount, receiver.posLight, point);
    if (camera < 0) return 1.0;
    return nearestTexelLit(camera, point, mat3(lightCameras[camera].faceFromLight) * receiver.normalLight);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    float seen = loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0;
    imageStore(visibility, pixel, vec4(seen));
}

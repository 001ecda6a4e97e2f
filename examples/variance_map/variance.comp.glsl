// SPDX-License-Identifier: Apache-2.0
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/common/light_plane.glsl"
#include "src/techniques/variance_map/variance_io.h"

uniform sampler2DArray moments;
uniform writeonly image2D visibility;
layout(std140) uniform Constants { VarianceConstants variance; };

// storedDepth_m the other way.
float storedAt(MapDepth depth, float depth_m) {
    return depth.isOrthographic ? (depth.far_m - depth_m) / (depth.far_m - depth.near_m) : depth.near_m / depth_m;
}

// Chebyshev's bound on the share of texels that do not lie before the receiver (equation 5); nearer is larger here.
float litShare(int camera, MapPoint point) {
    vec2 mean = texture(moments, vec3(point.uv, camera)).rg;
    float tolerance_m = mapTolerance_m(point.texel_m, point.posFace);
    float before = mean.x - storedAt(lightCameras[camera].depth, point.posFace.z - tolerance_m);
    if (before <= 0.0) return 1.0;
    float spread = max(mean.y - mean.x * mean.x, 0.0);
    return spread / (spread + before * before);
}

float seenBy(Receiver receiver) {
    vec3 towardsLight = variance.light.shape == shapeDistant ? vec3(0.0, 0.0, 1.0) : -receiver.posLight;
    if (dot(receiver.normalLight, towardsLight) <= 0.0 || isOutsideEmission(receiver.posLight, variance.light)) return 0.0;
    for (int camera = 0; camera < variance.mapCount; ++camera) {
        MapPoint point = mapPoint(camera, receiver.posLight);
        if (isInWindow(camera, point)) return litShare(camera, point);
    }
    return 1.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    float seen = loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0;
    imageStore(visibility, pixel, vec4(seen));
}

// SPDX-License-Identifier: Apache-2.0
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#define DEPTH_MAP_UNIT 3
#define DEPTH_MAP_BLOCK 0
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_map/compare.glsl"

layout(binding = 0) uniform writeonly image2D visibility;
layout(location = 0) uniform int mapCount;
layout(location = 1) uniform bool isDistant;
layout(location = 2) uniform bool isOneSided;

// The light's centre is above the surface's horizon, and the surface on the side to which the light emits.
bool isFacing(Receiver receiver) {
    vec3 towardsLight = isDistant ? vec3(0.0, 0.0, 1.0) : -receiver.posLight;
    return dot(receiver.normalLight, towardsLight) > 0.0 && (!isOneSided || receiver.posLight.z < 0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    float seen = 1.0;
    if (loadReceiver(pixel, receiver)) seen = isFacing(receiver) ? nearestTexelLit(mapCount, receiver) : 0.0;
    imageStore(visibility, pixel, vec4(seen));
}

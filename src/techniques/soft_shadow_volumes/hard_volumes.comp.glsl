// SPDX-License-Identifier: Apache-2.0
#version 450
// Hard shadows: lit where no triangle lies between the surface and the light's centre.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"

uniform sampler2D volumeCounts;
layout(std430) readonly buffer Eye { EyeState eye; };
uniform writeonly image2D visibility;

// The light's centre is above the surface's horizon, and the surface on the side to which the light emits.
bool isFacing(Receiver receiver) {
    vec3 towardsLight = volume.light.shape == shapeDistant ? vec3(0.0, 0.0, 1.0) : -receiver.posLight;
    return dot(receiver.normalLight, towardsLight) > 0.0 &&
           (!volume.light.isOneSided || receiver.posLight.z < volume.plane_m);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    float seen = 1.0;
    if (loadReceiver(pixel, receiver)) {
        float count = texelFetch(volumeCounts, pixel, 0).r + float(eye.blockers);
        seen = isFacing(receiver) && count < 0.5 ? 1.0 : 0.0;
    }
    imageStore(visibility, pixel, vec4(seen));
}

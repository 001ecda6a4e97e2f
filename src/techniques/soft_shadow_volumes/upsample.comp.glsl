// SPDX-License-Identifier: Apache-2.0
#version 450
// From a smaller V-buffer to the picture, without the bleeding of the thesis's figure 19: a pixel takes from the texels
// around it that lie on its own surface.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"

layout(binding = 3) uniform sampler2D vBuffer;
layout(binding = 0) uniform writeonly image2D visibility;

// A texel belongs to the surface if it lies near the pixel's plane: within a sixth of its distance, which is what a
// curved surface that turns by twenty degrees between them rises; and if its normal is within some forty degrees.
const float offPlane = 0.167;
const float sameNormal = 0.75;

// 0: another surface.
float kinship(Receiver pixel, ivec2 texel, out float distance_m) {
    Receiver other;
    distance_m = uintBitsToFloat(0x7f800000u);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, volume.buffer_px.xy))) return 0.0;
    if (!loadLiftedReceiver(texel, other)) return 0.0;
    vec3 way = other.posLight - pixel.posLight;
    float reach = length(way);
    float rounding = 1e-5 * length(pixel.posLight);
    if (dot(pixel.normalLight, other.normalLight) < sameNormal ||
        abs(dot(pixel.normalLight, way)) > offPlane * reach + rounding) {
        distance_m = reach * 1e6;  // to be taken only where no texel around is any better
        return 0.0;
    }
    distance_m = reach;
    return 1.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    vec3 seen = vec3(1.0);
    if (loadReceiver(pixel, receiver)) {
        int scale = volume.buffer_px.z;
        ivec2 first = pixel / scale;
        vec2 part = vec2(pixel - first * scale) / float(scale);
        vec3 sum = vec3(0.0);
        float weights = 0.0, nearest = uintBitsToFloat(0x7f800000u), distance_m;
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 2; ++x) {
                vec2 share = mix(1.0 - part, part, vec2(x, y));
                float weight = share.x * share.y * kinship(receiver, first + ivec2(x, y), distance_m);
                sum += weight * texelFetch(vBuffer, first + ivec2(x, y), 0).rgb;
                weights += weight;
            }
        }
        if (weights > 0.0) {
            seen = sum / weights;
        } else {
            // A surface thinner than a texel: its nearest texel in a wider ring, if it has one.
            for (int y = -1; y < 3; ++y) {
                for (int x = -1; x < 3; ++x) {
                    kinship(receiver, first + ivec2(x, y), distance_m);
                    if (distance_m < nearest) {
                        nearest = distance_m;
                        seen = texelFetch(vBuffer, first + ivec2(x, y), 0).rgb;
                    }
                }
            }
        }
    }
    imageStore(visibility, pixel, vec4(seen, 1.0));
}

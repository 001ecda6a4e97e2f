// SPDX-License-Identifier: Apache-2.0
#version 450
// From a smaller V-buffer to the picture, without the bleeding of the thesis's figure 19: a pixel takes from the texels
// around it that lie on its own surface.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"

layout(std430) readonly buffer MixedTiles { uint mixedTiles[]; };  // see upsample_even.comp.glsl
uniform sampler2D vBuffer;
uniform writeonly image2D visibility;

// A texel belongs to the surface if it lies near the pixel's plane: within a sixth of its distance, which is what a
// curved surface that turns by twenty degrees between them rises; and if its normal is within some forty degrees.
const float offPlane = 0.167;
const float sameNormal = 0.75;

const float nowhere = 3e38;

// The texels that the pixels of a tile look at: from one before the first to two after the last, at most 7 x 7.
struct Texel {
    vec3 posLight;
    vec3 normalLight;  // 0 where nothing receives
    vec3 seen;
};
shared Texel texels[64];

int texelsAcross() { return 8 / volume.pixelsPerTexel + 3; }

void loadTexel(ivec2 firstTexel) {
    int lane = int(gl_LocalInvocationIndex), across = texelsAcross();
    ivec2 texel = firstTexel + ivec2(lane % across, lane / across);
    ivec2 inside = clamp(texel, ivec2(0), volume.buffer_px - 1);
    Receiver receiver;
    bool isThere = texel == inside && loadLiftedReceiver(inside, receiver);
    texels[lane] = Texel(isThere ? receiver.posLight : vec3(0.0), isThere ? receiver.normalLight : vec3(0.0),
                         texelFetch(vBuffer, inside, 0).rgb);
}

// Whether the texel lies on the pixel's surface. How far it is in any case: far, where it is on another.
bool isKin(Receiver pixel, Texel texel, out float distance_m) {
    distance_m = nowhere;
    if (texel.normalLight == vec3(0.0)) return false;
    vec3 way = texel.posLight - pixel.posLight;
    distance_m = length(way);
    float rounding = 1e-5 * length(pixel.posLight);
    bool kin = dot(pixel.normalLight, texel.normalLight) >= sameNormal &&
               abs(dot(pixel.normalLight, way)) <= offPlane * distance_m + rounding;
    // To be taken only where no texel around is any better.
    if (!kin) distance_m *= 1e6;
    return kin;
}

void main() {
    uint tilesAcross = uint(view.size_px.x + 7) / 8u, tile = mixedTiles[3u + gl_WorkGroupID.x];
    ivec2 firstPixel = ivec2(8u * uvec2(tile % tilesAcross, tile / tilesAcross));
    int scale = volume.pixelsPerTexel;
    loadTexel(firstPixel / scale - 1);
    barrier();
    ivec2 pixel = firstPixel + ivec2(gl_LocalInvocationID.xy);
    Receiver receiver;
    if (any(greaterThanEqual(pixel, view.size_px)) || !loadReceiver(pixel, receiver)) return;

    ivec2 before = pixel / scale - firstPixel / scale;  // among the tile's texels, where the first pixel's own is (1, 1)
    vec2 part = vec2(pixel % scale) / float(scale);
    vec3 sum = vec3(0.0);
    float weights = 0.0, distance_m;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        vec2 share = mix(1.0 - part, part, vec2(step));
        ivec2 place = before + 1 + step;
        Texel texel = texels[place.y * texelsAcross() + place.x];
        float weight = isKin(receiver, texel, distance_m) ? share.x * share.y : 0.0;
        sum += weight * texel.seen;
        weights += weight;
    }
    vec3 seen = sum / max(weights, 1e-30);

    // A surface thinner than a texel: its nearest texel in a wider ring, if it has one.
    int ring = weights > 0.0 ? 0 : 16;
    float nearest = nowhere;
    if (ring > 0) seen = vec3(1.0);
    for (int i = 0; i < ring; ++i) {
        ivec2 place = before + ivec2(i & 3, i >> 2);
        Texel texel = texels[place.y * texelsAcross() + place.x];
        isKin(receiver, texel, distance_m);
        if (distance_m < nearest) {
            nearest = distance_m;
            seen = texel.seen;
        }
    }
    imageStore(visibility, pixel, vec4(seen, 1.0));
}

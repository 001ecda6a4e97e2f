// SPDX-License-Identifier: Apache-2.0
#version 450
// Reprojection (section 3.3.2): the shadow values of a round's new samples, for each fragment of the comparison target.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/light_sampling/sample_test.glsl"
#include "src/techniques/light_sampling/subdivision_io.h"
#include "src/techniques/light_sampling/lattice_bits.glsl"

layout(rgba32ui) uniform uimage2D shadowBits;
layout(std140) uniform Constants { CompareConstants constants; };

bool isBase(int vertex) {
    int step = 16 >> constants.baseDepth;
    return (vertex % latticeSide) % step == 0 && (vertex / latticeSide) % step == 0;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, constants.target_px))) return;
    ivec2 pixel = ivec2((vec2(texel) + 0.5) * vec2(view.size_px.xy) / vec2(constants.target_px));
    uint words[3] = uint[3](0u, 0u, 0u);
    bool isBaseShadowed = false;
    if (!constants.starts) {
        uvec4 before = imageLoad(shadowBits, texel);
        words = uint[3](before.x, before.y, before.z);
        isBaseShadowed = before.w != 0u;
    }
    Receiver receiver;
    if (loadReceiver(pixel, receiver) && !isBehindLight(receiver)) {
        Lookup lookup = makeLookup(receiver);
        // A sample that does not count for this receiver shall make no difference: it goes with the shadow if the
        // vertices that every tree starts with see any, so that neither full light nor full shadow looks like a
        // penumbra.
        uint without[3] = uint[3](0u, 0u, 0u);
        int first = firstSlot();
        int end = slotCount();
        for (int i = 0; i < end; ++i) {
            int vertex = sampleOfSlot[first + i];
            BitPlace place = bitPlace(vertex);
            if (countOf(samples[vertex], receiver) == 0.0) {
                without[place.word] |= place.mask;
            } else if (sampleLit(layerOf(first + i), lookup) < 0.5) {
                words[place.word] |= place.mask;
                if (isBase(vertex)) isBaseShadowed = true;
            }
        }
        for (int i = 0; i < 3 && isBaseShadowed; ++i) words[i] |= without[i];
    }
    imageStore(shadowBits, texel, uvec4(words[0], words[1], words[2], isBaseShadowed));
}

// SPDX-License-Identifier: Apache-2.0
#version 450
// Sums what the receivers see of a batch's samples (equation 2, with weights). Variants of sample_test.glsl, and
// COLORED, where the light is textured; BITS, where the comparison left the shadow values of coarse samples.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/light_sampling/sample_test.glsl"

#ifdef COLORED
#define VALUE vec3
#define WEIGHT(light) light.weight.rgb
#define FORMAT rgba32f
#define FROM(texel) texel.rgb
#define TO(value) vec4(value, 1.0)
#else
#define VALUE float
#define WEIGHT(light) light.weight.a
#define FORMAT r32f
#define FROM(texel) texel.r
#define TO(value) vec4(value)
#endif

layout(binding = 0) uniform writeonly image2D visibility;
layout(binding = 1, FORMAT) uniform image2D seenSoFar;
layout(binding = 2, FORMAT) uniform image2D wholeSoFar;

#ifdef BITS
#include "src/techniques/light_sampling/subdivision_io.h"
#include "src/techniques/light_sampling/lattice_bits.glsl"
layout(binding = 4) uniform usampler2D shadowBits;
#endif

layout(location = 16) uniform ivec4 range;  // xy: slots of the batch to sum; z: starts the sum; w: ends it

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    bool starts = range.z == 1, ends = range.w == 1;
    Receiver receiver;
    if (!loadReceiver(pixel, receiver)) {
        if (ends) imageStore(visibility, pixel, vec4(1.0));
        return;
    }
    VALUE seen = VALUE(0.0), whole = VALUE(0.0);
    if (!starts) {
        seen = FROM(imageLoad(seenSoFar, pixel));
        whole = FROM(imageLoad(wholeSoFar, pixel));
    }
    if (!isBehindLight(receiver)) {
        Lookup lookup = makeLookup(receiver);
#ifdef BITS
        // Every slot before this stage.
        uvec4 bits = texelFetch(shadowBits, pixel, 0);
        uint words[3] = uint[3](bits.x, bits.y, bits.z);
        for (int slot = 0; starts && slot < plan.stages[stage].x; ++slot) {
            int vertex = sampleOfSlot[slot];
            LightSample light = samples[vertex];
            precise VALUE weight = countOf(light, receiver) * WEIGHT(light);
            BitPlace place = bitPlace(vertex);
            whole += weight;
            seen += (words[place.word] & place.mask) == 0u ? weight : VALUE(0.0);
        }
#endif
        int first = firstSlot();
        int end = min(slotCount(), range.y);
        for (int i = range.x; i < end; ++i) {
            LightSample light = samples[sampleOfSlot[first + i]];
            float count = countOf(light, receiver);
            if (count == 0.0) continue;
            precise VALUE weight = count * WEIGHT(light);
            whole += weight;
            seen += weight * (faces > 0 ? sampleLit(layerOf(first + i), lookup) : 1.0);
        }
    }
    if (!ends) {
        imageStore(seenSoFar, pixel, TO(seen));
        imageStore(wholeSoFar, pixel, TO(whole));
        return;
    }
    // Everything seen sums up the same addends as everything there is: the quotient is 1 exactly.
#ifdef COLORED
    vec3 quotient = vec3(whole.r > 0.0 ? seen.r / whole.r : 0.0, whole.g > 0.0 ? seen.g / whole.g : 0.0,
                         whole.b > 0.0 ? seen.b / whole.b : 0.0);
#else
    float quotient = whole > 0.0 ? seen / whole : 0.0;
#endif
    imageStore(visibility, pixel, TO(clamp(quotient, VALUE(0.0), VALUE(1.0))));
}

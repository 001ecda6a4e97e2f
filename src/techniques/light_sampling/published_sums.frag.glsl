// SPDX-License-Identifier: Apache-2.0
#version 450
// Reprojection (section 3.3.2) and the first pass of the comparison (3.3.3): how many corners of a quad a fragment of the
// comparison target is in the shadow of. Variants of sample_test.glsl.
#include "src/techniques/common/view.glsl"
#include "src/techniques/light_sampling/sample_test.glsl"
#include "src/techniques/light_sampling/published_io.h"

layout(std140) uniform Constants { PublishedConstants constants; };

layout(location = 0) out uint sum;
layout(location = 1) out vec4 color;  // Figure 6: red 1, green 2, blue 3

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy * vec2(view.size_px) / vec2(constants.target_px));
    sum = 0u;
    Receiver receiver;
    if (loadReceiver(pixel, receiver) && !isBehindLight(receiver)) {
        Lookup lookup = makeLookup(receiver);
        // Samples below the receiver's horizon are no part of the light to it: they go with the shadow, if there is any.
        uint below = 0u;
        for (int i = 0; i < constants.corners; ++i) {
            int slot = constants.slots[i / 4][i % 4];
            if (countOf(samples[sampleOfSlot[slot]], receiver) == 0.0) ++below;
            else if (sampleLit(layerOf(slot), lookup) < 0.5) ++sum;
        }
        if (sum > 0u) sum += below;
    }
    color = vec4(sum == 1u, sum == 2u, sum == 3u, 1.0);
}

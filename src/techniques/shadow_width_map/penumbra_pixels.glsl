// SPDX-License-Identifier: Apache-2.0
// The pixels that may be in a penumbra, in no order: 16 bits a coordinate. Groups of 64 are an indirect dispatch's.
layout(std430, binding = 1) buffer PenumbraPixels {
    uint groupCount, groupRows, groupLayers, pixelCount;
    uint penumbraPixels[];
};

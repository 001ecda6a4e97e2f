// SPDX-License-Identifier: Apache-2.0
// The pixels that may be in a penumbra, and of these the ones that may be among several edges, in no order: 16 bits a
// coordinate. Groups of 64 are an indirect dispatch's.
layout(std430) buffer PenumbraPixels {
    uint groupCount, groupRows, groupLayers, pixelCount;
    uint penumbraPixels[];
};
layout(std430) buffer CrowdedPixels {
    uint crowdedGroups, crowdedRows, crowdedLayers, crowdedCount;
    uint crowdedPixels[];
};

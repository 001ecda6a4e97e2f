// SPDX-License-Identifier: Apache-2.0
// The tiles of 8 x 8 pixels that have a penumbra in them, in no order; their number is an indirect dispatch's.
layout(std430, binding = 1) buffer PenumbraTiles {
    uint tileCount, tileRows, tileLayers, padding;
    uint penumbraTiles[];
};
layout(std430, binding = 2) buffer ListedTiles { uint isListed[]; };

// SPDX-License-Identifier: Apache-2.0
// What a light camera sees in a texel. Includer includes smoothies.glsl.
uniform sampler2DArray depthMaps;
// What receives without casting is not in the depth maps, but smoothies fall on it all the same. These maps are coarse:
// the widths of smoothies depend on them, not what is in shadow.
uniform sampler2DArray receiverMaps;
layout(std140) uniform Constants { ConstructionConstants construction; };

// The nearness of the closest blocker in a texel of the depth maps; where there is none, of the farthest receiver.
float blockerNearness(int camera, int layer, ivec2 texel) {
    return storedNearness(camera, texelFetch(depthMaps, ivec3(texel, layer), 0).r);
}

// The same of what only receives.
float receiverNearness(int camera, int layer, ivec2 texel) {
    if (!construction.hasReceiverMaps) return smoothies[camera].farthestReceiver;
    ivec2 coarse = texel * textureSize(receiverMaps, 0).xy / textureSize(depthMaps, 0).xy;
    return storedNearness(camera, texelFetch(receiverMaps, ivec3(coarse, layer), 0).r);
}

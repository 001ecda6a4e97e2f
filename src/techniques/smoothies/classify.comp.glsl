// SPDX-License-Identifier: Apache-2.0
#version 450
// Answers for all pixels that no smoothie reaches, by the depth map alone, and lists the tiles of the picture that hold
// others.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/smoothies/lookup.glsl"
#include "src/techniques/smoothies/tiles.glsl"

uniform writeonly image2D visibility;

// True where the depth map does not tell. `seen` is right where it does.
bool needsSmoothies(Receiver receiver, out float seen) {
    seen = 1.0;
    Horizon horizon = horizonOf(receiver);
    Lookup l;
    if (horizon.height <= -1.0) {
        seen = 0.0;
        return false;
    }
    if (findCamera(receiver, l)) {
        // One comparison is enough: where the nearest texels disagree, there is a smoothie.
        ivec2 texel = ivec2(l.point.uv * float(textureSize(depthMaps, 0).x));
        bool behind = isBehindBlocker(l, texel, 64.0 * l.point.texel_m, 0.0);
        seen = behind ? 0.0 : 1.0;
        if (!picture.hasSmoothies) return false;
        bool inner = behind && smoothies[0].hasInnerHalf;
        if (!behind && edgeAt(l, texel, layerOuter) != noEdge) return true;
        for (int layer = firstInnerLayer; inner && layer < layersPerCamera; ++layer) {
            if (edgeAt(l, texel, layer) != noEdge) return true;
        }
    }
    return picture.hasSmoothies && seen > 0.0 && horizon.height < 1.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    float seen = 1.0;
    Receiver receiver;
    if (loadReceiver(pixel, receiver) && needsSmoothies(receiver, seen)) listTile(gl_WorkGroupID.xy, gl_NumWorkGroups.xy);
    imageStore(visibility, pixel, vec4(seen));
}

// SPDX-License-Identifier: Apache-2.0
#version 450
// Answers for all pixels that no smoothie reaches, by the depth map alone, and lists the tiles of the picture that hold
// others.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/smoothies/lookup.glsl"
#include "src/techniques/smoothies/tiles.glsl"

layout(binding = 0) uniform writeonly image2D visibility;
layout(location = 3) uniform bool hasSmoothies;  // without: a hard shadow

shared bool needed;

// True where the depth map does not tell. `seen` is right where it does.
bool needsSmoothies(Receiver receiver, out float seen) {
    seen = 1.0;
    Horizon horizon = horizonOf(receiver);
    Lookup l;
    if (horizon.height <= -1.0) {
        seen = 0.0;
        return false;
    }
    bool isSeen = findCamera(receiver, l);
    if (!hasSmoothies) {
        if (isSeen) {
            ivec2 texel = ivec2(l.point.uv * float(textureSize(depthMaps, 0).x));
            seen = isBehindBlocker(l, texel, 64.0 * l.point.texel_m) ? 0.0 : 1.0;
        }
        return false;
    }
    if (isSeen) {
        Neighbours n = neighboursOf(l);
        if (n.behind > 0.0 && n.behind < 1.0) return true;
        seen = 1.0 - n.behind;
        if (n.behind == 0.0) {
            if (edgeAt(l, n.litTexel, layerOuter) != noEdge) return true;
        } else if (smoothies[0].settings.w == 1) {
            for (int layer = firstInnerLayer; layer < layersPerCamera; ++layer) {
                if (edgeAt(l, n.behindTexel, layer) != noEdge) return true;
            }
        }
    }
    return seen > 0.0 && horizon.height < 1.0;
}

void main() {
    if (gl_LocalInvocationIndex == 0u) needed = false;
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool inPicture = all(lessThan(pixel, view.size_px.xy));
    Receiver receiver;
    if (inPicture && loadReceiver(pixel, receiver)) {
        float seen;
        if (needsSmoothies(receiver, seen)) needed = true;
        imageStore(visibility, pixel, vec4(seen));
    } else if (inPicture) {
        imageStore(visibility, pixel, vec4(1.0));
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && needed) listTile(gl_WorkGroupID.xy);
}

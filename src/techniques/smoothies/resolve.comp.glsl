// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 5, in the tiles that smoothies reach. Alpha and equation 1 are worked out here, for
// the pixel's own receiver and the edges that were found to be deepest. Variants: COLORED, for textured lights.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/smoothies/lookup.glsl"
#include "src/techniques/smoothies/light_profile.glsl"
#include "src/techniques/smoothies/past_edges.glsl"
#include "src/techniques/smoothies/map_check.glsl"
#include "src/techniques/common/map_proof.glsl"
#include "src/techniques/smoothies/tiles.glsl"

uniform sampler2DArray farthestMaps;
uniform writeonly image2D visibility;

// A sliver of a light above the horizon is taken for none: the quotient of two such parts is all noise.
const float leastPart = 0.004;

// Smoothies are as wide as the light makes them, and not as the paper's parameters do.
bool isOfLight(int camera) {
    SmoothieConstants c = smoothies[camera];
    return c.hasInnerHalf && c.falloff == falloffLight && c.isRemapped && c.fixedWidth == 0.0;
}

// `isWhole`: all of the light is above the receiver's horizon. `highest`: the nearness of the highest blocker that was found.
Seen visibilityAt(Lookup l, bool isWhole, out float highest) {
    highest = nearnessOf(l.camera, l.point.posFace.z);
    Neighbours n = neighboursOf(l);
    PastEdge past[layersPerCamera];
    past[layerOuter] = pastEdgeNear(l, n.litTexel, layerOuter);
    PastEdge near = past[layerOuter];
    // As in the paper's code: with a blocker among the four texels it is umbra, and no silhouette has pinholes.
    if (!smoothies[l.camera].hasInnerHalf) return n.behind > 0.0 ? Seen(0.0) : near.seen;

    // What a receiver sees that does not see the light's centre; and one that does, past the far side of a thin blocker.
    ivec2 innerTexel = n.behind > 0.0 ? n.behindTexel : n.litTexel;
    Seen opposite = Seen(0.0), behind = Seen(0.0), most = Seen(0.0);
    for (int i = firstInnerLayer; i < layersPerCamera; ++i) {
        past[i] = pastEdgeNear(l, innerTexel, i);
        if (dot(near.outward, past[i].outward) < -0.5) opposite = max(opposite, past[i].seen);
        behind += past[i].seen;
        most = max(most, past[i].seen);
    }
    for (int i = 0; i < innerLayers; ++i) {
        behind -= pastBoth(past[firstInnerLayer + i], past[firstInnerLayer + (i + 1) % innerLayers]);
    }
    for (int i = 0; i < layersPerCamera; ++i) {
        if (isEdge(past[i])) highest = max(highest, past[i].nearness);
    }
    if (n.behind > 0.0) {
        float above = texelFetch(depthMaps, ivec3(n.behindTexel, l.camera), 0).r;
        highest = max(highest, storedNearness(l.camera, above));
    }
    Seen seen = mix(min(near.seen + opposite, 1.0), clamp(behind, most, Seen(1.0)), n.behind);
#ifndef COLORED
    if (isWhole && isOfLight(l.camera)) seen = checkedByMap(l, n, past, seen);
#endif
    return seen;
}

void main() {
    uint index = gl_WorkGroupID.y * uint(tilesPerRow) + gl_WorkGroupID.x;
    if (index >= tileCount) return;
    ivec2 pixel = tileSize_px * ivec2(tiles[index] & 0xffffu, tiles[index] >> 16) + ivec2(gl_LocalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    Lookup l;
    Seen seen = Seen(1.0);
    if (loadReceiver(pixel, receiver) && findCamera(receiver, l)) {
        // Edges tell the part of the whole light that is seen. A surface's own horizon is an edge like others, which is
        // why smoothies darken the terminator; asked for is the part of what is above that horizon.
        Horizon horizon = horizonOf(receiver);
        Seen above = horizon.height < 1.0 ? partBeside(0, horizon.extent, horizon.height) : Seen(1.0);
        float highest;
        seen = visibilityAt(l, horizon.height >= 1.0, highest);
        seen = step(leastPart, above) * min(seen / max(above, leastPart), 1.0);
        if (isOfLight(l.camera)) {
            SmoothieConstants c = smoothies[l.camera];
            MapReceiver mapped = MapReceiver(l.camera, c.camera.window, c.camera.depth, l.point.posFace, l.normalFace, l.tolerance_m);
            seen = within(proofOf(depthMaps, farthestMaps, picture.hasFarthestMaps, mapped, lightFigure(l.camera), highest), seen);
        }
    }
#ifdef COLORED
    imageStore(visibility, pixel, vec4(seen, 1.0));
#else
    imageStore(visibility, pixel, vec4(seen));
#endif
}

// SPDX-License-Identifier: Apache-2.0
#version 450
// Chan and Durand 2003, section 3, step 5, in the tiles that smoothies reach. Alpha and equation 1 are worked out here, for
// the pixel's own receiver and the edges that were found to be deepest. Variants: COLORED, for textured lights.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/smoothies/lookup.glsl"
#include "src/techniques/smoothies/light_profile.glsl"
#include "src/techniques/smoothies/smoothie_edges_io.h"
#include "src/techniques/smoothies/tiles.glsl"

layout(std430, binding = 2) readonly buffer SmoothieEdges { SmoothieEdge smoothieEdges[]; };
layout(binding = 0) uniform writeonly image2D visibility;
layout(location = 3) uniform uint capacity;  // edges for each camera

// A sliver of a light above the horizon is taken for none: the quotient of two such parts is all noise.
const float leastPart = 0.004;

// What comes past one silhouette edge.
struct PastEdge {
    Seen seen;
    vec2 outward;  // away from the blocker, unit length; zero where there is no edge
};

PastEdge pastEdge(Lookup l, ivec2 texel, int layer) {
    bool inner = layer != layerOuter;
    PastEdge nothing = PastEdge(Seen(inner ? 0.0 : 1.0), vec2(0.0));
    uint number = edgeAt(l, texel, layer);
    if (number == noEdge) return nothing;
    SmoothieEdge edge = smoothieEdges[uint(l.camera) * capacity + number];

    vec2 place = placeOf(l.camera, l.point.uv);
    vec2 along = edge.ends.zw - edge.ends.xy;
    float s = clamp(dot(place - edge.ends.xy, along) / dot(along, along), 0.0, 1.0);
    vec2 closest = edge.ends.xy + s * along;
    float blocker = mix(edge.nearness.x, edge.nearness.y, s);
    float receiver = nearnessOf(l.camera, l.point.posFace.z);
    vec2 offset = place - closest;
    float distance_ = length(offset);
    float windowTexel = smoothies[l.camera].camera.depth.w;

    // An edge shades what lies beyond it. What sees the light's centre must also have the edge above its plane, by more
    // than the tolerance: a surface lies under none of its own edges. What does not see it lies behind something anyway.
    float farthest_m = 2.0 * (distance_ / windowTexel + 2.0) * l.point.texel_m;
    if (receiver >= blocker) return nothing;
    if (!inner) {
        float plane_m = receiverPlaneDepth_m(l.camera, l.point, l.normalFace, uvOf(l.camera, closest), farthest_m);
        float nearest_m = min(plane_m, l.point.posFace.z) - l.tolerance_m;
        if (nearnessOf(l.camera, nearest_m) >= blocker) return nothing;
    }

    // The texel tells on which side of the edge it lies, and the receiver may lie on the other.
    vec2 side = normalize(vec2(along.y, -along.x));
    float towards = inner ? -1.0 : 1.0;
    if (towards * dot(offset, side) < 0.0 && distance_ < 1.5 * smoothieTexel_px * windowTexel) towards = -towards;
    vec2 outward = distance_ > 1e-3 * windowTexel ? towards * offset / distance_ : side;

    LightExtent extent = lightExtent(l.camera, place, outward);
    float width = smoothieWidth(l.camera, extent.half_m, blocker, receiver);
    float x = towards * distance_ / width;
    if (x <= -1.0) return PastEdge(Seen(0.0), outward);
    // With the inner half, the outer one spans the outer half of the penumbra; alone, it stands for all of it.
    if (smoothies[l.camera].settings.w == 0) return PastEdge(falloff(l.camera, extent, 2.0 * max(x, 0.0) - 1.0), outward);
    if (inner) {
        // The receiver's plane must be lit just beyond the edge, or else something under the blocker covers it too.
        ivec2 beyond = texelOf(l.camera, closest + beyondTexels * windowTexel * outward, textureSize(depthMaps, 0).x);
        if (isBehindBlocker(l, beyond, farthest_m)) return nothing;
    }
    return PastEdge(falloff(l.camera, extent, x), outward);
}

// The part of the light that comes past both of two edges: none where they face away from each other, the lesser where
// they face the same way, and the product at a right angle, which is exact for a rect whose sides they are parallel to.
Seen pastBoth(PastEdge a, PastEdge b) {
    float cosine = dot(a.outward, b.outward);
    Seen product = a.seen * b.seen;
    return cosine < 0.0 ? mix(product, max(a.seen + b.seen - 1.0, 0.0), -cosine)
                        : mix(product, min(a.seen, b.seen), cosine);
}

Seen visibilityAt(Receiver receiver) {
    Lookup l;
    if (!findCamera(receiver, l)) return Seen(1.0);
    Neighbours n = neighboursOf(l);
    PastEdge near = pastEdge(l, n.litTexel, layerOuter);
    if (smoothies[l.camera].settings.w == 0) return (1.0 - n.behind) * near.seen;

    // What a receiver sees that does not see the light's centre; and one that does, past the far side of a thin blocker.
    ivec2 texel = n.behind > 0.0 ? n.behindTexel : n.litTexel;
    PastEdge inner[innerLayers];
    Seen opposite = Seen(0.0), behind = Seen(0.0), most = Seen(0.0);
    for (int i = 0; i < innerLayers; ++i) {
        inner[i] = pastEdge(l, texel, firstInnerLayer + i);
        if (dot(near.outward, inner[i].outward) < -0.5) opposite = max(opposite, inner[i].seen);
        behind += inner[i].seen;
        most = max(most, inner[i].seen);
    }
    for (int i = 0; i < innerLayers; ++i) behind -= pastBoth(inner[i], inner[(i + 1) % innerLayers]);
    return mix(min(near.seen + opposite, 1.0), clamp(behind, most, Seen(1.0)), n.behind);
}

void main() {
    uint index = gl_WorkGroupID.y * uint(tilesPerRow) + gl_WorkGroupID.x;
    if (index >= tileCount) return;
    ivec2 pixel = tileSize_px * ivec2(tiles[index] & 0xffffu, tiles[index] >> 16) + ivec2(gl_LocalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    Seen seen = Seen(1.0);
    if (loadReceiver(pixel, receiver)) {
        // Edges tell the part of the whole light that is seen. A surface's own horizon is an edge like others, which is
        // why smoothies darken the terminator; asked for is the part of what is above that horizon.
        Horizon horizon = horizonOf(receiver);
        Seen above = horizon.height < 1.0 ? partBeside(0, horizon.extent, horizon.height) : Seen(1.0);
        seen = step(leastPart, above) * min(visibilityAt(receiver) / max(above, leastPart), 1.0);
    }
#ifdef COLORED
    imageStore(visibility, pixel, vec4(seen, 1.0));
#else
    imageStore(visibility, pixel, vec4(seen));
#endif
}

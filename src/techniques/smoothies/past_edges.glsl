// SPDX-License-Identifier: Apache-2.0
// How much of the light comes past the silhouette edges that the maps name for a receiver: alpha, equation 1 and the
// falloff of Chan and Durand 2003. Includer includes lookup.glsl and light_profile.glsl.
#include "src/techniques/smoothies/smoothie_edges_io.h"

layout(std430) readonly buffer SmoothieEdges { SmoothieEdge smoothieEdges[]; };

struct PastEdge {
    Seen seen;       // the part of the light: all of it where there is no outer edge, nothing where no inner one
    vec2 outward;    // away from the blocker, unit length; zero where there is no edge
    float nearness;  // of the blocker
};

PastEdge pastNone(int layer) { return PastEdge(Seen(layer == layerOuter ? 1.0 : 0.0), vec2(0.0), 0.0); }

bool isEdge(PastEdge past) { return past.outward != vec2(0.0); }

PastEdge pastEdge(Lookup l, uint number, int layer) {
    bool inner = layer != layerOuter;
    PastEdge nothing = pastNone(layer);
    SmoothieEdge edge = smoothieEdges[uint(l.camera) * picture.capacity + number];

    vec2 place = placeOf(l.camera, l.point.uv);
    vec2 along = edge.ends.zw - edge.ends.xy;
    float s = clamp(dot(place - edge.ends.xy, along) / dot(along, along), 0.0, 1.0);
    vec2 closest = edge.ends.xy + s * along;
    float blocker = mix(edge.nearness.x, edge.nearness.y, s);
    float receiver = nearnessOf(l.camera, l.point.posFace.z);
    vec2 offset = place - closest;
    float distance_ = length(offset);
    float windowTexel = smoothies[l.camera].camera.depth.texelSize;

    // An edge shades what lies beyond it. What sees the light's centre must also have the edge above its plane, by more
    // than the tolerance: a surface lies under none of its own edges. What does not see it lies behind something anyway.
    float farthest_m = 2.0 * (distance_ / windowTexel + 2.0) * l.point.texel_m;
    if (receiver >= blocker) return nothing;
    if (!inner) {
        float plane_m = receiverPlaneDepth_m(l.camera, l.point, l.normalFace, uvOf(l.camera, closest), farthest_m, 0.0);
        if (nearnessOf(l.camera, plane_m - l.tolerance_m) >= blocker) return nothing;
    }

    // The texel tells on which side of the edge it lies, and the receiver may lie on the other.
    vec2 side = normalize(vec2(along.y, -along.x));
    float towards = inner ? -1.0 : 1.0;
    if (towards * dot(offset, side) < 0.0 && distance_ < 1.5 * smoothieTexel_px * windowTexel) towards = -towards;
    vec2 outward = distance_ > 1e-3 * windowTexel ? towards * offset / distance_ : side;

    LightExtent extent = lightExtent(l.camera, place, outward);
    float width = smoothieWidth(l.camera, extent.half_m, blocker, receiver);
    float x = towards * distance_ / width;
    if (x <= -1.0) return PastEdge(Seen(0.0), outward, blocker);
    // With the inner half, the outer one spans the outer half of the penumbra; alone, it stands for all of it.
    if (!smoothies[l.camera].hasInnerHalf) return PastEdge(falloff(l.camera, extent, 2.0 * max(x, 0.0) - 1.0), outward, blocker);
    if (inner) {
        // The receiver's plane must be lit just beyond the edge, or else something under the blocker covers it too.
        ivec2 beyond = texelOf(l.camera, closest + beyondTexels * windowTexel * outward, textureSize(depthMaps, 0).x);
        if (isBehindBlocker(l, beyond, farthest_m, farthest_m)) return nothing;
    }
    return PastEdge(falloff(l.camera, extent, x), outward, blocker);
}

// The edge that a texel names, or, where it names none that counts for the receiver itself, the neighbour's that the
// receiver is closest to: borders of smoothies follow their texels.
PastEdge pastEdgeNear(Lookup l, ivec2 depthTexel, int layer) {
    ivec2 size_px = textureSize(deepestEdges, 0).xy;
    ivec2 texel = depthTexel * size_px / textureSize(depthMaps, 0).xy;
    vec2 offset = l.point.uv * vec2(size_px) - (vec2(texel) + 0.5);
    ivec2 neighbour = texel + (abs(offset.x) > abs(offset.y) ? ivec2(sign(offset.x), 0) : ivec2(0, sign(offset.y)));
    PastEdge past = pastNone(layer);
    for (int i = 0; i < 2 && !isEdge(past); ++i) {
        uint number = texelFetch(deepestEdges, ivec3(texel, layersPerCamera * l.camera + layer), 0).r;
        if (number != noEdge) past = pastEdge(l, number, layer);
        texel = clamp(neighbour, ivec2(0), size_px - 1);
    }
    return past;
}

// The part of the light that comes past both of two edges: none where they face away from each other, the lesser where
// they face the same way, and the product at a right angle, which is exact for a rect whose sides they are parallel to.
Seen pastBoth(PastEdge a, PastEdge b) {
    float cosine = dot(a.outward, b.outward);
    Seen product = a.seen * b.seen;
    return cosine < 0.0 ? mix(product, max(a.seen + b.seen - 1.0, 0.0), -cosine)
                        : mix(product, min(a.seen, b.seen), cosine);
}

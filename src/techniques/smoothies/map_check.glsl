// SPDX-License-Identifier: Apache-2.0
// What edges tell of the light, checked against the depth map. Includer includes past_edges.glsl.
//
// What edges tell together is a guess wherever several open on the light, and even one goes by its tangent alone. Points of
// the light, looked for in the depth map at the edges' own nearness, tell better if the two disagree by more than the
// points' noise. Where the edges, and what hides the centre, do not lie at about one height, however, they are not taken
// to see more: a map does not tell what is under a blocker. And one edge alone is not taken to hide too little: on a bent
// surface the receiver's own plane, which points are compared with, is in the way.
#include "src/techniques/smoothies/glances.glsl"

const int points = 32;                      // some 0.03 rms off, on a straight edge
const float texelNoise = 0.15;              // and more by this, over the radius of the light's image in texels
const vec2 disagreement = vec2(0.05, 0.2);  // from where on points count, and count alone
const vec2 oneHeight = vec2(0.15, 0.3);     // of the way from the receiver to the highest edge
const float leastRadius_texels = 1.0;       // below, the map shows nothing of the light's size

#ifndef COLORED
float checkedByMap(Lookup l, Neighbours n, PastEdge past[layersPerCamera], float seen) {
    float receiver = nearnessOf(l.camera, l.point.posFace.z);
    vec2 range = vec2(1e30, -1e30);
    int several = 0;
    for (int i = 0; i < layersPerCamera; ++i) {
        if (!isEdge(past[i])) continue;
        range = vec2(min(range.x, past[i].nearness), max(range.y, past[i].nearness));
        if (i == layerOuter ? n.behind < 1.0 && past[i].seen < 1.0 : past[i].seen > 0.0) ++several;
    }
    if (several == 0) return seen;
    if (n.behind > 0.0) {
        // What hides the light's centre does so at a height of its own.
        float above = storedNearness(l.camera, texelFetch(depthMaps, ivec3(n.behindTexel, l.camera), 0).r);
        range = vec2(min(range.x, above), max(range.y, above));
    }
    vec2 place = placeOf(l.camera, l.point.uv);
    float radius_texels = lightExtent(l.camera, place, vec2(1.0, 0.0)).half_m * (range.y - receiver) /
                          smoothies[l.camera].camera.depth.texelSize;
    if (radius_texels < leastRadius_texels) return seen;

    // Edges at two heights: the upper ones' points count only what is up there, and likewise.
    float spread = (range.y - range.x) / (range.y - receiver), middle = 0.5 * (range.x + range.y);
    int heights = spread > oneHeight.x ? 2 : 1;
    float hidden = 0.0, known = 0.0;
    for (int i = 0; i < points; ++i) {
        Glance upper = glanceAt(l, i, heights == 2 ? range.y : middle);
        bool isHidden = upper.isHidden;
        if (heights == 2) {
            Glance lower = glanceAt(l, i, range.x);
            isHidden = isHidden || (lower.isHidden && lower.nearness < middle);
        }
        if (upper.isInWindow) known += 1.0;
        if (upper.isInWindow && isHidden) hidden += 1.0;
    }
    if (known < 0.5 * float(points)) return seen;
    float difference = 1.0 - hidden / known - seen;
    float trust = smoothstep(disagreement.x, disagreement.y, abs(difference) - texelNoise / radius_texels);
    if (difference > 0.0) trust *= 1.0 - smoothstep(oneHeight.x, oneHeight.y, spread);
    return difference > 0.0 || several > 1 ? seen + trust * difference : seen;
}
#endif

// SPDX-License-Identifier: Apache-2.0
#version 450
// How many layers lie between each receiver and the light's centre. Triangles answer here as their edges do in
// layer_counts.glsl, in the same arithmetic, so that what the edges change is changed from the right number: a count that
// is found by drawing is another one, wherever a side passes within rounding of a receiver, as it does at each contact.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"
#include "src/techniques/soft_shadow_volumes/light_area.glsl"
#include "src/techniques/soft_shadow_volumes/seen_edges.glsl"
#include "src/techniques/soft_shadow_volumes/tile_shaft.glsl"
#include "src/techniques/soft_shadow_volumes/near_clusters.glsl"

layout(r32ui) uniform uimage2D centerCounts;  // negative counts as in two's complement

// Whether a way is walked with the light's centre to its left. Asked of both faces of an edge from the same end.
bool hasLeft(vec3 aLight, vec3 bLight, vec3 a, vec3 b) {
    return isBefore(aLight, bLight) ? turnAround(a, b) >= 0.0 : !(turnAround(b, a) >= 0.0);
}

// What the triangle adds to the count: 1 where it is between the receiver and the light's centre. A sliver seen within
// rounding of edge-on may be turned, and adds -1 to what its neighbours have twice.
int layersOf(LightFrame frame, vec3 posLight, LightTriangle triangle) {
    float ofReceiver = sideOf(triangle.plane, posLight);
    float ofLight = volume.light.shape == shapeDistant ? triangle.plane.z : triangle.plane.w;
    if (ofReceiver * sign(ofLight) >= 0.0) return 0;
    // Beside an edge that a receiver's face shares with one turned away from the light, the receiver lies within rounding of
    // both planes. As computed it is behind the other one, which then hides nothing, however much the eye sees of it.
    if (distanceOf(triangle.plane, posLight) * sign(ofLight) >= 0.0) return 0;
    vec3 a = unitPlace(frame, posLight, triangle.a.xyz), b = unitPlace(frame, posLight, triangle.b.xyz),
         c = unitPlace(frame, posLight, triangle.c.xyz);
    bool left = hasLeft(triangle.a.xyz, triangle.b.xyz, a, b);
    if (left != hasLeft(triangle.b.xyz, triangle.c.xyz, b, c) || left != hasLeft(triangle.c.xyz, triangle.a.xyz, c, a))
        return 0;
    return left == (ofReceiver * frame.handedness < 0.0) ? 1 : -1;
}

// Whether the way from the receiver to the light's centre may meet the box (separating axes: Gottschalk et al. 1996).
bool mayCross(vec3 posLight, TriangleCluster cluster) {
    vec3 way = volume.light.shape == shapeDistant ? vec3(0.0, 0.0, max(volume.highest_m - posLight.z, 0.0)) : -posLight;
    vec3 halfWay = 0.5 * way, reach = 0.5 * (cluster.high.xyz - cluster.low.xyz);
    vec3 between = posLight + halfWay - 0.5 * (cluster.low.xyz + cluster.high.xyz);
    reach += shaftRounding * (abs(posLight) + abs(cluster.low.xyz) + abs(cluster.high.xyz));
    vec3 along = abs(halfWay);
    vec3 turned = abs(cross(halfWay, between)), limit = reach.yzx * along.zxy + reach.zxy * along.yzx;
    return all(lessThanEqual(abs(between), reach + along)) && all(lessThanEqual(turned, limit));
}

void main() {
    uint tile = gl_WorkGroupID.y * volume.smallTilesAcross + gl_WorkGroupID.x;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    TileBounds tileBounds = bounds[tile];
    if (tileBounds.low.x > tileBounds.high.x) return;
    prepareShaft(tileBounds, centerBounds(tileBounds));
    listNear(clustersAtOnce);

    Receiver receiver;
    LightFrame frame;
    if (nearCount == 0u || any(greaterThanEqual(texel, volume.buffer_px)) || !loadLiftedReceiver(texel, receiver) ||
        !makeLightFrame(receiver, frame) || frame.isInside)
        return;
    int count = 0;
    for (uint i = 0u; i < nearCount; ++i) {
        uint cluster = near[i];
        if (!mayCross(receiver.posLight, clusters[cluster])) continue;
        for (uint j = 0u; j < clusterTriangles; ++j)
            count += layersOf(frame, receiver.posLight, triangles[cluster * clusterTriangles + j]);
    }
    if (count != 0) imageAtomicAdd(centerCounts, texel, uint(count));
}

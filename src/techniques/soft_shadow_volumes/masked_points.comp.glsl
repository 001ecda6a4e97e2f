// SPDX-License-Identifier: Apache-2.0
#version 450
// Which points of the light a caster with holes hides. Its triangles are asked one by one, and where one is met, its mask:
// edges do not know of holes.
//
// SAMPLES: see point_places.glsl; CLUSTERS_AT_ONCE: how many a group goes through.
layout(local_size_x = 8, local_size_y = 8) in;
#ifndef CLUSTERS_AT_ONCE
#define CLUSTERS_AT_ONCE 16
#endif

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"
#include "src/techniques/soft_shadow_volumes/light_area.glsl"
#include "src/techniques/soft_shadow_volumes/light_points.glsl"
#include "src/techniques/soft_shadow_volumes/point_places.glsl"
#include "src/techniques/soft_shadow_volumes/seen_edges.glsl"
#include "src/techniques/soft_shadow_volumes/tile_shaft.glsl"
#include "src/techniques/soft_shadow_volumes/near_clusters.glsl"

layout(std430) readonly buffer Indices { uint indices[]; };
layout(std430) readonly buffer Uvs { vec2 uvs[]; };
uniform sampler2D alphaTexture;
// A bit a point, in layers of 32.
layout(r32ui) uniform uimage2DArray hiddenPoints;

const int wordCount = SAMPLES / 32 + (SAMPLES % 32 == 0 ? 0 : 1);
uint hidden[wordCount];

bool isSolid(uint triangle, vec3 share) {
    uint first = 3u * (listed.firstTriangle + triangle);
    vec2 uv = share.x * uvs[indices[first]] + share.y * uvs[indices[first + 1u]] + share.z * uvs[indices[first + 2u]];
    return textureLod(alphaTexture, uv, 0.0).a * listed.alphaFactor >= listed.alphaCutoff;
}

// Marks the points that the triangle hides from the receiver.
void markHidden(LightFrame frame, vec3 posLight, uint index) {
    LightTriangle triangle = triangles[index];
    float ofReceiver = sideOf(triangle.plane, posLight) * frame.handedness;
    vec3 a = unitPlace(frame, posLight, triangle.a.xyz), b = unitPlace(frame, posLight, triangle.b.xyz),
         c = unitPlace(frame, posLight, triangle.c.xyz);
    vec3 low = min(a, min(b, c)), x = vec3(a.x, b.x, c.x), y = vec3(a.y, b.y, c.y), z = vec3(a.z, b.z, c.z);
    bool isBeside = all(greaterThan(x, z)) || all(lessThan(x, -z)) || all(greaterThan(y, z)) || all(lessThan(y, -z));
    if (isBeside || ofReceiver == 0.0 || max(a.z, max(b.z, c.z)) <= 0.0 || (!frame.isEndless && low.z >= 1.0)) return;
    vec3 ofA = cross(b, c), ofB = cross(c, a), ofC = cross(a, b);
    float spanned = dot(a, ofA);
    for (int i = 0; i < SAMPLES; ++i) {
        if ((hidden[i >> 5] & (1u << (i & 31))) != 0u) continue;
        vec3 way = vec3(samplePlace(frame, i), 1.0);
        vec3 share = vec3(dot(ofA, way), dot(ofB, way), dot(ofC, way));
        bvec3 isLeft = greaterThanEqual(share, vec3(0.0));
        if (isLeft.x != isLeft.y || isLeft.y != isLeft.z) continue;
        // Met on the receiver's side that its plane says, and before the light.
        float sum = share.x + share.y + share.z;
        bool isBefore = sum * ofReceiver < 0.0 && (frame.isEndless || abs(spanned) < abs(sum));
        if (isBefore && isSolid(index, share / sum)) hidden[i >> 5] |= 1u << (i & 31);
    }
}

void main() {
    uint tile = gl_WorkGroupID.y * volume.smallTilesAcross + gl_WorkGroupID.x;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    TileBounds tileBounds = bounds[tile];
    if (tileBounds.low.x > tileBounds.high.x) return;
    prepareShaft(tileBounds, lightBounds(tileBounds));
    listNear(uint(CLUSTERS_AT_ONCE));

    Receiver receiver;
    LightFrame frame;
    if (nearCount == 0u || any(greaterThanEqual(texel, volume.buffer_px)) || !loadLiftedReceiver(texel, receiver) ||
        !makeLightFrame(receiver, frame) || horizonSide(frame) < 0)
        return;
    spreadPoints(frame);
    for (int i = 0; i < wordCount; ++i) hidden[i] = 0u;
    for (uint i = 0u; i < nearCount; ++i) {
        for (uint j = 0u; j < clusterTriangles; ++j)
            markHidden(frame, receiver.posLight, near[i] * clusterTriangles + j);
    }
    for (int i = 0; i < wordCount; ++i) {
        if (hidden[i] != 0u) imageAtomicOr(hiddenPoints, ivec3(texel, i), hidden[i]);
    }
}

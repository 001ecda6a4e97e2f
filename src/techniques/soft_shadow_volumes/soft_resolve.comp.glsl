// SPDX-License-Identifier: Apache-2.0
#version 450
// Visibility from the edges that matter to a tile (README.md, "Counting layers").
//
// SAMPLES: the number of points of the light at which layers are counted.
#ifndef SAMPLES
#define SAMPLES 64
#endif
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"
#include "src/techniques/soft_shadow_volumes/light_area.glsl"
#include "src/techniques/soft_shadow_volumes/tile_shaft.glsl"

layout(std430, binding = 0) readonly buffer Bounds { TileBounds bounds[]; };
layout(std430, binding = 1) readonly buffer LightEdges { LightEdge lightEdges[]; };
layout(std430, binding = 2) readonly buffer Eye { EyeState eye; };
layout(std430, binding = 3) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 4) readonly buffer Samples { vec4 samples[]; };   // xy: place in unit space; z: rank from the centre; w: direction in turns, rising
layout(std430, binding = 5) readonly buffer Radiances { vec4 radiances[]; };
layout(binding = 3) uniform sampler2D volumeCounts;
layout(binding = 0) uniform writeonly image2D visibility;
layout(binding = 1, r32f) uniform writeonly image2D edgeCounts;

const uint wordsAtOnce = 64u;
shared uint mattering[wordsAtOnce * 32u];
shared uint matteringCount;

// A sphere shows its directions, not the area of its disk. Above this tangent (of some 9 degrees) the two differ by more
// than a hundredth, and samples are placed by solid angle.
const float wideLight = 0.15;

vec2 samplePlace(LightFrame frame, int i) {
    vec4 s = samples[i];
    if (frame.tangent <= wideLight) return s.xy;
    // Uniform in solid angle: the cosine falls linearly with the share of the cone.
    float tangent2 = frame.tangent * frame.tangent;
    float cosine = 1.0 - s.z * (1.0 - inversesqrt(1.0 + tangent2));
    return s.xy * sqrt((1.0 / (cosine * cosine) - 1.0) / (s.z * tangent2));
}

const float fixedOne = 1048576.0;  // integers add up to the same in any order

// Changes in the number of layers from the light's centre to its other points. Not in a struct that is handed around,
// which some compilers copy.
int changes[SAMPLES];
int leastChange = 2;  // of any edge: how many layers the thinnest blocker has
int changeAtTop = 0;  // at the light's highest point over the horizon
int meanChangeFixed = 0;  // exact mean over the light, times fixedOne

// The light's point that is highest over the receiver's horizon.
vec2 topPlace(LightFrame frame) {
    vec2 up = frame.horizon.xy;
    if (isSquareLight()) return vec2(up.x < 0.0 ? -1.0 : 1.0, up.y < 0.0 ? -1.0 : 1.0);
    return up == vec2(0.0) ? vec2(1.0, 0.0) : normalize(up);
}

// The share of the light over the horizon, where it is small: a square's corner or a disk's segment.
float shareOverHorizon(LightFrame frame) {
    vec2 slope = abs(frame.horizon.xy);
    if (isSquareLight()) {
        float above = slope.x + slope.y + frame.horizon.z;
        return min(above * above / (8.0 * slope.x * slope.y + 1e-30), above / (2.0 * max(slope.x, slope.y)));
    }
    return 0.6 * pow(1.0 + frame.horizon.z / length(slope), 1.5);
}

// Less of the light than a quarter of what a sample stands for is nothing: grazing the surface, it carries a
// hundred-thousandth of the light's irradiance.
const float leastShare = 0.25 / float(SAMPLES);

// Whether the way from the light's centre to `s` crosses the edge from `a` to `b`. What is asked of each end is asked in
// the same way of the other edges there, so that one of them is crossed and no more.
bool isCrossed(vec2 a, vec2 b, float turn, vec2 s) {
    bool isBetween = (a.x * s.y - a.y * s.x >= 0.0) != (b.x * s.y - b.y * s.x >= 0.0);
    float beyond = (b.x - a.x) * (s.y - a.y) - (b.y - a.y) * (s.x - a.x);
    return isBetween && beyond * turn < 0.0;
}

float directionOf(vec2 d) { return fract(atan(d.y, d.x) / lightTau); }

const float directionRounding = 1e-4;  // turns; a hundred times what atan is off

// The first point whose direction is not before this one; SAMPLES becomes 0, since directions go round.
int firstSampleFrom(float direction) {
    int low = 0, high = SAMPLES;
    // Nine halvings do for 256 points; without an exit in between, so that compilers unroll them.
    for (int step = 0; step < 9; ++step) {
        int middle = (low + high) / 2;
        bool isBefore = low < high && samples[middle].w < direction;
        high = isBefore ? high : middle;
        low = isBefore ? middle + 1 : low;
    }
    return low % SAMPLES;
}

// Adds what an edge changes on the way from the light's centre to each of its points.
bool addEdge(LightFrame frame, Receiver receiver, vec2 top, LightEdge edge) {
    vec4 p = vec4(receiver.posLight, 1.0);
    float weight = sign(dot(edge.planes[0], p)) + sign(dot(edge.planes[1], p));
    vec3 a, b;
    if (weight == 0.0 || !edgeBeforeLight(frame, receiver.posLight, edge.aLight.xyz, edge.bLight.xyz, a, b)) return false;
    a.xy /= a.z;
    b.xy /= b.z;
    float turn = a.x * b.y - a.y * b.x;
    if (turn == 0.0) return false;
    int change = int(sign(turn) * weight * frame.handedness);
    leastChange = min(leastChange, abs(change));
    meanChangeFixed += change * int(shareBeyond(a.xy, b.xy) * fixedOne + 0.5);
    // Only points in the directions between the edge's ends can lie behind it; they follow each other in the list.
    float first = directionOf(turn > 0.0 ? a.xy : b.xy), last = directionOf(turn > 0.0 ? b.xy : a.xy);
    float span = fract(last - first) + 2.0 * directionRounding;
    first = fract(first - directionRounding);
    int start = firstSampleFrom(first);
    for (int n = 0; n < SAMPLES; ++n) {
        int i = start + n < SAMPLES ? start + n : start + n - SAMPLES;
        if (fract(samples[i].w - first) > span) break;
        changes[i] += isCrossed(a.xy, b.xy, turn, samplePlace(frame, i)) ? change : 0;
    }
    changeAtTop += isCrossed(a.xy, b.xy, turn, top) ? change : 0;
    return true;
}

vec3 visibilityOf(LightFrame frame, int atCenter) {
    vec3 seen = vec3(0.0), all = vec3(0.0);
    int points = 0, covered = 0, layerSum = 0, least = 1 << 20, most = 0;
    bool isTextured = volume.lightKind.w == 1;
    bool isCut = horizonSide(frame) == 0;
    for (int i = 0; i < SAMPLES; ++i) {
        if (isCut && !isAboveHorizon(frame, samplePlace(frame, i))) continue;
        vec3 radiance = isTextured ? radiances[i].rgb : vec3(1.0);
        int count = max(changes[i] + atCenter, 0);
        all += radiance;
        ++points;
        if (count == 0) {
            seen += radiance;
        } else {
            ++covered;
            layerSum += count;
            least = min(least, count);
            most = max(most, count);
        }
    }
    // A sliver of the light over the horizon that no sample lies on is seen where its highest point is.
    if (points == 0) return vec3(shareOverHorizon(frame) > leastShare && changeAtTop + atCenter <= 0 ? 1.0 : 0.0);
    vec3 share = vec3(1.0 - float(covered) / float(points));  // where a channel is black all over
    vec3 sampled = mix(share, seen / max(all, 1e-30), greaterThan(all, vec3(0.0)));
    if (isTextured || isCut || frame.tangent > wideLight) return sampled;

    // The exact mean number of layers tells how far the samples' own mean is off; where every blocker is as many layers
    // deep, their share follows exactly.
    float mean = float(meanChangeFixed) / fixedOne + float(atCenter);
    if (covered == 0) return vec3(clamp(1.0 - mean / float(leastChange), 1.0 - 1.0 / float(SAMPLES), 1.0));
    float depth = float(layerSum) / float(covered);
    float corrected = 1.0 - mean / depth;
    if (least < most) {
        float limit = covered == SAMPLES ? 0.0 : 2.0 / float(SAMPLES);
        corrected = clamp(corrected, sampled.r - limit, sampled.r + limit);
    }
    return vec3(clamp(corrected, 0.0, 1.0));
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    uint lane = gl_LocalInvocationIndex;
    bool isInside = all(lessThan(texel, volume.buffer_px.xy));

    Receiver receiver;
    LightFrame frame;
    bool isReceiver = isInside && loadLiftedReceiver(texel, receiver);
    bool seesLight = isReceiver && makeLightFrame(receiver, frame) && horizonSide(frame) >= 0;
    for (int i = 0; i < SAMPLES; ++i) changes[i] = 0;
    vec2 top = seesLight ? topPlace(frame) : vec2(0.0);
    int edgesCounted = 0;

    uint tile = gl_WorkGroupID.y * uint(volume.tiles.x) + gl_WorkGroupID.x;
    TileBounds tileBounds = bounds[tile];
    bool isEmpty = tileBounds.low.x > tileBounds.high.x;
    prepareShaft(tileBounds);
    uvec2 largeTile = gl_WorkGroupID.xy / uint(volume.tiles.z);
    uint list = (largeTile.y * uint(volume.tiles.y) + largeTile.x) * uint(volume.tiles.w);
    uint words = isEmpty ? 0u : (eye.edgeCount + 31u) / 32u;
    for (uint firstWord = 0u; firstWord < words; firstWord += wordsAtOnce) {
        if (lane == 0u) matteringCount = 0u;
        barrier();
        uint word = firstWord + lane;
        uint bits = word < words ? lists[list + word] : 0u;
        for (; bits != 0u; bits &= bits - 1u) {
            uint index = 32u * word + uint(findLSB(bits));
            if (mayMatter(lightEdges[index])) mattering[atomicAdd(matteringCount, 1u)] = index;
        }
        barrier();
        if (seesLight) {
            for (uint i = 0u; i < matteringCount; ++i) {
                if (addEdge(frame, receiver, top, lightEdges[mattering[i]])) ++edgesCounted;
            }
        }
        barrier();
    }

    if (!isInside) return;
    vec3 seen = vec3(isReceiver ? 0.0 : 1.0);
    if (seesLight) {
        int atCenter = int(round(texelFetch(volumeCounts, texel, 0).r)) + eye.blockers;
        seen = visibilityOf(frame, atCenter);
    }
    imageStore(visibility, texel, vec4(seen, 1.0));
    imageStore(edgeCounts, texel, vec4(float(edgesCounted)));
}

// SPDX-License-Identifier: Apache-2.0
// How many layers of surface lie before each point of the light, as a receiver sees them: the edges between the light's
// centre and a point change the count (README.md, "Counting layers"). Requires light_area.glsl.
//
// SAMPLES: the number of points of the light at which layers are counted.
#ifndef SAMPLES
#define SAMPLES 64
#endif

// xy: place in unit space; z: rank from the centre; w: direction in turns, rising
layout(std430, binding = 4) readonly buffer Samples { vec4 samples[]; };

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

// The light's point that is highest over the receiver's horizon.
vec2 topPlace(LightFrame frame) {
    vec2 up = frame.horizon.xy;
    if (isSquareLight()) return vec2(up.x < 0.0 ? -1.0 : 1.0, up.y < 0.0 ? -1.0 : 1.0);
    return up == vec2(0.0) ? vec2(1.0, 0.0) : normalize(up);
}

const float fixedOne = 1048576.0;  // integers add up to the same in any order

// Changes in the number of layers from the light's centre to its other points. Not in a struct that is handed around,
// which some compilers copy.
int changes[SAMPLES];
int leastChange = 2;      // of any edge: how many layers the thinnest blocker has
int changeAtTop = 0;      // at the light's highest point over the horizon
int meanChangeFixed = 0;  // exact mean over the light, times fixedOne
int edgesCounted = 0;

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

// An edge as a receiver sees it.
struct SeenEdge {
    vec2 a, b;  // its ends in unit space
    float turn;  // around the light's centre from a to b
    int change;  // in the number of layers from the centre to a point beyond
};

// False where it hides nothing from the receiver: of the edges that matter to a tile, few do to each of its receivers.
bool seeEdge(LightFrame frame, Receiver receiver, LightEdge edge, out SeenEdge seen) {
    vec4 p = vec4(receiver.posLight, 1.0);
    float weight = sign(dot(edge.planes[0], p)) + sign(dot(edge.planes[1], p));
    vec3 a, b;
    bool isBefore = edgeBeforeLight(frame, receiver.posLight, edge.aLight, edge.bLight, a, b);
    seen.a = a.xy / a.z;
    seen.b = b.xy / b.z;
    seen.turn = seen.a.x * seen.b.y - seen.a.y * seen.b.x;
    seen.change = int(sign(seen.turn) * weight * frame.handedness);
    return isBefore && seen.change != 0;
}

// Adds what an edge changes on the way from the light's centre to each of its points. Returns how many points it looked
// at.
uint addEdge(LightFrame frame, vec2 top, SeenEdge edge) {
    vec2 a = edge.a, b = edge.b;
    leastChange = min(leastChange, abs(edge.change));
    meanChangeFixed += edge.change * int(shareBeyond(a, b) * fixedOne + 0.5);
    // Only points in the directions between the edge's ends can lie behind it; they follow each other in the list.
    float first = directionOf(edge.turn > 0.0 ? a : b), last = directionOf(edge.turn > 0.0 ? b : a);
    float span = fract(last - first) + 2.0 * directionRounding;
    first = fract(first - directionRounding);
    int start = firstSampleFrom(first);
    int n = 0;
    for (; n < SAMPLES; ++n) {
        int i = start + n < SAMPLES ? start + n : start + n - SAMPLES;
        if (fract(samples[i].w - first) > span) break;
        changes[i] += isCrossed(a, b, edge.turn, samplePlace(frame, i)) ? edge.change : 0;
    }
    changeAtTop += isCrossed(a, b, edge.turn, top) ? edge.change : 0;
    ++edgesCounted;
    return uint(n);
}

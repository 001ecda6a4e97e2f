// SPDX-License-Identifier: Apache-2.0
// How many layers of surface lie before each point of the light, as a receiver sees them: the edges between the light's
// centre and a point change the count (README.md, "Counting layers"). Requires point_places.glsl, seen_edges.glsl and
// radiance_beyond.glsl.

const float fixedOne = 1048576.0;  // integers add up to the same in any order

// For each of the light's points, in one integer (PointCount in layer_visibility.glsl): by how much the number of layers
// differs from that before the light's centre, and what edges near the point do to the area that it stands for. Not in a
// struct that is handed around, which some compilers copy.
int changes[SAMPLES];

const int countBits = 12, offsetBits = 10;  // each signed, so that what overflows harms no count
const float offsetOne = 16.0;

// What an edge adds to a point's count that hides, or shows, `share` more of its area than of the point itself. Where several
// edges lie on each other, the first alone says how much of the area that is.
int offsetOf(float share, int change, bool isFirst) {
    int ofArea = int(round(share * offsetOne)), behind = isFirst ? (change < 0 ? -ofArea : ofArea) : 0;
    return (behind << (countBits + offsetBits)) + ((ofArea * change) << countBits);
}

// One over how wide what a point stands for is, in unit space; 0 where they do not all stand for the same area.
float cellsAcross(LightFrame frame) {
    if (isSliver || frame.tangent > wideLight) return 0.0;
    return sqrt(float(SAMPLES) / (isSquareLight() ? 4.0 : 0.5 * lightTau));
}

int leastChange = 2;      // of any edge: how many layers the thinnest blocker has
ivec3 meanChangeFixed = ivec3(0);  // exact mean over the light, of each channel's radiance, times fixedOne
int edgesCounted = 0;

float directionOf(vec2 d) { return fract(atan(d.y, d.x) / lightTau); }

const float directionRounding = 5e-4;  // turns; many times what is lost in seeing an end that is clear of the centre
const float clearOfCenter = 1e-2;      // of the light's half side: nearer to its centre, ends may lie in any direction

// The first point whose direction is not before this one; SAMPLES becomes 0, since directions go round.
int firstSampleFrom(float direction) {
    int low = 0, high = SAMPLES;
    // Eleven halvings do for 1,024 points; without an exit in between, so that compilers unroll them.
    for (int step = 0; step < 11; ++step) {
        int middle = (low + high) / 2;
        bool isBefore = low < high && samples[middle].w < direction;
        high = isBefore ? high : middle;
        low = isBefore ? middle + 1 : low;
    }
    return low % SAMPLES;
}

// By how much the number of layers changes from the light's centre to a point beyond the edge.
int changeBeyond(LightFrame frame, Receiver receiver, LightEdge edge, SeenEdge seen) {
    float weight = sideOf(edge.planes[0], receiver.posLight) + sideOf(edge.planes[1], receiver.posLight);
    return int((seen.hasLeft ? weight : -weight) * frame.handedness);
}

// False where it hides nothing from the receiver: of the edges that matter to a tile, few do to each of its receivers.
bool hidesLight(LightFrame frame, Receiver receiver, LightEdge edge, out SeenEdge seen) {
    return seeEdge(frame, receiver.posLight, edge.aLight, edge.bLight, edge.cutSide, seen) &&
           changeBeyond(frame, receiver, edge, seen) != 0;
}

// Adds what an edge changes on the way from the light's centre to each of its points; isFirst: see offsetOf. Returns how
// many points it looked at.
uint addEdge(LightFrame frame, SeenEdge edge, int change, bool isFirst) {
    vec2 from, to;
    if (!partBeforeLight(frame, edge, from, to)) return 0u;
    leastChange = min(leastChange, abs(change));
    vec3 beyond = volume.light.isTextured ? radianceBeyond(edge, from, to) : vec3(shareBeyond(from, to));
    meanChangeFixed += change * ivec3(beyond * fixedOne + 0.5);
    // Only points in the directions between the edge's ends can lie behind it; they follow each other in the list, unless
    // they have been put elsewhere.
    float first = directionOf(edge.hasLeft ? from : to), last = directionOf(edge.hasLeft ? to : from);
    bool isClear = !isSliver && min(dot(from, from), dot(to, to)) > clearOfCenter * clearOfCenter;
    float span = isClear ? fract(last - first) + 2.0 * directionRounding : 1.0;
    first = fract(first - directionRounding);
    int start = firstSampleFrom(first);
    // Of what a point near the edge stands for, a part is on the other side.
    float across = cellsAcross(frame) / max(length(edge.plane.xy), 1e-30);
    bool hasArea = across > 0.0;
    if (edge.hasLeft) across = -across;
    int n = 0;
    for (; n < SAMPLES; ++n) {
        int i = start + n < SAMPLES ? start + n : start + n - SAMPLES;
        if (fract(samples[i].w - first) > span) break;
        vec2 s = samplePlace(frame, i);
        bool isBeyond;
        if (!isInDirection(frame, edge, s, isBeyond)) continue;
        float share = clamp(0.5 + across * dot(edge.plane, vec3(s, 1.0)), 0.0, 1.0) - (isBeyond ? 1.0 : 0.0);
        changes[i] += (isBeyond ? change : 0) + (hasArea ? offsetOf(share, change, isFirst) : 0);
    }
    ++edgesCounted;
    return uint(n);
}

// The plane through the receiver and two corners of a face, turned the same way whichever of the two comes first.
vec3 sidePlane(vec3 a, vec3 b) {
    bool isOrdered = isBefore(a, b);
    vec3 from = isOrdered ? a : b, to = isOrdered ? b : a;
    precise vec3 normal = vec3(from.y * to.z - from.z * to.y, from.z * to.x - from.x * to.z, from.x * to.y - from.y * to.x);
    return normal;
}

// A face that reaches into a spherical light, in unit space, and the sphere there. A way to the light's point `s` goes on
// through it: dot with (s, 1) to apply what is said of ways.
struct SeenFace {
    vec3 a, b, c;       // its corners
    vec3 ab, bc, ca;    // planes through the receiver and its edges
    bvec3 isTurned;     // which of these are walked against their order
    vec3 alongPlane;    // how far a way leads along the normal of the face's plane
    float atReceiver;   // the plane at the receiver
    vec3 fromCenter;    // dot of a way with the receiver's place
    vec2 square;        // of a way's length, dot with (s^2, 1)
    float outside;      // square of the receiver's distance less that of the radius
};

SeenFace seeFace(LightFrame frame, vec3 posLight, LightEdge record) {
    mat3 unitFromLight = transpose(mat3(frame.x, frame.y, frame.z));
    vec3 a = unitFromLight * (record.aLight - posLight), b = unitFromLight * (record.bLight - posLight),
         c = unitFromLight * (record.planes[0].xyz - posLight);
    // The rows of unitFromLight are at right angles to each other.
    vec3 lengths2 = 1.0 / vec3(dot(frame.x, frame.x), dot(frame.y, frame.y), dot(frame.z, frame.z));
    SeenFace face;
    face.a = a;
    face.b = b;
    face.c = c;
    face.ab = sidePlane(a, b);
    face.bc = sidePlane(b, c);
    face.ca = sidePlane(c, a);
    face.isTurned = bvec3(!isBefore(a, b), !isBefore(b, c), !isBefore(c, a));
    face.alongPlane = unitFromLight * record.planes[1].xyz * lengths2;
    face.atReceiver = dot(record.planes[1], vec4(posLight, 1.0));
    face.fromCenter = unitFromLight * posLight * lengths2;
    face.square = lengths2.xz;
    face.outside = dot(posLight, posLight) - volume.light.halfSize.x * volume.light.halfSize.x;
    return face;
}

// Whether the line through the receiver and the light's point `s` meets the face.
bool isInFace(SeenFace face, vec2 s) {
    vec3 way = vec3(s, 1.0);
    bvec3 isLeft = bvec3((dot(face.ab, way) >= 0.0) != face.isTurned.x, (dot(face.bc, way) >= 0.0) != face.isTurned.y,
                         (dot(face.ca, way) >= 0.0) != face.isTurned.z);
    return isLeft.x == isLeft.y && isLeft.y == isLeft.z;
}

// False only where it hides no point: behind the receiver, off to one side of the light, or all of it behind the circle in
// which the cone from the receiver touches the sphere, where nothing is before the sphere's near side.
bool mayHide(LightFrame frame, Receiver receiver, LightEdge record) {
    mat3 unitFromLight = transpose(mat3(frame.x, frame.y, frame.z));
    vec3 a = unitFromLight * (record.aLight - receiver.posLight),
         b = unitFromLight * (record.bLight - receiver.posLight),
         c = unitFromLight * (record.planes[0].xyz - receiver.posLight);
    const float margin = 1.001;
    vec3 x = vec3(a.x, b.x, c.x), y = vec3(a.y, b.y, c.y), z = vec3(a.z, b.z, c.z), beside = margin * z;
    bool isBeside = all(greaterThan(x, beside)) || all(lessThan(x, -beside)) || all(greaterThan(y, beside)) ||
                    all(lessThan(y, -beside));
    bool isBehind = !frame.isInside && all(greaterThan(z, vec3(margin)));
    return any(greaterThan(z, vec3(0.0))) && !isBeside && !isBehind;
}

// In which directions from the light's centre a face may hide points: those up to `span` turns from `first` on.
void directionsOf(SeenFace face, out float first, out float span) {
    first = 0.0;
    span = 1.0;
    if (isSliver || min(face.a.z, min(face.b.z, face.c.z)) <= 0.0 || isInFace(face, vec2(0.0))) return;
    vec2 a = face.a.xy / face.a.z, b = face.b.xy / face.b.z, c = face.c.xy / face.c.z;
    if (min(dot(a, a), min(dot(b, b), dot(c, c))) <= clearOfCenter * clearOfCenter) return;
    // From the first corner to the others, the shorter way round.
    float begin = directionOf(a);
    float toB = fract(directionOf(b) - begin + 0.5) - 0.5, toC = fract(directionOf(c) - begin + 0.5) - 0.5;
    float low = min(0.0, min(toB, toC)), high = max(0.0, max(toB, toC));
    // Within rounding of half a turn the centre is on one of its edges.
    if (high - low > 0.49) return;
    first = fract(begin + low - directionRounding);
    span = high - low + 2.0 * directionRounding;
}

// Whether it hides the point `s`. The way there ends on the sphere's near side; from within it, on the far side.
bool isHidden(SeenFace face, vec2 s) {
    float middle = -dot(face.fromCenter, vec3(s, 1.0)), square = dot(face.square, vec2(dot(s, s), 1.0));
    float end = middle + sqrt(max(middle * middle - square * face.outside, 0.0));
    end = face.outside > 0.0 ? face.outside / end : end / square;
    float atEnd = face.atReceiver + end * dot(face.alongPlane, vec3(s, 1.0));
    return atEnd * face.atReceiver < 0.0 && isInFace(face, s);
}

// Counts a face that reaches into a spherical light at each point: the count at the light's centre leaves it out. Returns
// how many points it looked at.
uint addFace(LightFrame frame, Receiver receiver, LightEdge record) {
    SeenFace face = seeFace(frame, receiver.posLight, record);
    float first, span;
    directionsOf(face, first, span);
    int start = firstSampleFrom(first), hidden = 0, n = 0;
    for (; n < SAMPLES; ++n) {
        int i = start + n < SAMPLES ? start + n : start + n - SAMPLES;
        if (fract(samples[i].w - first) > span) break;
        int hides = isHidden(face, samplePlace(frame, i)) ? 1 : 0;
        changes[i] += hides;
        hidden += hides;
    }
    meanChangeFixed += hidden * int(fixedOne) / SAMPLES;
    if (hidden > 0 && hidden < SAMPLES) leastChange = 1;
    if (hidden > 0) ++edgesCounted;
    return uint(n);
}

// SPDX-License-Identifier: Apache-2.0
// Triangles and boxes as a receiver sees them before the light's samples, and whether they may hide any that can still be
// seen. Includer defines ROWS and hidden[].

// A triangle's corners, from the receiver.
struct Blocker {
    vec3 a, b, c;           // scene axes, metres
    vec3 uvwA, uvwB, uvwC;  // as the patch has it
    vec3 onA, onB, onC;     // lattice coordinates
};

vec3 uvwOf(Patch patch_, vec3 v) {
    precise vec3 uvw = vec3(dot(patch_.rowU, v), dot(patch_.rowV, v), dot(patch_.rowW, v));
    return uvw;
}

vec3 latticeOf(vec3 uvw, vec2 offset) {
    precise vec3 lattice = vec3(uvw.x * light.latticeFromU + uvw.y * light.latticeFromV + uvw.z * offset, uvw.z);
    return lattice;
}

Blocker loadBlocker(uint triangle, vec3 apex, Patch patch_, vec2 offset) {
    Blocker blocker;
    blocker.a = loadCorner(triangle, 0u) - apex;
    blocker.b = loadCorner(triangle, 1u) - apex;
    blocker.c = loadCorner(triangle, 2u) - apex;
    blocker.uvwA = uvwOf(patch_, blocker.a);
    blocker.uvwB = uvwOf(patch_, blocker.b);
    blocker.uvwC = uvwOf(patch_, blocker.c);
    blocker.onA = latticeOf(blocker.uvwA, offset);
    blocker.onB = latticeOf(blocker.uvwB, offset);
    blocker.onC = latticeOf(blocker.uvwC, offset);
    return blocker;
}

// The columns between low.x and high.x of row j in which samples can still be seen, if the row is between low.y and high.y.
uint openInRow(uint columns, vec2 low, vec2 high, int j) {
    if (j >= ROWS) return 0u;
    return float(j) >= low.y && float(j) <= high.y ? columns & ~hidden[min(j, ROWS - 1)] : 0u;
}

// Whether samples can still be seen within a rectangle of the lattice, made larger by the rounding of where edges meet rows.
bool isAnyOpen(vec2 low, vec2 high) {
    vec2 margin = 1e-5 * (max(abs(low), abs(high)) + 1.0);
    low -= margin;
    high += margin;
    uint columns = bitsBefore(floor(high.x) + 1.0) & ~bitsBefore(low.x);
    uint open_ = 0u;
#define OPEN_IN_ROW(j) open_ |= openInRow(columns, low, high, j);
    EACH_ROW(OPEN_IN_ROW)
    return open_ != 0u;
}

// Of coordinates: more than ten roundings.
const float boxRounding = 2e-6;

// What turns a box around blockers into a rectangle around the samples that they may hide.
struct Projection {
    vec3 x, y, w;  // lattice coordinates from a vector that begins at the receiver
    vec3 rounding; // of x and y
};

Projection projectionOf(Patch patch_, vec2 offset) {
    vec2 u = light.latticeFromU, v = light.latticeFromV;
    vec3 sizeX = abs(patch_.rowU) * abs(u.x) + abs(patch_.rowV) * abs(v.x) + abs(patch_.rowW) * abs(offset.x);
    vec3 sizeY = abs(patch_.rowU) * abs(u.y) + abs(patch_.rowV) * abs(v.y) + abs(patch_.rowW) * abs(offset.y);
    return Projection(patch_.rowU * u.x + patch_.rowV * v.x + patch_.rowW * offset.x,
                      patch_.rowU * u.y + patch_.rowV * v.y + patch_.rowW * offset.y, patch_.rowW,
                      boxRounding * max(sizeX, sizeY));
}

// False only if nothing in the box hides a sample that can still be seen.
bool mayBoxHide(Projection projection, vec3 normal, vec3 apex, vec3 boxMin, vec3 boxMax) {
    vec3 low = boxMin - apex, high = boxMax - apex;
    vec3 middle = 0.5 * (low + high), extent = 0.5 * (high - low);
    vec3 size = max(abs(low), abs(high));
    vec3 padded = extent + boxRounding * size;
    float around = dot(projection.rounding, size);
    vec3 from = vec3(dot(projection.x, middle), dot(projection.y, middle), dot(projection.w, middle));
    vec3 to = vec3(dot(abs(projection.x), extent) + around, dot(abs(projection.y), extent) + around,
                   dot(abs(projection.w), padded));
    vec3 least = from - to, most = from + to;
    bool isAbove = dot(normal, middle) + dot(abs(normal), padded) > 0.0;
    bool reachesBehind = least.z <= 0.0;
    vec2 inverse = 1.0 / vec2(max(least.z, 1e-30), max(most.z, 1e-30));
    vec2 nearLow = mix(inverse.yy, inverse.xx, lessThan(least.xy, vec2(0.0)));
    vec2 nearHigh = mix(inverse.xx, inverse.yy, lessThan(most.xy, vec2(0.0)));
    return isAbove && most.z > 0.0 && (reachesBehind || isAnyOpen(least.xy * nearLow, most.xy * nearHigh));
}

// False only if it hides no sample that can still be seen: beside the window on one side, behind the receiver, below its
// horizon, behind a flat light, between the samples.
bool mayHide(Blocker t, vec3 normal) {
    vec3 u = vec3(t.uvwA.x, t.uvwB.x, t.uvwC.x);
    vec3 v = vec3(t.uvwA.y, t.uvwB.y, t.uvwC.y);
    vec3 w = vec3(t.uvwA.z, t.uvwB.z, t.uvwC.z);
    vec3 height = vec3(dot(normal, t.a), dot(normal, t.b), dot(normal, t.c));
    bool beside = all(greaterThan(u, w)) || all(greaterThan(-u, w)) || all(greaterThan(v, w)) || all(greaterThan(-v, w));
    bool behind = all(lessThanEqual(w, vec3(0.0))) || all(lessThanEqual(height, vec3(0.0)));
    bool beyond = (isFlat() || isTube()) && all(greaterThanEqual(w, vec3(rayEnd)));
    bool reachesBehind = min(w.x, min(w.y, w.z)) <= 0.0;
    vec3 inverse = 1.0 / max(w, 1e-30);
    vec2 a = t.onA.xy * inverse.x, b = t.onB.xy * inverse.y, c = t.onC.xy * inverse.z;
    return !(beside || behind || beyond) && (reachesBehind || isAnyOpen(min(a, min(b, c)), max(a, max(b, c))));
}

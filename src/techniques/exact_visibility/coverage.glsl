// SPDX-License-Identifier: Apache-2.0
// Which samples of the light a triangle hides. Includer defines ROWS.
//
// A vector that begins at the receiver has the lattice coordinates w (i, j, 1): through it one sees the light at (i, j),
// and it ends at the share w of the way (w < 0: behind). A triangle meets the plane through the receiver and row j of
// the lattice in a segment, whose ends lie on two of its edges. Seen from the receiver it hides the samples between
// both ends: those left of one of them and not of the other. An end is computed from its edge's two corners alone and
// in a way that does not depend on their order, so that triangles that share an edge leave no gap and do not overlap.

// Written out and not as loops: drivers that count iterations (see the README) do not unroll all of this length. DO begins
// with whether there is such a row.
#define EACH_ROW(DO)                                                                                             \
    DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7) DO(8) DO(9) DO(10) DO(11) DO(12) DO(13) DO(14) DO(15) DO(16) \
    DO(17) DO(18) DO(19) DO(20) DO(21) DO(22) DO(23)

// The edge's corners p and q are on different sides of the row's plane: y - j w has values of different signs there,
// whose magnitudes are hp and hq. Result: x and w of the meeting point, times hp + hq.
vec2 meet(vec3 p, vec3 q, float hp, float hq) {
    precise vec2 result = p.xz * hq + q.xz * hp;
    return result;
}

// Samples with i < x, as bits.
uint bitsBefore(float x) { return (1u << uint(clamp(ceil(x), 0.0, 31.0))) - 1u; }

// The samples of row j that the triangle abc hides, samples or not.
uint hiddenInRow(vec3 a, vec3 b, vec3 c, float j) {
    precise vec3 h = vec3(a.y, b.y, c.y) - j * vec3(a.z, b.z, c.z);
    bvec3 above = greaterThan(h, vec3(0.0));
    h = abs(h);
    // The corner that is alone on its side, and the other two.
    bool aAlone = above.y == above.z, bAlone = above.x == above.z;
    vec4 alone = aAlone ? vec4(a, h.x) : bAlone ? vec4(b, h.y) : vec4(c, h.z);
    vec4 other = aAlone ? vec4(b, h.y) : bAlone ? vec4(c, h.z) : vec4(a, h.x);
    vec4 third = aAlone ? vec4(c, h.z) : bAlone ? vec4(a, h.x) : vec4(b, h.y);
    vec2 first = meet(alone.xyz, other.xyz, alone.w, other.w);
    vec2 second = meet(alone.xyz, third.xyz, alone.w, third.w);
    // Of a segment that passes beside the receiver to what is behind it one sees the part in front, up to infinity on
    // the side on which it passes.
    uint passing = first.x * abs(second.y) + second.x * abs(first.y) > 0.0 ? 0x7fffffffu : 0u;
    uint bits = (first.y > 0.0 ? bitsBefore(first.x / first.y) : passing) ^
                (second.y > 0.0 ? bitsBefore(second.x / second.y) : passing);
    return aAlone && bAlone ? 0u : bits;
}

// SPDX-License-Identifier: Apache-2.0
// What of a textured light is beyond an edge. Requires light_area.glsl, seen_edges.glsl and light_table.glsl.

uniform sampler2D lightTable;

const float stepsAQuarter = 16.0;  // in which an edge is followed around the light's centre

float quartersTo(vec2 d) { return isSquareLight() ? squareAreaTo(d) : 4.0 * atan(d.y, d.x) / lightTau; }

// What the light radiates at its place `s`, by what more of it is beyond the nearer side of the table's cell there.
vec3 radianceAt(vec2 s) {
    float share = isSquareLight() ? max(abs(s.x), abs(s.y)) : length(s);
    int row = min(int(share * float(tableRows)), tableRows - 1);
    int column = int(fract(0.25 * quartersTo(s)) * float(tableColumns)) % tableColumns;
    vec3 here = texelFetch(lightTable, ivec2(column, row), 0).rgb - texelFetch(lightTable, ivec2(column, row + 1), 0).rgb;
    return here / (float(row) + 0.5);
}

// The share, channel by channel, of the light's radiance that is beyond the part of an edge from `from` to `to`.
vec3 radianceBeyond(SeenEdge edge, vec2 from, vec2 to) {
    float begin = quartersTo(from), angle = quartersTo(to) - begin;
    angle -= 4.0 * round(0.25 * angle);
    // Past the centre within rounding, the edge itself says on which side.
    if (abs(angle) > 1.9 && angle > 0.0 != edge.hasLeft) angle = angle > 0.0 ? angle - 4.0 : angle + 4.0;
    int steps = clamp(int(ceil(abs(angle) * stepsAQuarter)), 1, 64);
    vec2 along = to - from;
    float turn = from.x * to.y - from.y * to.x;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < steps; ++i) {
        float quarters = begin + angle * (float(i) + 0.5) / float(steps);
        vec2 border = borderAt(quarters);
        // How far towards the border the edge is in this direction.
        float side = border.x * along.y - border.y * along.x;
        float share = clamp(side == 0.0 ? 1.0 : turn / side, 0.0, 1.0);
        vec2 place = vec2(0.25 * quarters, (share * float(tableRows) + 0.5) / float(tableRows + 1));
        sum += textureLod(lightTable, place, 0.0).rgb;
    }
    return sum * (abs(angle) / float(steps));
}

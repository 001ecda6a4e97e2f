// SPDX-License-Identifier: Apache-2.0
// Edges as a receiver sees them, in unit space and in homogeneous coordinates (thesis, section 4.2.7): (x, y, z) is where
// (x, y) / z is on the light. Nothing is divided before it is known to be on the light, so that edges may begin beside the
// receiver or behind it, as all do where casters stand on what they shade. Requires light_area.glsl.

// The same, to the last bit, for all who ask from this receiver about this place.
vec3 unitPlace(LightFrame frame, vec3 receiverLight, vec3 placeLight) {
    precise vec3 from = placeLight - receiverLight;
    precise float x = (frame.x.x * from.x + frame.x.y * from.y) + frame.x.z * from.z;
    precise float y = (frame.y.x * from.x + frame.y.y * from.y) + frame.y.z * from.z;
    precise float z = (frame.z.x * from.x + frame.z.y * from.y) + frame.z.z * from.z;
    // What has been cut at a flat light's plane ends in it, without rounding.
    return vec3(x, y, isFlatLight() && placeLight.z == 0.0 ? 1.0 : z);
}

// Twice the area from the light's centre over the edge, times both ends' z.
float turnAround(vec3 a, vec3 b) {
    precise float turn = a.x * b.y - a.y * b.x;
    return turn;
}

struct SeenEdge {
    vec3 a, b;      // the end that comes first in light space (isBefore), and the other
    vec3 plane;     // through the receiver and both: of the way to the light's point s, dot with (s, 1)
    bool hasLeft;   // the light's centre is on the plane's positive side
};

// False where it is behind the receiver, behind the light or off to one side of it. `cutSide`: of LightEdge.
bool seeEdge(LightFrame frame, vec3 receiverLight, vec3 aLight, vec3 bLight, float cutSide, out SeenEdge seen) {
    vec3 a = unitPlace(frame, receiverLight, aLight), b = unitPlace(frame, receiverLight, bLight);
    float turn = turnAround(a, b);
    seen = SeenEdge(a, b, vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, turn), turn >= 0.0);
    bool isBehind = cutSide == 0.0 ? min(a.z, b.z) >= 1.0 : cutSide * receiverLight.z < 0.0;
    bool isBeside = (a.x > a.z && b.x > b.z) || (a.x < -a.z && b.x < -b.z) || (a.y > a.z && b.y > b.z) ||
                    (a.y < -a.z && b.y < -b.z);
    return max(a.z, b.z) > 0.0 && (frame.isEndless || !isBehind) && !isBeside;
}

// Whether the edge lies in the direction of the light's point `s`, and, in `isBeyond`, whether the way there from the light's
// centre crosses it. What is asked of each end is asked in the same way of the other edges there, so that one of them is
// crossed and no more.
bool isInDirection(LightFrame frame, SeenEdge edge, vec2 s, out bool isBeyond) {
    precise float ofA = edge.a.x * s.y - edge.a.y * s.x, ofB = edge.b.x * s.y - edge.b.y * s.x;
    bool isBetween = (ofA >= 0.0) != (ofB >= 0.0);
    isBeyond = (dot(edge.plane, vec3(s, 1.0)) >= 0.0) != edge.hasLeft;
    // How far the place is where it is crossed, times `weight`: neither behind the receiver nor behind the light.
    float weight = ofB - ofA, depth = edge.a.z * ofB - edge.b.z * ofA;
    if (weight < 0.0) depth = -depth;
    return isBetween && depth > 0.0 && (frame.isEndless || depth <= abs(weight));
}

// Of the shares `begin` to `end` of a segment leaves those where what is `ofA` at one end and `ofB` at the other is positive.
void clip(float ofA, float ofB, inout float begin, inout float end) {
    float zero = ofA / (ofA - ofB);
    if (ofA < 0.0) begin = ofB > 0.0 ? max(begin, zero) : 2.0;
    else if (ofB < 0.0) end = min(end, zero);
}

// The part of an edge that lies before the square around the light. False: there is none.
bool partBeforeLight(LightFrame frame, SeenEdge edge, out vec2 from, out vec2 to) {
    vec3 a = edge.a, b = edge.b;
    float begin = 0.0, end = 1.0;
    clip(a.z - a.x, b.z - b.x, begin, end);
    clip(a.z + a.x, b.z + b.x, begin, end);
    clip(a.z - a.y, b.z - b.y, begin, end);
    clip(a.z + a.y, b.z + b.y, begin, end);
    if (!frame.isEndless) clip(1.0 - a.z, 1.0 - b.z, begin, end);
    vec3 first = mix(a, b, begin), last = mix(a, b, end);
    from = clamp(first.xy / first.z, -1.0, 1.0);
    to = clamp(last.xy / last.z, -1.0, 1.0);
    return begin < end && min(first.z, last.z) > 0.0;
}

// SPDX-License-Identifier: Apache-2.0
// Irradiance of a light without shadows, in closed form, for a radiance of 1. Light space: the light's centre is the
// origin, it emits along -Z; `pos` and `normal` are the receiver's.

#include "studio/frame/light_shapes_io.h"

const float pi = 3.14159265358979;
const int diskSides = 24;

// The part of Lambert's formula for one edge of a polygon on the unit sphere (J. H. Lambert, Photometria, 1760; Baum et
// al. 1989): the angle between its ends times the normal's component along the edge's plane.
float edgeIrradiance(vec3 a, vec3 b, vec3 normal) {
    vec3 across = cross(a, b);
    float sine = length(across);
    return sine > 0.0 ? atan(sine, dot(a, b)) * dot(across, normal) / sine : 0.0;
}

// The boundary of a flat light clipped at the receiver's horizon, integrated edge by edge. `previous` and `next` are
// consecutive corners relative to the receiver; `leaves` and `enters` remember where the boundary meets the horizon.
struct PolygonSum {
    float irradiance;
    vec3 leaves;
    vec3 enters;
    bool crosses;
};

void addEdge(inout PolygonSum sum, vec3 a, vec3 b, vec3 normal) {
    float heightA = dot(a, normal);
    float heightB = dot(b, normal);
    if (heightA <= 0.0 && heightB <= 0.0) return;
    if (heightA > 0.0 && heightB > 0.0) {
        sum.irradiance += edgeIrradiance(normalize(a), normalize(b), normal);
        return;
    }
    vec3 crossing = mix(a, b, heightA / (heightA - heightB));
    sum.crosses = true;
    if (heightA > 0.0) {
        sum.leaves = crossing;
        sum.irradiance += edgeIrradiance(normalize(a), normalize(crossing), normal);
    } else {
        sum.enters = crossing;
        sum.irradiance += edgeIrradiance(normalize(crossing), normalize(b), normal);
    }
}

float closePolygon(PolygonSum sum, vec3 normal) {
    // The edge along the horizon adds its whole angle: its plane contains the normal's foot.
    if (sum.crosses) sum.irradiance += edgeIrradiance(normalize(sum.leaves), normalize(sum.enters), normal);
    return 0.5 * abs(sum.irradiance);
}

float rectIrradiance(vec3 pos, vec3 normal, vec2 halfExtents) {
    PolygonSum sum = PolygonSum(0.0, vec3(0.0), vec3(0.0), false);
    vec3 corners[4] = vec3[](vec3(-halfExtents, 0.0) - pos, vec3(halfExtents.x, -halfExtents.y, 0.0) - pos,
                             vec3(halfExtents, 0.0) - pos, vec3(-halfExtents.x, halfExtents.y, 0.0) - pos);
    for (int i = 0; i < 4; ++i) addEdge(sum, corners[i], corners[(i + 1) & 3], normal);
    return closePolygon(sum, normal);
}

// A regular polygon of the disk's area: within 1e-3 of the disk wherever the receiver is farther away than its radius.
float diskIrradiance(vec3 pos, vec3 normal, float radius) {
    PolygonSum sum = PolygonSum(0.0, vec3(0.0), vec3(0.0), false);
    float step = 2.0 * pi / float(diskSides);
    float circumradius = radius * sqrt(step / sin(step));
    vec3 previous = vec3(circumradius, 0.0, 0.0) - pos;
    for (int i = 1; i <= diskSides; ++i) {
        vec3 next = vec3(circumradius * vec2(cos(float(i) * step), sin(float(i) * step)), 0.0) - pos;
        addEdge(sum, previous, next, normal);
        previous = next;
    }
    return closePolygon(sum, normal);
}

// A cone of directions about `axis` with the given sine of its half angle, clipped at the horizon (J. M. Snyder, Area
// light sources for real-time graphics, Microsoft Research TR-96-11, 1996, in the form that follows from integrating
// the visible cap's projection).
float coneIrradiance(vec3 axis, vec3 normal, float sine) {
    float cosine = clamp(dot(axis, normal), -1.0, 1.0);
    float sine2 = sine * sine;
    if (cosine >= sine) return pi * sine2 * cosine;
    if (cosine <= -sine || sine2 <= 0.0) return 0.0;
    float sineTilt = sqrt(1.0 - cosine * cosine);
    float x = sqrt(max(0.0, 1.0 / sine2 - 1.0));
    float y = clamp(-x * cosine / sineTilt, -1.0, 1.0);
    float z = sineTilt * sqrt(1.0 - y * y);
    return max(0.0, (cosine * acos(y) - x * z) * sine2 + atan(z, x));
}

// A tube along X as a receiver sees it: what one sees of it is what it covers of the plane through its two outer lines,
// shining as bright, whatever the angle.
struct SeenTube {
    vec3 ahead;   // unit, the shortest way to the tube's axis
    vec3 aside;   // unit, across that and the tube
    float away;   // to its axis; the receiver is outside where it is more than the radius
    float plane;  // to that plane
    float halfWidth;
    float radius;
};

SeenTube seeTube(vec3 pos, float radius) {
    SeenTube seen;
    seen.away = length(pos.yz);
    seen.radius = radius;
    vec2 ahead = -pos.yz / max(seen.away, 1e-30);
    float sine = min(radius / max(seen.away, 1e-30), 1.0);
    seen.ahead = vec3(0.0, ahead);
    seen.aside = vec3(0.0, -ahead.y, ahead.x);
    seen.plane = seen.away - radius * sine;
    seen.halfWidth = radius * sqrt((1.0 - sine) * (1.0 + sine));
    return seen;
}

// In flat strips along the tube whose edges lie on it, the outermost ones on its outer lines: only its round ends are not
// as they are. They look like more of it the nearer it is: within 1.5e-3 with this many.
float tubeIrradiance(vec3 pos, vec3 normal, float halfLength, float radius) {
    SeenTube seen = seeTube(pos, radius);
    if (seen.away <= radius) return 0.0;
    const float stripsPerRoot = 40.0;
    const int fewestStrips = 2, mostStrips = 12;
    int strips = int(clamp(ceil(stripsPerRoot * sqrt(radius / seen.away)), float(fewestStrips), float(mostStrips)));
    float outermost = acos(radius / seen.away);
    vec3 toEnd = vec3(halfLength, 0.0, 0.0);
    vec3 line = -seen.halfWidth * seen.aside + seen.plane * seen.ahead - vec3(pos.x, 0.0, 0.0);
    float sum = 0.0;
    for (int i = 1; i <= strips; ++i) {
        float angle = outermost * (2.0 * float(i) / float(strips) - 1.0);
        vec3 next = radius * sin(angle) * seen.aside + (seen.away - radius * cos(angle)) * seen.ahead -
                    vec3(pos.x, 0.0, 0.0);
        PolygonSum strip = PolygonSum(0.0, vec3(0.0), vec3(0.0), false);
        addEdge(strip, line - toEnd, line + toEnd, normal);
        addEdge(strip, line + toEnd, next + toEnd, normal);
        addEdge(strip, next + toEnd, next - toEnd, normal);
        addEdge(strip, next - toEnd, line - toEnd, normal);
        sum += closePolygon(strip, normal);
        line = next;
    }
    return sum;
}

// SPDX-License-Identifier: Apache-2.0
#version 450
// Penumbra wedges (thesis, section 4.2.5): the space in which a silhouette edge hides some of the light and not the rest,
// bounded by a front, a back and two side planes, open at infinity. A light's box is seen from both ends of the edge; its
// slopes take the place of the thesis's bounding rectangle, and hold for lights that are tilted against the edge, too.
#include "src/geometry/silhouettes_io.h"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"

layout(std430) readonly buffer Silhouettes { SilhouetteEdge silhouettes[]; };
layout(std430) readonly buffer Layers { int layersEach[]; };

layout(std430) readonly buffer Commands { SilhouetteCommands commands; };
layout(std140) uniform Constants { WedgeConstants wedge; };

layout(location = 0) flat out vec3 aLight;
layout(location = 1) flat out vec3 bLight;
layout(location = 2) flat out float weight;

const float steepest = 64.0;  // slopes where the light surrounds the edge: the wedge is nearly all of space

// 0, 1: the top's ends; 2, 3: front at infinity; 4, 5: back at infinity. Counter-clockwise from outside.
const int corners[24] = int[](0, 2, 3, 0, 3, 1,   // front
                              0, 1, 5, 0, 5, 4,   // back
                              0, 4, 2, 1, 3, 5,   // sides
                              2, 4, 5, 2, 5, 3);  // far cap

// From a place to the light's point with these signs, in the axes of the wedge.
vec3 towardsLight(vec3 from, vec3 signs, mat3 axes) {
    if (volume.light.shape == shapeDistant) return vec3(signs.xy * volume.light.halfSize.x, 1.0) * axes;
    vec3 reach = vec3(volume.light.halfSize, volume.light.shape == shapeSphere ? volume.light.halfSize.x : 0.0);
    return (signs * reach - from) * axes;
}

const float eyeMargin = 1e-4;  // of the eye's distance

// Whether the eye may be between the planes of a wedge, whose top is the edge from `a` to `b`. At a depth below the top it
// spans slopes times that depth.
bool mayHoldEye(vec3 a, vec3 b, mat3 axes, vec2 low, vec2 high) {
    if (volume.eyeLight.w == 0.0) return true;
    vec3 fromA = (volume.eyeLight.xyz - a) * axes, fromB = (volume.eyeLight.xyz - b) * axes;
    float depth = -fromA.z, margin = eyeMargin * (length(fromA) + length(fromB));
    return depth >= -margin && fromA.x >= -depth * high.x - margin && fromB.x <= -depth * low.x + margin &&
           fromA.y >= -depth * high.y - margin && fromA.y <= -depth * low.y + margin;
}

void main() {
    // Where wedges are drawn one by one, nobody has said how many there are.
    if (uint(gl_VertexID / 24) >= commands.edgeCount) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    SilhouetteEdge edge = silhouettes[gl_VertexID / 24];
    aLight = edge.aLight;
    bLight = edge.bLight;
    weight = float(edge.weight * layersEach[edge.caster]);

    // The end that is farther from the light is drawn towards it.
    vec3 a = aLight, b = bLight;
    if (volume.light.shape == shapeDistant) {
        float top = max(a.z, b.z);
        a.z = b.z = top;
    } else {
        float ofA = length(a), ofB = length(b);
        if (ofA > ofB) a *= ofB / ofA;
        if (ofB > ofA) b *= ofA / ofB;
    }

    // Axes: x along the edge, z towards the light's centre.
    vec3 z = volume.light.shape == shapeDistant ? vec3(0.0, 0.0, 1.0) : -normalize(a + b);
    vec3 x = (b - a) - dot(b - a, z) * z;
    // An edge that points at the light has lost its length.
    if (dot(x, x) <= 1e-12 * dot(bLight - aLight, bLight - aLight))
        x = cross(z, abs(z.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    x = normalize(x);
    mat3 axes = mat3(x, cross(z, x), z);

    vec2 low = vec2(steepest), high = vec2(-steepest);
    for (int i = 0; i < 8; ++i) {
        vec3 signs = vec3((i & 1) == 0 ? -1.0 : 1.0, (i & 2) == 0 ? -1.0 : 1.0, (i & 4) == 0 ? -1.0 : 1.0);
        for (int end = 0; end < 2; ++end) {
            vec3 way = towardsLight(end == 0 ? a : b, signs, axes);
            vec2 slope = clamp(way.xy / max(way.z, 1e-20), -steepest, steepest);
            low = min(low, slope);
            high = max(high, slope);
        }
    }
    // Never thinner than rounding.
    low -= 1e-4 * (high - low) + 1e-6;
    high += 1e-4 * (high - low) + 1e-6;

    // The middle plane holds the edge and the light's centre: y = 0.
    if (wedge.half_ > 0) low.y = 0.0;
    if (wedge.half_ < 0) high.y = 0.0;

    if (wedge.eye != 0 && mayHoldEye(a, b, axes, low, high) != (wedge.eye > 0)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }

    int corner = corners[gl_VertexID % 24];
    vec4 place;
    switch (corner) {
        case 0: place = vec4(a, 1.0); break;
        case 1: place = vec4(b, 1.0); break;
        case 2: place = vec4(-(axes * vec3(high.x, high.y, 1.0)), 0.0); break;
        case 3: place = vec4(-(axes * vec3(low.x, high.y, 1.0)), 0.0); break;
        case 4: place = vec4(-(axes * vec3(high.x, low.y, 1.0)), 0.0); break;
        default: place = vec4(-(axes * vec3(low.x, low.y, 1.0)), 0.0); break;
    }
    // Parallel projection does not see a cap at infinity: there it is drawn far away.
    if (volume.eyeLight.w == 0.0 && place.w == 0.0) {
        float far = 1e4 * (length(a) + length(b) + distance(a, b));
        place = vec4((corner == 2 || corner == 4 ? a : b) + far * place.xyz, 1.0);
    }
    gl_Position = volume.clipFromLight * place;
}

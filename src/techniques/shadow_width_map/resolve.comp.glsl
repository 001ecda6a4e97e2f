// SPDX-License-Identifier: Apache-2.0
#version 450
// Visibility from the nearest edges in the map: the exact mode.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/shadow_width_map/receiver.glsl"
#include "src/techniques/shadow_width_map/footprint.glsl"
#include "src/techniques/shadow_width_map/nearest_edge.glsl"

layout(binding = 4) uniform usampler2DArray edges;
layout(binding = 5) uniform sampler2DArray widths_px;

// As in hard shadow maps: what a flat receiver needs at most for rounding, and a right angle lit at 45 degrees for
// bending within a texel.
const float toleranceTexels = 1.0;
const float tolerancePrecision = 4e-6;

struct Receiving {
    int camera;
    MapPoint point;
    vec3 normalFace;
    bool isFacing;     // the light's centre is above the horizon
    int size_px;
    float limit_px;    // no penumbra is wider, whatever the blocker's depth
};

// Where a blocker seen by the texel could hide some of the light: in front of the receiver and above its horizon.
bool isAbove(Receiving r, ivec2 texel, float stored) {
    if (stored == 0.0) return false;
    float blocker_m = depthFace_m(r.camera, stored);
    vec2 uv = (vec2(texel) + 0.5) / float(r.size_px);
    float tolerance_m = toleranceTexels * r.point.texel_m + tolerancePrecision * length(r.point.posFace);
    if (r.isFacing) {
        float plane_m = receiverPlaneDepth_m(r.camera, r.point, r.normalFace, uv, 64.0 * r.point.texel_m);
        return plane_m - tolerance_m > blocker_m;
    }
    LightCameraConstants c = lightCameras[r.camera];
    vec2 place = uv / c.window.zw + c.window.xy;
    vec3 posFace = vec3(c.depth.z == 1.0 ? place : place * blocker_m, blocker_m);
    return dot(r.normalFace, posFace - r.point.posFace) > tolerance_m;
}

// Visibility past one edge, from a place in the map on the edge's blocked or lit side. Negative where the edge is none
// for this receiver: it does not stand above its horizon, or what is behind it blocks as well.
float seenPast(Receiving r, uint edge, vec2 place_px, bool isBlocked, bool isInner) {
    ivec2 texel = edgeTexel(edge);
    float stored = texelFetch(depthMaps, ivec3(texel, r.camera), 0).r;
    float blocker_m = depthFace_m(r.camera, stored);
    if (blocker_m >= r.point.posFace.z || !isAbove(r, texel, stored)) return -1.0;
    if (isInner) {
        ivec2 behind = texel + edgeDirection(edge);
        if (isAbove(r, behind, texelFetch(depthMaps, ivec3(behind, r.camera), 0).r)) return -1.0;
    }
    vec4 depth = lightCameras[r.camera].depth;
    float spread = depth.z == 1.0 ? r.point.posFace.z - blocker_m : 1.0 / blocker_m - 1.0 / r.point.posFace.z;
    vec2 way_px = edgePlace(edge) - place_px;
    float way = length(way_px);
    vec2 extents = footprintHalfExtents(r.camera, r.point, way_px / way) * spread;
    float distance = way * depth.w;
    if (distance >= extents.x + extents.y) return isBlocked ? 0.0 : 1.0;
    return shareBelow(extents, isBlocked ? -distance : distance);
}

float seenFromTexel(Receiving r, ivec2 texel) {
    texel = clamp(texel, ivec2(0), ivec2(r.size_px - 1));
    bool isBlocked = isAbove(r, texel, texelFetch(depthMaps, ivec3(texel, r.camera), 0).r);
    float seen = isBlocked ? 0.0 : 1.0;
    vec2 place_px = vec2(texel) + 0.5;
    for (int kind = 0; kind <= constants.light.w; ++kind) {
        ivec3 entry = ivec3(texel, r.camera + kind * constants.light.y);
        if (texelFetch(widths_px, entry, 0).r > r.limit_px) continue;
        float past = seenPast(r, texelFetch(edges, entry, 0).r, place_px, isBlocked, kind == 1);
        if (past >= 0.0) seen = isBlocked ? max(seen, past) : min(seen, past);
    }
    return seen;
}

float seenBy(Receiver receiver) {
    if (!isFacing(receiver, true)) return 0.0;
    Receiving r;
    r.camera = deepestCamera(receiver.posLight);
    r.isFacing = isFacing(receiver, false);
    if (r.camera < 0) return 1.0;
    r.point = mapPoint(r.camera, receiver.posLight);
    r.normalFace = mat3(lightCameras[r.camera].faceFromLight) * receiver.normalLight;
    r.size_px = textureSize(depthMaps, 0).x;
    r.limit_px = float(r.size_px);
    vec2 place_px = r.point.uv * float(r.size_px);
    bool isPoint = max(constants.halfAxisX.w, constants.halfAxisY.w) == 0.0;
    if (isPoint) return isAbove(r, ivec2(place_px), texelFetch(depthMaps, ivec3(place_px, r.camera), 0).r) ? 0.0 : 1.0;

    // Visibility is what is interpolated: neither widths nor depths mean anything in between.
    ivec2 corner = ivec2(floor(place_px - 0.5));
    vec2 weight = place_px - 0.5 - vec2(corner);
    float lower = mix(seenFromTexel(r, corner), seenFromTexel(r, corner + ivec2(1, 0)), weight.x);
    float upper = mix(seenFromTexel(r, corner + ivec2(0, 1)), seenFromTexel(r, corner + ivec2(1, 1)), weight.x);
    return mix(lower, upper, weight.y);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    imageStore(visibility, pixel, vec4(loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0));
}

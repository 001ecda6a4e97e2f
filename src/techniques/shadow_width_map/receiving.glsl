// SPDX-License-Identifier: Apache-2.0
// What both passes of the exact mode know of a receiver.
#include "src/techniques/shadow_width_map/receiver.glsl"

layout(binding = 4) uniform sampler2DArray widths_px;

// As in hard shadow maps: what a flat receiver needs at most for rounding, and a right angle lit at 45 degrees for
// bending within a texel.
const float toleranceTexels = 1.0;
const float tolerancePrecision = 4e-6;

struct Receiving {
    int camera;
    MapPoint point;
    vec3 normalFace;
    bool isFacing;  // the light's centre is above the horizon
    bool isOrthographic;
    int size_px;
    float texel;     // tangents or metres
    float limit_px;  // no penumbra is wider, whatever the blocker's depth
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

float spreadOf(Receiving r, float blocker_m) {
    return r.isOrthographic ? r.point.posFace.z - blocker_m : 1.0 / blocker_m - 1.0 / r.point.posFace.z;
}

vec2 widthsAt(Receiving r, ivec2 texel) {
    float outer = texelFetch(widths_px, ivec3(texel, r.camera), 0).r;
    if (constants.light.w == 0) return vec2(outer, 2.0 * float(r.size_px));
    return vec2(outer, texelFetch(widths_px, ivec3(texel, r.camera + constants.light.y), 0).r);
}

// Farther from an edge than this, all texels around a place are on the same side of it.
const float besideEdge_px = 2.5;

// False where no light camera sees the receiver: nothing can shadow it.
bool startReceiving(Receiver receiver, out Receiving r) {
    r.camera = deepestCamera(receiver.posLight);
    if (r.camera < 0) return false;
    r.isFacing = isFacing(receiver, false);
    r.point = mapPoint(r.camera, receiver.posLight);
    r.normalFace = mat3(lightCameras[r.camera].faceFromLight) * receiver.normalLight;
    r.size_px = textureSize(depthMaps, 0).x;
    r.isOrthographic = lightCameras[r.camera].depth.z == 1.0;
    r.texel = lightCameras[r.camera].depth.w;
    // The shear of the footprint lengthens it by no more than the ray is longer than its depth.
    float longer = r.isOrthographic ? 1.0 : length(r.point.posFace) / r.point.posFace.z;
    float widest = constants.nearest.y * longer * max(spreadOf(r, constants.nearest.x), 0.0);
    r.limit_px = min(widest / r.texel, float(r.size_px));
    return true;
}

// SPDX-License-Identifier: Apache-2.0
// What both passes of the exact mode know of a receiver.
#include "src/techniques/shadow_width_map/receiver.glsl"

layout(binding = 4) uniform sampler2DArray widths_px;

// As in hard shadow maps: what a flat receiver needs at most for rounding, and a right angle lit at 45 degrees for
// bending within a texel.
const float toleranceTexels = 1.0;
const float tolerancePrecision = 4e-6;

// The camera's constants are copied: software rasterizers read a storage block anew for every pixel and use.
struct Receiving {
    int camera;
    MapPoint point;
    vec4 window, depth;  // of the camera
    vec3 normalFace;
    float height_m;      // of the receiver's plane: dot(normalFace, point.posFace)
    bool isFacing;       // the light's centre is above the horizon
    bool isOrthographic;
    int size_px;
    float widest;        // half extent of the light's footprint, at most
};

float depthOf(Receiving r, float stored) {
    return r.isOrthographic ? r.depth.y - stored * (r.depth.y - r.depth.x) : r.depth.x / stored;
}

// Whether what a texel sees, if anything, could hide some of the light: it is in front of the receiver's plane, seen from
// the light's centre; or above the receiver's horizon, where the centre is below it.
bool isAbove(Receiving r, ivec2 texel, float stored) {
    float blocker_m = depthOf(r, max(stored, 1e-30));
    float tolerance_m = toleranceTexels * r.point.texel_m + tolerancePrecision * length(r.point.posFace);
    vec2 place = (vec2(texel) + 0.5) / (float(r.size_px) * r.window.zw) + r.window.xy;
    // Where the plane is seen through the texel; near its horizon, within bounds (receiverPlaneDepth_m).
    float farthest_m = 64.0 * r.point.texel_m;
    float along = r.isOrthographic ? r.normalFace.z : dot(r.normalFace, vec3(place, 1.0));
    float above_m = r.isOrthographic ? r.height_m - dot(r.normalFace.xy, place) : r.height_m;
    float plane_m = above_m * along > 0.0 || r.isOrthographic ? above_m / along : r.point.posFace.z + farthest_m;
    plane_m = clamp(plane_m, r.point.posFace.z - farthest_m, r.point.posFace.z + farthest_m);
    float overHorizon_m = along * blocker_m - above_m;
    return stored > 0.0 && (r.isFacing ? plane_m - tolerance_m > blocker_m : overHorizon_m > tolerance_m);
}

float spreadOf(Receiving r, float blocker_m) {
    return r.isOrthographic ? r.point.posFace.z - blocker_m : 1.0 / blocker_m - 1.0 / r.point.posFace.z;
}

// No penumbra of a blocker at this depth reaches farther than so many texels from its edge. Negative behind the receiver.
float reach_px(Receiving r, float blocker_m) { return r.widest * spreadOf(r, blocker_m) / r.depth.w; }

// Distances in texels to the nearest outer and inner edge.
vec2 widthsAt(Receiving r, ivec2 texel) {
    float outer = texelFetch(widths_px, ivec3(texel, r.camera), 0).r;
    if (constants.light.w == 0) return vec2(outer, 2.0 * float(r.size_px));
    return vec2(outer, texelFetch(widths_px, ivec3(texel, r.camera + constants.light.y), 0).r);
}

// Farther from an edge than this, the four texels around a place, at most 1.42 apart, are on the same side of it.
const float besideEdge_px = 1.5;

// False where no light camera sees the receiver: nothing can shadow it.
bool startReceiving(Receiver receiver, out Receiving r) {
    r.camera = deepestCamera(receiver.posLight, r.point);
    if (r.camera < 0) return false;
    LightCameraConstants camera = lightCameras[r.camera];
    r.window = camera.window;
    r.depth = camera.depth;
    r.normalFace = mat3(camera.faceFromLight) * receiver.normalLight;
    r.height_m = dot(r.normalFace, r.point.posFace);
    r.isFacing = isFacing(receiver, false);
    r.isOrthographic = camera.depth.z == 1.0;
    r.size_px = textureSize(depthMaps, 0).x;
    // The shear of the footprint lengthens it by no more than the ray is longer than its depth.
    r.widest = constants.extent.x * (r.isOrthographic ? 1.0 : length(r.point.posFace) / r.point.posFace.z);
    return true;
}

// SPDX-License-Identifier: Apache-2.0
// What both passes of the exact mode know of a receiver.
#include "src/techniques/shadow_width_map/receiver.glsl"
#include "src/techniques/shadow_width_map/spread.glsl"

// What stands above the receiver's plane: all whose nearness (storedNearness), times `weight`, plus an affine function of the
// place in the map, is more than `tolerance`. On any plane, nearness is affine in the map.
struct AbovePlane {
    float weight, tolerance;
    float here, least, most;  // the affine function at the receiver, and its bounds
    vec2 slope;               // a texel
};

struct Receiving {
    int camera, size_px;
    vec2 place_px;
    vec3 posFace;
    MapDepth depth;  // the camera's
    float nearness;
    AbovePlane above;
};

// Where the light's centre is above the receiver's horizon, what is in front of the plane as the centre sees it; bounded
// near the plane's horizon (receiverPlaneDepth_m). Else, what stands on the plane's lit side.
AbovePlane abovePlane(Receiving r, float texel_m, vec3 normalFace, bool isFacing, bool isOrthographic) {
    float height_m = dot(normalFace, r.posFace);
    float tolerance_m = mapTolerance_m(texel_m, r.posFace);
    vec2 slope = normalFace.xy * r.depth.texelSize;
    if (!isFacing) {
        if (isOrthographic) return AbovePlane(-normalFace.z, tolerance_m, -normalFace.z * r.posFace.z, -3e38, 3e38, slope);
        return AbovePlane(-height_m - tolerance_m, 0.0, height_m * r.nearness, -3e38, 3e38, slope);
    }
    float squared = isOrthographic ? 1.0 : r.nearness * r.nearness;
    float farthest = 64.0 * texel_m;
    float least = isOrthographic ? farthest : 1.0 / max(r.posFace.z - farthest, 1e-3 * r.posFace.z) - r.nearness;
    float most = isOrthographic ? farthest : r.nearness - 1.0 / (r.posFace.z + farthest);
    return AbovePlane(1.0, tolerance_m * squared, -r.nearness, -r.nearness - least, -r.nearness + most,
                      -slope / (isOrthographic ? normalFace.z : height_m));
}

// Whether what a texel sees, if anything, could hide some of the light.
bool isAbove(Receiving r, ivec2 texel, float stored) {
    float plane = r.above.here + dot(r.above.slope, vec2(texel) + 0.5 - r.place_px);
    plane = clamp(plane, r.above.least, r.above.most);
    return stored > 0.0 && r.above.weight * storedNearness(r.depth, stored) + plane > r.above.tolerance;
}

float storedHere(Receiving r) { return texelFetch(depthMaps, ivec3(r.place_px, r.camera), 0).r; }

// False where no light camera sees the receiver: nothing can shadow it.
bool startReceiving(Receiver receiver, out Receiving r) {
    MapPoint point;
    r.camera = deepestMap(receiver.posLight, point);
    if (r.camera < 0) return false;
    LightCameraConstants camera = cameraOf(r.camera);
    r.size_px = textureSize(depthMaps, 0).x;
    r.place_px = point.uv * float(r.size_px);
    r.posFace = point.posFace;
    r.depth = camera.depth;
    bool isOrthographic = camera.depth.isOrthographic;
    r.nearness = isOrthographic ? -r.posFace.z : 1.0 / r.posFace.z;
    vec3 normalFace = turnedToFace(r.camera, receiver.normalLight);
    r.above = abovePlane(r, point.texel_m, normalFace, isFacing(receiver, false), isOrthographic);
    return true;
}

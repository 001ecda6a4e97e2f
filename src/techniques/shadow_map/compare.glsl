// SPDX-License-Identifier: Apache-2.0
// The comparison that `hard` and `pcf` make, free of a bias that a user would have to tune (map_depth.glsl).
#include "src/techniques/common/light_plane.glsl"

// The light's centre is above the surface's horizon, and the surface where the light emits to.
bool isFacingCenter(Receiver receiver, LightConstants light) {
    vec3 towardsLight = light.shape == shapeDistant ? vec3(0.0, 0.0, 1.0) : -receiver.posLight;
    return dot(receiver.normalLight, towardsLight) > 0.0 && !isOutsideEmission(receiver.posLight, light);
}

// Whether a texel that holds `stored` lets the light's centre see the receiver.
bool isDepthLit(int camera, MapPoint point, vec3 normalFace, ivec2 texel, float stored, int size_px) {
    vec2 uv = (vec2(texel) + 0.5) / float(size_px);
    float receiver_m = receiverPlaneDepth_m(camera, point, normalFace, uv, 64.0 * point.texel_m, 0.0);
    float tolerance_m = mapTolerance_m(point.texel_m, point.posFace);
    return receiver_m - tolerance_m <= depthFace_m(camera, stored);
}

// 1 if the light's centre sees the receiver, going by the nearest texel; 0 if not.
float nearestTexelLit(int camera, MapPoint point, vec3 normalFace) {
    int size_px = textureSize(depthMaps, 0).x;
    ivec2 texel = ivec2(point.uv * float(size_px));
    float stored = texelFetch(depthMaps, ivec3(texel, camera), 0).r;
    return isDepthLit(camera, point, normalFace, texel, stored, size_px) ? 1.0 : 0.0;
}

// The first camera that sees the receiver, or -1.
int findCamera(int mapCount, vec3 posLight, out MapPoint point) {
    for (int camera = 0; camera < mapCount; ++camera) {
        point = mapPoint(camera, posLight);
        if (isInWindow(camera, point)) return camera;
    }
    return -1;
}

// SPDX-License-Identifier: Apache-2.0
// Looking things up in depth maps (depth_map.h).
#include "src/techniques/common/map_depth.glsl"

uniform sampler2DArray depthMaps;
layout(std430) readonly buffer LightCameras { LightCameraConstants lightCameras[]; };

// A point as a light camera sees it.
struct MapPoint {
    vec3 posFace;    // metres; z along the camera's axis
    vec2 uv;         // [0, 1] over the window
    float texel_m;   // a texel's size at the point's depth
};

// From a position in the camera's own space.
MapPoint mapPointOfFace(LightCameraConstants c, vec3 posFace) {
    MapPoint point;
    point.posFace = posFace;
    bool orthographic = c.depth.isOrthographic;
    vec2 place = orthographic ? point.posFace.xy : point.posFace.xy / point.posFace.z;
    point.uv = (place - c.window.min) * c.window.perExtent;
    point.texel_m = c.depth.texelSize * (orthographic ? 1.0 : point.posFace.z);
    return point;
}
MapPoint mapPoint(int camera, vec3 posLight) {
    LightCameraConstants c = lightCameras[camera];
    return mapPointOfFace(c, (c.faceFromLight * vec4(posLight, 1.0)).xyz);
}

// Whether the point lies in front of the camera and in its window.
bool isInWindow(LightCameraConstants c, MapPoint point) {
    return (c.depth.isOrthographic || point.posFace.z > 0.0) && all(greaterThanEqual(point.uv, vec2(0.0))) &&
           all(lessThan(point.uv, vec2(1.0)));
}
bool isInWindow(int camera, MapPoint point) { return isInWindow(lightCameras[camera], point); }

float depthFace_m(int camera, float stored) { return storedDepth_m(lightCameras[camera].depth, stored); }

// Where the plane through the point with the normal is seen in the direction of another place in the map, `uv`.
// Compared with this depth, a plane never shadows itself, however steeply the light falls on it. The answer is bounded by
// `before_m` and `behind_m` of the point: the plane has a horizon; and where texels about the point answer for the point
// itself, nothing behind it can shadow it (behind_m = 0).
float receiverPlaneDepth_m(int camera, MapPoint point, vec3 normalFace, vec2 uv, float before_m, float behind_m) {
    LightCameraConstants c = lightCameras[camera];
    vec2 place = uv / c.window.perExtent + c.window.min;
    float depth_m;
    if (c.depth.isOrthographic) {
        vec2 slope = -normalFace.xy / normalFace.z;
        depth_m = point.posFace.z + dot(slope, place - point.posFace.xy);
    } else {
        float across = dot(normalFace, point.posFace);
        float along = dot(normalFace, vec3(place, 1.0));
        depth_m = across * along > 0.0 ? across / along : point.posFace.z + behind_m;
    }
    return clamp(depth_m, point.posFace.z - before_m, point.posFace.z + behind_m);
}

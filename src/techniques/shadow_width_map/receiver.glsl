// SPDX-License-Identifier: Apache-2.0
// What both resolving shaders ask of the light, the receiver and the maps.
#include "src/techniques/common/view.glsl"
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_width_map/shadow_width_io.h"

layout(std140) uniform ShadowWidthBlock { ShadowWidthConstants constants; };
uniform writeonly image2D visibility;

// Whether any of the light, or its centre, is above the surface's horizon and on the side that the light emits to.
bool isFacing(Receiver receiver, bool anyOfLight) {
    vec3 normal = receiver.normalLight;
    float height_m = -dot(normal, constants.light.shape == shapeDistant ? constants.emission : receiver.posLight);
    if (anyOfLight) {
        float across = constants.light.shape == shapeDistant ? sqrt(max(1.0 - height_m * height_m, 0.0)) : 1.0;
        height_m += constants.radius * across;
        float x = dot(normal, constants.halfAxisX), y = dot(normal, constants.halfAxisY);
        height_m += constants.light.shape == shapeRect ? abs(x) + abs(y) : length(vec2(x, y));
    }
    // Nothing but a line of the light above the horizon is nothing.
    float least_m = anyOfLight ? 1e-5 * length(receiver.posLight) : 0.0;
    return height_m > least_m && (!constants.light.isOneSided || dot(receiver.posLight, constants.emission) > 0.0);
}

// Software rasterizers run both sides of every branch, and read a storage block anew for every pixel and use; most lights
// have one map, and the constants of that lie in the uniform block too.
#ifdef KINDS
const int kinds = KINDS;
#else
int kinds = constants.kinds;
#endif

#ifdef ONE_MAP
const int mapCount = 1;
LightCameraConstants cameraOf(int map) { return constants.firstCamera; }
vec3 turnedToFace(int map, vec3 direction) { return direction; }
vec3 movedToFace(int map, vec3 pos) { return pos; }
#else
int mapCount = constants.mapCount;
LightCameraConstants cameraOf(int map) {
    if (mapCount == 1) return constants.firstCamera;
    return lightCameras[map];
}
vec3 turnedToFace(int map, vec3 direction) { return mat3(cameraOf(map).faceFromLight) * direction; }
vec3 movedToFace(int map, vec3 pos) { return (cameraOf(map).faceFromLight * vec4(pos, 1.0)).xyz; }
#endif

// How far inside a distant light's map, in shares of its window, whatever may shade a receiver is in the map too: as far as
// fitMapCameras() widens windows, or as far as any penumbra there reaches.
float farInside(LightCameraConstants camera) {
    float depth_m = camera.depth.far_m - camera.depth.near_m;
    return min(widestMargin, constants.radius * depth_m * max(camera.window.perExtent.x, camera.window.perExtent.y));
}

// The map in whose window the receiver lies deepest, so that all that surrounds its shadow is in the map too; of a distant
// light's, which go from fine to coarse, the first in which it lies deep enough for that. -1 if none sees it.
int deepestMap(vec3 posLight, out MapPoint best) {
    int bestMap = -1;
    float deepest = 0.0;
    best = MapPoint(vec3(0.0, 0.0, 1.0), vec2(0.0), 0.0);
    for (int map = 0; map < mapCount; ++map) {
        LightCameraConstants camera = cameraOf(map);
        MapPoint point = mapPointOfFace(camera, movedToFace(map, posLight));
        float inside = min(min(point.uv.x, 1.0 - point.uv.x), min(point.uv.y, 1.0 - point.uv.y));
        if (!isInWindow(camera, point) || inside < deepest) continue;
        deepest = inside;
        best = point;
        bestMap = map;
        if (camera.depth.isOrthographic && inside >= farInside(camera)) break;
    }
    return bestMap;
}

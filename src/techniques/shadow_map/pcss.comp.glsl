// SPDX-License-Identifier: Apache-2.0
#version 450
// Percentage-closer soft shadows (Fernando 2005): search for blockers, estimate the penumbra, filter. See README.md for
// what departs from the sketch, and why.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/shadow_map/shadow_map_io.h"
#include "src/techniques/common/light_plane.glsl"
#include "src/techniques/shadow_map/light_frame.glsl"
#include "src/techniques/shadow_map/nearest_tiles.glsl"

layout(std140) uniform Constants { PcssConstants pcss; };
layout(std430) readonly buffer SearchPattern { vec4 searchPattern[]; };  // direction, distance
layout(std430) readonly buffer FilterPattern { vec2 filterPattern[]; };  // square or disk
layout(std430) readonly buffer NearestTiles { float nearestTiles[][tangents]; };

uniform sampler2D radiance;
uniform writeonly image2D visibility;

const float largestK = 1e4;
// Always all of them: after a loop that some invocations leave early, llvmpipe of Mesa 25.0 ran what follows for none.
const int mostRounds = 4;
const int mostSearches = 8;
const float rounding = 1.01;  // what bounds of k may be short of
// A blocker hides light where it is seen within the light's outline, times its own k. What is seen farther beside than so
// many times that belongs to something else, as the wall behind a corner. Of 3, 4 and 8 the last takes no umbra's blockers.
const float mostOutlines = 8.0;

// What makes one pixel's pattern differ from the next one's; nothing by default.
struct Dither {
    mat2 rotation;
    vec2 shift;
};

// Interleaved gradient noise (Jimenez 2014).
float gradientNoise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

Dither ditherOf(ivec2 pixel) {
    if (!pcss.isRotated) return Dither(mat2(1.0), vec2(0.0));
    float noise = gradientNoise(vec2(pixel));
    float angle = 6.2831853 * noise;
    mat2 rotation = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    return Dither(rotation, vec2(noise, gradientNoise(vec2(pixel) + 5.588238)));
}

LightFrame frameOf(Receiver receiver, vec3 upLight) {
    LightFrame frame;
    frame.pos = receiver.posLight;
    frame.normal = receiver.normalLight;
    frame.axisX = vec3(pcss.light.halfSize.x, 0.0, 0.0);
    frame.axisY = vec3(0.0, pcss.light.halfSize.y, 0.0);
    frame.away = vec3(0.0, 0.0, receiver.posLight.z < 0.0 || pcss.light.shape == shapeDistant ? -1.0 : 1.0);
    frame.distance_m = pcss.light.shape == shapeDistant ? 1.0 : abs(receiver.posLight.z);
    if (pcss.light.shape == shapeSphere) {
        // The disk through the centre that fills the cone in which the sphere is seen.
        frame.distance_m = max(length(receiver.posLight), 1e-30);
        frame.away = receiver.posLight / frame.distance_m;
        float sine = min(pcss.light.halfSize.x / frame.distance_m, 0.999);
        float radius_m = frame.distance_m * sine / sqrt(1.0 - sine * sine);
        vec3 sideways = normalize(cross(upLight, frame.away));
        frame.axisX = radius_m * sideways;
        frame.axisY = radius_m * cross(frame.away, sideways);
    }
    return frame;
}

// A point of the unit disk, spread evenly over it, as one spread evenly over the cone's solid angle: with u = r^2, the
// cosine is 1 - u (1 - cos A), and the radius the tangent that goes with it, divided by that of A.
vec2 evenInSolidAngle(vec2 place, float oneMinusCosine) {
    float m = oneMinusCosine, u = dot(place, place);
    return place * sqrt((2.0 - u * m) / (2.0 - m)) * (1.0 - m) / (1.0 - u * m);
}

vec2 lightPlace(int i, Dither dither, float oneMinusCosine) {
    vec2 place = filterPattern[i];
    if (pcss.light.shape == shapeRect) return !pcss.isRotated ? place : 2.0 * fract(0.5 * place + 0.5 + dither.shift) - 1.0;
    place = dither.rotation * place;
    return pcss.light.shape == shapeDisk ? place : evenInSolidAngle(place, oneMinusCosine);
}

// The closeness of the nearest blocker in the part of a map where the light's outline, times k, is seen; for receivers of
// a tangent (nearest_tiles.glsl).
float closestWithin(int camera, LightFrame face, float k, int tangent) {
    LightCameraConstants c = lightCameras[camera];
    bool orthographic = c.depth.isOrthographic;
    vec2 low = vec2(1e30), high = vec2(-1e30);
    int before = 0;
    for (int i = 0; i < 4; ++i) {
        vec2 corner = k * vec2((i & 1) * 2 - 1, (i & 2) - 1);
        vec3 aim = face.pos + corner.x * face.axisX + corner.y * face.axisY;
        if (!orthographic && aim.z <= 0.0) continue;
        ++before;
        vec2 uv = ((orthographic ? aim.xy : aim.xy / aim.z) - c.window.min) * c.window.perExtent;
        low = min(low, uv);
        high = max(high, uv);
    }
    if (before == 0) return -3.4e38;
    if (before < 4) {
        low = vec2(0.0);
        high = vec2(1.0);
    }
    if (any(lessThan(high, vec2(0.0))) || any(greaterThan(low, vec2(1.0)))) return -3.4e38;
    float tiles = float(textureSize(depthMaps, 0).x) / float(pcss.tile_px);
    ivec2 first = min(ivec2(clamp(low, 0.0, 1.0) * tiles), tilesAcross - 1);
    ivec2 last = min(ivec2(clamp(high, 0.0, 1.0) * tiles), tilesAcross - 1);
    int level = 0;
    while (level < pyramidLevels - 1 && any(greaterThan((last >> level) - (first >> level), ivec2(1)))) ++level;
    first >>= level;
    last >>= level;
    int start = camera * tilesPerMap + pyramidStart(level), across = tilesAcross >> level;
    return max(max(nearestTiles[start + first.y * across + first.x][tangent],
                   nearestTiles[start + first.y * across + last.x][tangent]),
               max(nearestTiles[start + last.y * across + first.x][tangent],
                   nearestTiles[start + last.y * across + last.x][tangent]));
}

// The largest k that a blocker may have which hides some of the light; 0 if none does. It lies where the light's outline,
// times its own k, is seen: so the region to look for it in shrinks with what is found there.
float largestKOfBlockers(int camera, LightFrame face, LightFrame lightFrame) {
    bool orthographic = lightCameras[camera].depth.isOrthographic;
    int tangent = tangentIndex(length(lightFrame.pos.xy) / max(abs(lightFrame.pos.z), 1e-30));
    float k = largestK;
    for (int round = 0; round < mostRounds; ++round) {
        float closest = closestWithin(camera, face, k, tangent);
        for (int other = 0; other < pcss.mapCount; ++other) {
            if (other == camera) continue;
            closest = max(closest, closestWithin(other, faceFrame(other, lightFrame), k, tangent));
        }
        float largest = orthographic ? face.pos.z + closest : face.distance_m * closest - 1.0;
        // A blocker nearer to the receiver than the tolerance is none.
        bool isNone = largest < 0.5 * toleranceTexels * lightCameras[camera].depth.texelSize;
        k = k == 0.0 || isNone ? 0.0 : min(k, largest);
    }
    return k;
}

// The mean k of the blockers that may hide some of the light, none of which is larger than `k`; 0 if there are none. A
// blocker hides some where it is seen within the light's outline, times its own k; beside that, up to the taps' distance.
// What has a larger k than all that do lies beside the light, as a room's walls and ceiling: it is no blocker, and the
// search goes on nearer to the receiver, with `k` no larger than the largest of those that do.
float searchBlockers(int camera, LightFrame face, LightFrame lightFrame, Dither dither, inout float k) {
    float apart = 0.5 / sqrt(float(pcss.searchSamples));
    for (int round = 0; round < mostSearches; ++round) {
        float area = 0.0, areaTimesK = 0.0, areaOverK = 0.0, largest = 0.0, largestHiding = 0.0;
        for (int i = 0; i < pcss.searchSamples; ++i) {
            vec2 direction = dither.rotation * searchPattern[i].xy;
            float outline = pcss.light.shape == shapeRect ? 1.0 / max(abs(direction.x), abs(direction.y)) : 1.0;
            float fraction = searchPattern[i].z;
            Tap tap = tapAny(camera, pcss.mapCount, face, lightFrame, k * fraction * outline * direction);
            bool isFarBeside = mostOutlines * (tap.k + apart * k) < fraction * k;
            if (!tap.isBlocked || tap.k > rounding * k || isFarBeside) continue;
            // Its part of the searched area. Distances are even, hence the factor; the centre has a disk to itself.
            float part = max(fraction, 0.25 / float(pcss.searchSamples)) * outline * outline;
            area += part;
            areaTimesK += part * tap.k;
            areaOverK += part / tap.k;
            largest = max(largest, tap.k);
            if (fraction * k <= tap.k + apart * k) largestHiding = max(largestHiding, tap.k);
        }
        if (largestHiding == 0.0) return 0.0;
        k = min(k, largestHiding);
        if (largest <= rounding * largestHiding) return pcss.meanIsHarmonic ? area / areaOverK : areaTimesK / area;
    }
    return k;
}

vec3 seenBy(Receiver receiver, Dither dither) {
    bool isDistant = pcss.light.shape == shapeDistant;
    if (isOutsideEmission(receiver.posLight, pcss.light)) return vec3(0.0);
    int camera = -1;
    MapPoint point;
    for (int i = 0; i < pcss.mapCount && camera < 0; ++i) {
        point = mapPoint(i, receiver.posLight);
        if (isInWindow(i, point)) camera = i;
    }
    vec3 upLight = camera < 0 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 1.0, 0.0) * mat3(lightCameras[camera].faceFromLight);
    LightFrame frame = frameOf(receiver, upLight);

    // None of the light, or nothing but a line of it, above the horizon.
    vec2 slope = vec2(dot(frame.normal, frame.axisX), dot(frame.normal, frame.axisY));
    float widest = pcss.light.shape == shapeRect ? abs(slope.x) + abs(slope.y) : length(slope);
    float center = dot(frame.normal, towardsLight(frame, vec2(0.0), isDistant));
    if (center + widest <= 0.0) return vec3(0.0);
    if (camera < 0 || frame.distance_m == 0.0) return vec3(1.0);

    LightFrame face = faceFrame(camera, frame);
    float largest = largestKOfBlockers(camera, face, frame);
    if (largest == 0.0) return vec3(1.0);
    float k = searchBlockers(camera, face, frame, dither, largest);
    if (k == 0.0) return vec3(1.0);

    float sine = min(pcss.light.halfSize.x / frame.distance_m, 0.999);
    float oneMinusCosine =
        pcss.light.shape == shapeSphere ? sine * sine / (1.0 + sqrt(1.0 - sine * sine)) : pcss.oneMinusCosine;
    vec3 lit = vec3(0.0), all = vec3(0.0);
    for (int i = 0; i < pcss.filterSamples; ++i) {
        vec2 place = lightPlace(i, dither, oneMinusCosine);
        if (center + dot(slope, place) <= 0.0) continue;
        vec3 weight = pcss.light.isTextured ? textureLod(radiance, 0.5 * place + 0.5, 0.0).rgb : vec3(1.0);
        all += weight;
        Tap tap = tapAny(camera, pcss.mapCount, face, frame, k * place);
        if (!tap.isBlocked || tap.k > rounding * largest) lit += weight;
    }
    return mix(vec3(0.0), lit / max(all, vec3(1e-30)), greaterThan(all, vec3(0.0)));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    vec3 seen = loadReceiver(pixel, receiver) ? seenBy(receiver, ditherOf(pixel)) : vec3(1.0);
    imageStore(visibility, pixel, vec4(clamp(seen, 0.0, 1.0), 1.0));
}

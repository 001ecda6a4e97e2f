// SPDX-License-Identifier: Apache-2.0
// What a depth map proves of the light that a receiver sees, whatever has been concluded from edges.
//
// Take rays from the receiver to points of the light. The surfaces in the map are really there: a ray that goes through one is
// blocked. And nothing stands higher than they do: a ray that never passes beneath any is free. Rays that pass beneath
// something and go through nothing in sight may be either. So the light that is seen lies between the share of free rays and
// that of rays that are not blocked. All four texels about a place must agree, so that both hold to a texel.
//
// Nearness (storedNearness) is linear along a ray in the window, and a ray of the light's point s moves from the receiver's
// place by (s.xy - s.z place) times the nearness that it gains; of a distant light, by s.xy times the metres.
#ifndef PENUMBRA_MAP_PROOF
#define PENUMBRA_MAP_PROOF
#include "src/techniques/common/light_points.glsl"
#include "src/techniques/common/map_depth.glsl"

const int proofRays = 16, proofLattice = 5;  // the rank-1 lattice of so many points, whose points are farthest apart
const int proofHeights = 4;                  // samples along a ray
const float proofSlope = 0.05;               // of the height over the receiver: surfaces no further apart go on
const float leastCosine = 0.25;              // a plane that the centre sees from behind is compared as if its light fell so
const float proofNoise = 0.05;               // of a share of all rays, or of none
const float proofNoiseBetween = 0.5;         // more of a share p: this much of p (1 - p)
const float proofTrust = 0.1;                // beyond its noise, a share counts alone
const float nothingAbove = -3e38;

struct MapReceiver {
    int map;
    MapWindow window;
    MapDepth depth;
    vec3 posFace, normalFace;
    float tolerance_m;  // mapTolerance_m
};

struct Proof {
    float least, most;  // share of the light above the receiver's horizon
};

// The nearness of the four texels about a place, where they stand above the receiver's plane.
vec4 surfacesAbove(sampler2DArray maps, MapReceiver r, vec2 place) {
    vec2 size_px = vec2(textureSize(maps, 0).xy);
    vec2 uv = (place - r.window.min) * r.window.perExtent;
    vec4 stored = textureGather(maps, vec3(uv, r.map));
    vec2 corner = (floor(uv * size_px - 0.5) + 0.5) / (size_px * r.window.perExtent) + r.window.min;
    vec2 steps = r.normalFace.xy / (size_px * r.window.perExtent);
    float height = dot(r.normalFace, r.posFace), across = dot(r.normalFace.xy, corner);
    vec4 along = across + vec4(steps.y, steps.x + steps.y, steps.x, 0.0);  // in the order of a gather
    vec4 nearness, over_m;
    if (r.depth.isOrthographic) {
        nearness = stored * (r.depth.far_m - r.depth.near_m) - r.depth.far_m;
        over_m = along - r.normalFace.z * nearness - height;
        along = vec4(r.normalFace.z);
    } else {
        nearness = stored / r.depth.near_m;
        along += r.normalFace.z;
        over_m = along / max(nearness, 1e-30) - height;
    }
    bvec4 isAbove = greaterThan(over_m, r.tolerance_m * max(abs(along), height < 0.0 ? 0.0 : leastCosine));
    // Maps of the farthest surfaces hold 1 where there is none.
    bvec4 isSurface = equal(stored, clamp(stored, 1e-30, 1.0 - 1e-7));
    return mix(vec4(nothingAbove), nearness, bvec4(ivec4(isAbove) * ivec4(isSurface)));
}

bool isInWindow(MapReceiver r, vec2 place) {
    vec2 uv = (place - r.window.min) * r.window.perExtent;
    return all(greaterThan(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
}

float highestOf(vec4 surfaces) { return max(max(surfaces.x, surfaces.y), max(surfaces.z, surfaces.w)); }

// Whether a ray goes through the surface that has been seen beside it, `rise` above the receiver: if, where the ray is as
// high, that is still there.
bool goesThrough(sampler2DArray maps, MapReceiver r, vec2 here, vec2 way, float nearness, float top) {
    float rise = top - nearness;
    vec2 place = here + way * rise;
    return rise > 0.0 && isInWindow(r, place) && highestOf(abs(surfacesAbove(maps, r, place) - top)) < proofSlope * rise;
}

// `highest`: the nearness up to which blockers are looked for. Where `hasFarthest`, other maps hold the farthest surfaces.
Proof proofOf(sampler2DArray maps, sampler2DArray farthestMaps, bool hasFarthest, MapReceiver r, LightFigure light,
              float highest) {
    bool isDistant = r.depth.isOrthographic;
    vec2 here = isDistant ? r.posFace.xy : r.posFace.xy / r.posFace.z;
    float nearness = isDistant ? -r.posFace.z : 1.0 / r.posFace.z;
    float rise = (highest - nearness) / float(proofHeights);
    float known = 0.0, free = 0.0, blocked = 0.0;
    for (int i = 0; i < proofRays; ++i) {
        // Along either axis they are as far apart as so many can be, so that none is far from the light's border.
        vec2 u = (vec2(i, proofLattice * i % proofRays) + 0.5) / float(proofRays);
        vec3 point = lightPoint(light, u, here);
        if (dot(r.normalFace, isDistant ? vec3(point.xy, -1.0) : point - r.posFace) <= 0.0) continue;
        vec2 way = isDistant ? point.xy : point.xy - point.z * here;
        float earlier = fract(0.618034 * float(i) + 0.5);  // so that rays look at different heights
        bool isFree = true, isBlocked = false;
        for (int k = 1; k <= proofHeights; ++k) {
            float above = rise * (k == proofHeights ? float(k) : float(k) - earlier);  // what is highest is found by all
            vec2 place = here + way * above;
            float top = highestOf(surfacesAbove(maps, r, place));
            // Whatever it has passed since the last place counts.
            isFree = isFree && isInWindow(r, place) && top < nearness + above - rise;
            isBlocked = isBlocked || goesThrough(maps, r, here, way, nearness, top);
            // A loop, since software rasterizers run both sides of a branch.
            for (int second = 0; second < int(hasFarthest); ++second) {
                float farthest = highestOf(surfacesAbove(farthestMaps, r, place));
                isBlocked = isBlocked || goesThrough(farthestMaps, r, here, way, nearness, farthest);
            }
        }
        known += 1.0;
        if (isFree) free += 1.0;
        if (isBlocked) blocked += 1.0;
    }
    return known == 0.0 ? Proof(0.0, 1.0) : Proof(free / known, 1.0 - blocked / known);
}

// Light within what is proven, as far as that is beyond its noise.
float within(Proof proof, float seen) {
    float bound = clamp(seen, proof.least, proof.most), off = seen - bound;
    float noise = proofNoise + proofNoiseBetween * bound * (1.0 - bound);
    return seen - off * smoothstep(noise, noise + proofTrust, abs(off));
}

// Of a light whose channels differ rays tell no more than that they are all blocked, or all free.
vec3 within(Proof proof, vec3 seen) { return proof.most <= 0.0 ? vec3(0.0) : proof.least >= 1.0 ? vec3(1.0) : seen; }
#endif

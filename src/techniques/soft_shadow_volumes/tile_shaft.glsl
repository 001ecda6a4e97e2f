// SPDX-License-Identifier: Apache-2.0
// The space between a tile's receivers and the light, or its centre: the convex hull of two boxes (Haines and Wallace
// 1991). What is outside of it hides nothing from them. Requires volumes_io.h.

struct TileBounds {
    vec4 low;   // of the receivers that see some of the light, in light space; low.x > high.x: there are none
    vec4 high;
};

const int shaftPlaneCount = 18;

TileBounds lightBounds(TileBounds tile) {
    TileBounds bounds;
    if (volume.light.shape == shapeDistant) {
        // All light arrives from within a cone; beyond the highest caster it no longer matters.
        float height = max(volume.highest_m - tile.low.z, 0.0);
        vec3 spread = vec3(vec2(height * volume.light.halfSize.x), 0.0);
        bounds.low = vec4(tile.low.xyz - spread, 0.0);
        bounds.high = vec4(tile.high.xyz + spread + vec3(0.0, 0.0, height), 0.0);
    } else if (volume.light.shape == shapeSphere) {
        bounds.low = vec4(vec3(-volume.light.halfSize.x), 0.0);
        bounds.high = -bounds.low;
    } else {
        bounds.low = vec4(-volume.light.halfSize, 0.0, 0.0);
        bounds.high = -bounds.low;
    }
    return bounds;
}

// The light's centre, as lightBounds has the light.
TileBounds centerBounds(TileBounds tile) {
    if (volume.light.shape != shapeDistant) return TileBounds(vec4(0.0), vec4(0.0));
    vec3 height = vec3(0.0, 0.0, max(volume.highest_m - tile.low.z, 0.0));
    return TileBounds(tile.low, vec4(tile.high.xyz + height, 0.0));
}

const float shaftRounding = 1e-5;  // widens the shaft by some hundred roundings of its coordinates

// Plane `index` of the hull: points with dot(plane.xyz, p) > plane.w are outside. Six bound both boxes along an axis; of
// the twelve through corresponding corners, those that do not touch the hull from outside are returned as never failing.
vec4 shaftPlane(TileBounds tile, TileBounds light, int index) {
    const vec4 never = vec4(0.0, 0.0, 0.0, 1.0);
    if (index < 3) {
        vec4 plane = vec4(0.0);
        plane[index] = 1.0;
        plane.w = max(tile.high[index], light.high[index]);
        plane.w += shaftRounding * abs(plane.w);
        return plane;
    }
    if (index < 6) {
        vec4 plane = vec4(0.0);
        plane[index - 3] = -1.0;
        plane.w = -min(tile.low[index - 3], light.low[index - 3]);
        plane.w += shaftRounding * abs(plane.w);
        return plane;
    }
    int pair = (index - 6) >> 2, corner = (index - 6) & 3;
    int i = pair == 2 ? 1 : 0, j = pair == 0 ? 1 : 2;
    vec2 side = vec2((corner & 1) == 0 ? -1.0 : 1.0, (corner & 2) == 0 ? -1.0 : 1.0);
    vec2 from = vec2(side.x < 0.0 ? tile.low[i] : tile.high[i], side.y < 0.0 ? tile.low[j] : tile.high[j]);
    vec2 to = vec2(side.x < 0.0 ? light.low[i] : light.high[i], side.y < 0.0 ? light.low[j] : light.high[j]);
    vec2 normal = vec2(to.y - from.y, from.x - to.x);
    if (dot(normal, side) < 0.0) normal = -normal;
    if (normal.x * side.x < 0.0 || normal.y * side.y < 0.0 || normal == vec2(0.0)) return never;
    vec4 plane = vec4(0.0);
    plane[i] = normal.x;
    plane[j] = normal.y;
    plane.w = max(dot(normal, from), dot(normal, to)) + shaftRounding * dot(abs(normal), abs(from) + abs(to));
    return plane;
}

// Whether all receivers of the tile are on the same side of the face; its sign tells which. 0: they are not.
float tileSide(vec4 plane, TileBounds tile) {
    vec3 middle = 0.5 * (tile.low.xyz + tile.high.xyz), reach = 0.5 * (tile.high.xyz - tile.low.xyz);
    float value = dot(plane.xyz, middle) + plane.w;
    // The margin covers the rounding of the plane, and where rounding decides (sideOf).
    float radius = dot(abs(plane.xyz), reach + 1e-5 * abs(middle)) + 1e-5 * abs(plane.w) + 1.0;
    return abs(value) > radius ? sign(value) : 0.0;
}

shared TileBounds shaftTile;
shared vec4 shaft[shaftPlaneCount];

// For all invocations of a group: makes the shaft from a tile to what it sees of the light.
void prepareShaft(TileBounds tile, TileBounds light) {
    int lane = int(gl_LocalInvocationIndex);
    barrier();
    if (lane == 0) shaftTile = tile;
    if (lane < shaftPlaneCount) shaft[lane] = shaftPlane(tile, light, lane);
    barrier();
}

// False only if no part of the box is in the shaft.
bool meetsShaft(vec3 low, vec3 high) {
    bool isOutside = low.x > high.x;
    for (int i = 0; i < shaftPlaneCount; ++i) {
        vec3 normal = shaft[i].xyz;
        isOutside = isOutside || dot(max(normal, 0.0), low) + dot(min(normal, 0.0), high) > shaft[i].w;
    }
    return !isOutside;
}

// False only if the edge hides nothing of the light from any receiver of the tile.
bool mayMatter(LightEdge edge) {
    // Without an exit in between, so that compilers unroll it.
    bool isOutside = false, isFace = edge.isFace;
    vec3 third = isFace ? edge.planes[0].xyz : edge.aLight;
    for (int i = 0; i < shaftPlaneCount; ++i) {
        vec4 plane = shaft[i];
        float nearest = min(dot(plane.xyz, edge.aLight), dot(plane.xyz, edge.bLight));
        isOutside = isOutside || min(nearest, dot(plane.xyz, third)) > plane.w;
    }
    if (isOutside || isFace) return !isOutside;
    // Two faces that all receivers see continue each other, or one behind the other's back, make no silhouette.
    float first = tileSide(edge.planes[0], shaftTile), second = tileSide(edge.planes[1], shaftTile);
    return first == 0.0 || first != -second;
}

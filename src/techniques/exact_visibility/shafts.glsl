// SPDX-License-Identifier: Apache-2.0
// Between receivers and a light: what may be in the way, what is not, and what hides all of it.

bool canSeeLight(Receiver receiver, vec3 apex) {
    SeenLight seen = seeLight(apex);
    if (seen.patches == 0) return false;
    if (light.emitter.shape == shapeDistant) {
        // The nearest the cone comes to the normal.
        return dot(receiver.normalLight, light.axisZ) > -light.coneSine - 1e-5 || light.coneCosine < 0.0;
    }
    vec3 farthest = mix(light.boxMin, light.boxMax, greaterThan(receiver.normalLight, vec3(0.0)));
    return dot(receiver.normalLight, farthest - receiver.posLight) > 0.0;
}

// Whether all of the light is above the horizon, and far from it for what rounding does.
bool canSeeWholeLight(Receiver receiver) {
    if (light.emitter.shape == shapeDistant)
        return dot(receiver.normalLight, light.axisZ) > light.coneSine + 1e-4 && light.coneCosine > 0.0;
    vec3 nearest = mix(light.boxMax, light.boxMin, greaterThan(receiver.normalLight, vec3(0.0))) - receiver.posLight;
    return dot(receiver.normalLight, nearest) > 1e-4 * length(nearest);
}

// All ways from the receivers to the light.
Shaft shaftOf(TileBounds bounds) {
    bool isDistant = light.emitter.shape == shapeDistant;
    return Shaft(bounds.low, bounds.high, inverseSlope(isDistant ? light.boxMin : light.boxMin - bounds.low),
                 inverseSlope(isDistant ? light.boxMax : light.boxMax - bounds.high), isDistant ? 3e37 : 1.0);
}

// Planes that have the tile and the light on one side: what lies beyond one of them is in nobody's way. Each leans so
// far that it touches both.
struct Sides {
    vec4 planes[4];  // normal, and how far along it tile and light reach
};

// `across` is a direction in which the light reaches `size` from its centre, `along` one in which it has no extent; of
// spheres and tubes `radius` is added along the whole normal.
vec4 sideOf(TileBounds bounds, vec3 across, vec3 along, float size, float radius) {
    vec3 middle = 0.5 * (bounds.low + bounds.high), extent = 0.5 * (bounds.high - bounds.low);
    bool isDistant = light.emitter.shape == shapeDistant;
    vec3 normal = across;
    for (int i = 0; i < 2 && !isDistant; ++i) {
        vec3 toLight = light.center - middle;
        float ahead = dot(along, toLight);
        float lean = (dot(abs(normal), extent) - size - radius * length(normal) - dot(across, toLight)) /
                     (abs(ahead) > 1e-20 ? ahead : 1e-20);
        normal = across + clamp(lean, -1e3, 1e3) * along;
    }
    // Of a distant light's directions none leads across the plane, unless they fill half of the sky.
    if (isDistant && light.coneCosine <= 0.0) return vec4(normal, 3e38);
    if (isDistant) normal = light.coneCosine * across - light.coneSine * along;
    float ofTile = dot(normal, middle) + dot(abs(normal), extent);
    float ofLight = dot(normal, light.center) + size + radius * length(normal);
    float reach = isDistant ? ofTile : max(ofTile, ofLight);
    vec3 largest = abs(middle) + extent + abs(light.center) + size + radius;
    return vec4(normal, reach + 4e-6 * dot(abs(normal), largest));
}

Sides sidesOf(TileBounds bounds) {
    vec3 middle = 0.5 * (bounds.low + bounds.high);
    vec3 x = light.axisX, y = light.axisY, along = light.axisZ;
    vec2 size = light.emitter.halfSize;
    float radius = 0.0;
    if (light.emitter.shape == shapeSphere) {
        radius = size.x;
        size = vec2(0.0);
        vec3 toLight = light.center - middle;
        along = dot(toLight, toLight) > 0.0 ? normalize(toLight) : along;
        x = perpendicularTo(along);
        y = cross(along, x);
    } else if (isTube()) {
        radius = size.y;
        size.y = 0.0;
        vec3 toLight = light.center - middle;
        toLight -= dot(toLight, x) * x;
        if (dot(toLight, toLight) > 0.0) along = normalize(toLight);
        y = cross(along, x);
    } else if (light.emitter.shape == shapeDistant) {
        size = vec2(0.0);
    }
    return Sides(vec4[](sideOf(bounds, x, along, size.x, radius), sideOf(bounds, -x, along, size.x, radius),
                        sideOf(bounds, y, along, size.y, radius), sideOf(bounds, -y, along, size.y, radius)));
}

bool isBeyond(vec4 plane, vec3 a, vec3 b, vec3 c) {
    return min(dot(plane.xyz, a), min(dot(plane.xyz, b), dot(plane.xyz, c))) > plane.w;
}

bool isBoxBeyond(vec4 plane, vec3 middle, vec3 extent) {
    return dot(plane.xyz, middle) - dot(abs(plane.xyz), extent) > plane.w + 2e-6 * dot(abs(plane.xyz), abs(middle));
}

// Whether a box may be in the way. What is below all receivers' planes is not.
bool mayBlockTile(Shaft shaft, Sides sides, TileBounds bounds, TreeNode node) {
    vec3 middle = 0.5 * (node.boxMin + node.boxMax), extent = 0.5 * (node.boxMax - node.boxMin);
    vec3 away = abs(middle - 0.5 * (bounds.low + bounds.high)) + extent + 0.5 * (bounds.high - bounds.low);
    float height = dot(bounds.normal, middle) + dot(abs(bounds.normal), extent) - bounds.lowest +
                   (bounds.otherNormal + 1e-6) * (away.x + away.y + away.z);
    bool isBeside = isBoxBeyond(sides.planes[0], middle, extent) || isBoxBeyond(sides.planes[1], middle, extent) ||
                    isBoxBeyond(sides.planes[2], middle, extent) || isBoxBeyond(sides.planes[3], middle, extent);
    return height > 0.0 && !isBeside && mayBlock(shaft, node.boxMin, node.boxMax);
}

// Whether all receivers lie on the triangle (see underfoot.glsl, whose tolerance is twice this), or above it.
bool isUnderfootOfTile(TileBounds bounds, vec3 a, vec3 b, vec3 c) {
    vec3 middle = 0.5 * (bounds.low + bounds.high), extent = 0.5 * (bounds.high - bounds.low);
    vec3 across = cross(b - a, c - a);
    vec3 normal = sign(dot(across, bounds.normal)) * normalize(across);
    float tilt = distance(normal, bounds.normal) + bounds.otherNormal;
    vec3 sizes = max(abs(a - middle), max(abs(b - middle), abs(c - middle)));
    float size = max(sizes.x, max(sizes.y, sizes.z));
    float height = dot(normal, a - middle) - (bounds.lowest - dot(bounds.normal, middle)) + tilt * length(extent) +
                   4e-7 * length(middle);
    return tilt < 0.1 && 4.0 * length(extent) < size && height <= 0.5 * cornerRoundings * rounding * size;
}

// The same as mayBlockTile, for a triangle.
bool mayHideFromTile(TileBounds bounds, Sides sides, uint triangle) {
    vec3 a = loadCorner(triangle, 0u), b = loadCorner(triangle, 1u), c = loadCorner(triangle, 2u);
    bool isBeside = isBeyond(sides.planes[0], a, b, c) || isBeyond(sides.planes[1], a, b, c) ||
                    isBeyond(sides.planes[2], a, b, c) || isBeyond(sides.planes[3], a, b, c);
    return !isBeside && !isUnderfootOfTile(bounds, a, b, c) && !isInLightPlane(triangle);
}

// Whether each way from the receivers to the light passes an edge on the same side: `from`, from where the edge begins, is the
// middle of the receivers, `to` that of the light (distant: the direction to it); `side` is 1 or -1.
bool isPassed(vec3 from, vec3 fromExtent, vec3 to, vec3 toExtent, vec3 edge, float side) {
    vec3 across = cross(edge, to), along = cross(from, edge);
    float sizes = length(edge) * (length(to) + length(toExtent)) * (length(from) + length(fromExtent));
    float reach = dot(abs(across), fromExtent) + dot(abs(along), toExtent) +
                  length(edge) * length(fromExtent) * length(toExtent) + 1e-5 * sizes;
    return side * dot(from, across) + reach < 0.0;
}

// An edge of a triangle that hides all of the light but what is seen past this edge, on which it lies as `side` has it.
struct Border {
    vec3 from, to;
    float side;  // 0: there is none
};

// Of the last such triangles.
struct Borders {
    Border first, second, third;
};

Borders noBorders() {
    Border none = Border(vec3(0.0), vec3(0.0), 0.0);
    return Borders(none, none, none);
}

// Whether the triangles lie on both sides of one edge, past which nothing is seen then: triangles that share an edge leave no
// gap (coverage.glsl).
bool areJoined(Border one, Border other) {
    return (one.from == other.to && one.to == other.from && one.side == other.side) ||
           (one.from == other.from && one.to == other.to && one.side == -other.side);
}

// Whether a plain triangle, or it and one of the last that share an edge with it, stand between each of the receivers and all
// of the light: its plane parts them, and all ways pass inside of its edges, by more than rounding does. Then nobody need look
// at anything else.
bool hidesAll(TileBounds bounds, uint triangle, inout Borders borders) {
    vec3 a = loadCorner(triangle, 0u), b = loadCorner(triangle, 1u), c = loadCorner(triangle, 2u);
    bool isDistant = light.emitter.shape == shapeDistant;
    vec3 middle = 0.5 * (bounds.low + bounds.high), extent = 0.5 * (bounds.high - bounds.low);
    vec3 lightMiddle = 0.5 * (light.boxMin + light.boxMax), lightExtent = 0.5 * (light.boxMax - light.boxMin);
    vec3 normal = normalize(cross(b - a, c - a));
    float ahead = dot(normal, lightMiddle - (isDistant ? vec3(0.0) : a)), behind = dot(normal, middle - a);
    float side = ahead > 0.0 ? 1.0 : -1.0;
    float size = distance(a, middle) + distance(b, a) + distance(c, a) + length(extent);
    float lightSize = isDistant ? 1.0 : size + distance(a, lightMiddle) + length(lightExtent);
    bool parts = side * ahead > dot(abs(normal), lightExtent) + 1e-4 * lightSize &&
                 -side * behind > dot(abs(normal), extent) + 1e-4 * size;
    // Of a picture it depends on each pixel's depth how far above a triangle lies what lies on it.
    bool mayBeUnderfoot = !view.isOfPoints && abs(dot(normal, bounds.normal)) + bounds.otherNormal > 0.98;
    if (!parts || mayBeUnderfoot) return false;
    bool passesA = isPassed(middle - a, extent, lightMiddle - (isDistant ? vec3(0.0) : a), lightExtent, b - a, side);
    bool passesB = isPassed(middle - b, extent, lightMiddle - (isDistant ? vec3(0.0) : b), lightExtent, c - b, side);
    bool passesC = isPassed(middle - c, extent, lightMiddle - (isDistant ? vec3(0.0) : c), lightExtent, a - c, side);
    int passed = int(passesA) + int(passesB) + int(passesC);
    if (passed < 2) return false;
    Border border = Border(!passesA ? a : !passesB ? b : c, !passesA ? b : !passesB ? c : a, side);
    bool isJoined = areJoined(border, borders.first) || areJoined(border, borders.second) || areJoined(border, borders.third);
    if (passed == 2) borders = Borders(border, borders.first, borders.second);
    return passed == 3 || isJoined;
}

// SPDX-License-Identifier: Apache-2.0
// The light as a receiver sees it.
#include "src/techniques/exact_visibility/exact_io.h"

layout(std140) uniform LightBlock { ExactLight light; };

bool isFlat() { return light.emitter.shape == shapeRect || light.emitter.shape == shapeDisk; }
bool isTube() { return light.emitter.shape == shapeCylinder; }

// Whether a point counts as lying in the plane of a flat light.
bool liesInLightPlane(vec3 pos) {
    vec3 fromCenter = pos - light.center;
    return abs(dot(light.axisZ, fromCenter)) <= light.planeTolerance * (length(fromCenter) + length(light.emitter.halfSize));
}

// A part of the light, seen through a window: the sample (u, v) lies in the direction of center + u across + v along,
// and at share w of it lies what has the coordinates w (u, v, 1).
struct Patch {
    vec3 center, across, along;
    vec3 rowU, rowV, rowW;  // uvw from a vector that begins at the receiver
    // The window in the light's own coordinates, in which the light is the square or the unit disk.
    vec2 lightCenter, lightAcross, lightAlong;
    bool isCut;  // part of the window may lie beyond the disk
};

vec2 onLight(Patch patch_, vec2 uv) {
    return patch_.lightCenter + uv.x * patch_.lightAcross + uv.y * patch_.lightAlong;
}

Patch makePatch(vec3 center, vec3 across, vec3 along, vec3 axis) {
    Patch patch_;
    patch_.center = center;
    patch_.across = across;
    patch_.along = along;
    // The inverse, for across and along at right angles to axis and to each other.
    patch_.rowW = axis / dot(center, axis);
    patch_.rowU = (across - dot(center, across) * patch_.rowW) / dot(across, across);
    patch_.rowV = (along - dot(center, along) * patch_.rowW) / dot(along, along);
    patch_.lightCenter = vec2(0.0);
    patch_.lightAcross = vec2(1.0, 0.0);
    patch_.lightAlong = vec2(0.0, 1.0);
    patch_.isCut = false;
    return patch_;
}

// Makes the window smaller where only a little of the light is above the receiver's horizon, so that this little gets
// about half of the samples or more. `toSurface` is where the receiver is, from where rays start.
Patch fitToHorizon(Patch patch_, vec3 axis, vec3 normal, vec3 toSurface) {
    // The height above the receiver's plane is height + slope.x u + slope.y v, up to a factor.
    float height = dot(normal, patch_.center - toSurface);
    vec2 slope = vec2(dot(normal, patch_.across), dot(normal, patch_.along));
    vec2 center, across, along;
    if (light.emitter.shape == shapeRect || isTube()) {
        // The bounding rectangle of what remains of the square. An edge of the square remains in part where its higher
        // end is above the horizon.
        vec2 other = abs(slope.yx);
        vec2 root = -(height + other) / mix(slope, vec2(1e-30), lessThan(abs(slope), vec2(1e-30)));
        vec2 high = mix(root, vec2(1.0), greaterThan(height + slope + other, vec2(0.0)));
        vec2 low = mix(root, vec2(-1.0), greaterThan(height - slope + other, vec2(0.0)));
        vec2 size = max(0.5 * (high - low), 1e-5);
        center = clamp(0.5 * (high + low), -1.0, 1.0);
        across = vec2(size.x, 0.0);
        along = vec2(0.0, size.y);
        if (abs(slope.x) + abs(slope.y) <= height || !(height > -(abs(slope.x) + abs(slope.y)))) return patch_;
    } else {
        // The segment of the disk beyond a chord, in an ellipse around its bounding rectangle.
        float steepness = length(slope);
        float chord = -height / max(steepness, 1e-30);
        if (!(chord > 0.0 && chord < 1.0)) return patch_;
        vec2 up = slope / steepness;
        center = 0.5 * (1.0 + chord) * up;
        across = 1.41421356 * max(0.5 * (1.0 - chord), 1e-5) * up;
        along = 1.41421356 * sqrt((1.0 - chord) * (1.0 + chord)) * vec2(-up.y, up.x);
        patch_.isCut = true;
    }
    Patch cut = makePatch(patch_.center + center.x * patch_.across + center.y * patch_.along,
                          across.x * patch_.across + across.y * patch_.along,
                          along.x * patch_.across + along.y * patch_.along, axis);
    cut.lightCenter = center;
    cut.lightAcross = across;
    cut.lightAlong = along;
    cut.isCut = patch_.isCut;
    return cut;
}

vec3 perpendicularTo(vec3 axis) {
    return normalize(cross(axis, abs(axis.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
}

// A light from one receiver. Spheres and distant lights are cones of directions: those of more than 60 degrees from
// the axis are seen through the six faces of a cube.
struct SeenLight {
    vec3 toCenter;
    vec3 axis;     // cones
    float cosine;  // of the cone's half angle; -1 from inside a sphere
    float tangent; // of it, where there is one patch
    int patches;   // 0: nothing is emitted this way
    // Of a tube, whose samples lie in the plane through its two outer lines; `axis` leads there the shortest way.
    float away_m;       // of the tube's own axis
    float toPlane_m;    // of that plane, which is nearer
    float along_m;      // from the receiver to the tube's middle, along it
    float halfWidth_m;  // between the plane's middle and an outer line
};

const float wideCosine = 0.5;
const float widestTangent = 1.41421356;  // the samples lie in a disk: it goes around the square face of a cube
const float pointTangent = 1e-3;  // the size of the window in whose centre a light of size zero lies

SeenLight seeLight(vec3 apex) {
    SeenLight seen;
    seen.toCenter = light.center - apex;
    seen.axis = light.axisZ;
    seen.cosine = 1.0;
    seen.tangent = pointTangent;
    seen.patches = 1;
    bool isPoint = !light.emitter.hasSize;
    if (isFlat()) {
        float height = dot(seen.toCenter, light.axisZ);
        seen.patches = (height > 0.0 || !light.emitter.isOneSided) && abs(height) > 1e-7 * length(seen.toCenter) ? 1 : 0;
        seen.axis = height < 0.0 ? -light.axisZ : light.axisZ;
    } else if (light.emitter.shape == shapeSphere) {
        float distance_m = length(seen.toCenter);
        seen.patches = distance_m > 0.0 ? 1 : 0;
        seen.axis = seen.toCenter / max(distance_m, 1e-37);
        float sine = light.emitter.halfSize.x / max(distance_m, 1e-37);
        seen.cosine = sine < 1.0 ? sqrt((1.0 - sine) * (1.0 + sine)) : -1.0;
        if (!isPoint) seen.tangent = sine / max(seen.cosine, 0.1);
    } else if (isTube()) {
        float radius = light.emitter.halfSize.y;
        seen.along_m = dot(seen.toCenter, light.axisX);
        vec3 across = seen.toCenter - seen.along_m * light.axisX;
        seen.away_m = length(across);
        seen.patches = seen.away_m > radius * (1.0 + 1e-6) ? 1 : 0;
        seen.axis = across / max(seen.away_m, 1e-37);
        float sine = radius / max(seen.away_m, 1e-37);
        seen.toPlane_m = seen.away_m - radius * sine;
        seen.halfWidth_m = radius * sqrt(max((1.0 - sine) * (1.0 + sine), 0.0));
    } else {
        seen.cosine = light.coneCosine;
        if (!isPoint) seen.tangent = light.emitter.halfSize.x;
    }
    if (seen.patches != 0 && seen.cosine < wideCosine) seen.patches = 6;
    return seen;
}

// At what share of the way to a tube's plane one meets the tube itself, in a direction that ends on that plane.
float shareToTube(SeenLight seen, vec3 direction) {
    float radius = light.emitter.halfSize.y;
    float aside = dot(cross(seen.axis, light.axisX), direction);
    float along = seen.away_m * seen.toPlane_m, length2 = seen.toPlane_m * seen.toPlane_m + aside * aside;
    float beyond = (seen.away_m - radius) * (seen.away_m + radius);
    return beyond / (along + sqrt(max(along * along - length2 * beyond, 0.0)));
}

// Whether a direction that ends on a tube's plane meets the tube between its ends.
bool meetsTube(SeenLight seen, vec3 direction) {
    float place_m = shareToTube(seen, direction) * dot(light.axisX, direction) - seen.along_m;
    return abs(place_m) <= light.emitter.halfSize.x * (1.0 + 1e-6);
}

// Around the outline of a tube in its plane: a line along it looks the longer the more it is in front of that plane.
Patch patchOfTube(SeenLight seen, vec3 normal, vec3 toSurface) {
    vec2 size = light.emitter.halfSize;
    vec2 ends = seen.along_m + vec2(-size.x, size.x);
    vec2 stretched = ends * (1.0 + size.y / seen.away_m);
    float low = min(ends.x, stretched.x), high = max(ends.y, stretched.y);
    // A hair of width for what is only a line, or a ring.
    float least = max(1e-6 * max(size.x, size.y), 1e-37);
    Patch whole = makePatch(seen.toPlane_m * seen.axis + 0.5 * (low + high) * light.axisX,
                            max(0.5 * (high - low), least) * light.axisX,
                            max(seen.halfWidth_m, least) * cross(seen.axis, light.axisX), seen.axis);
    return fitToHorizon(whole, seen.axis, normal, toSurface);
}

Patch patchOf(SeenLight seen, int face, vec3 normal, vec3 toSurface) {
    if (isTube()) return patchOfTube(seen, normal, toSurface);
    bool isPoint = !light.emitter.hasSize;
    if (isFlat()) {
        // A light of size zero is seen through a window around it; one that is only a line keeps a hair of width.
        float least = isPoint ? pointTangent * length(seen.toCenter)
                                            : max(1e-6 * max(light.emitter.halfSize.x, light.emitter.halfSize.y), 1e-37);
        Patch whole = makePatch(seen.toCenter, max(light.emitter.halfSize.x, least) * light.axisX,
                                max(light.emitter.halfSize.y, least) * light.axisY, seen.axis);
        return isPoint ? whole : fitToHorizon(whole, seen.axis, normal, toSurface);
    }
    vec3 x = perpendicularTo(seen.axis), y = cross(seen.axis, x), z = seen.axis;
    float window = seen.tangent;
    if (seen.patches == 6) {
        window = widestTangent;
        vec3 axis = face < 2 ? z : face < 4 ? x : y;
        vec3 across = face < 2 ? x : face < 4 ? y : z;
        z = (face & 1) == 0 ? axis : -axis;
        x = across;
        y = cross(z, x);
    }
    Patch whole = makePatch(z, window * x, window * y, z);
    return isPoint || seen.patches == 6 ? whole : fitToHorizon(whole, z, normal, vec3(0.0));
}

// Up to which share of the way blockers count in the direction of a sample, as for the reference: one nearer to the
// light than 1e-5 of the way does not.
const float rayEnd = 1.0 - 1e-5;

float endOfRay(SeenLight seen, vec3 direction) {
    if (isFlat()) return rayEnd;
    if (light.emitter.shape == shapeDistant) return 3e38;
    if (isTube()) return rayEnd * shareToTube(seen, direction);
    if (light.emitter.halfSize.x == 0.0) return rayEnd * dot(seen.toCenter, direction) / dot(direction, direction);
    vec3 unit = normalize(direction);
    vec3 beside = cross(unit, seen.toCenter);
    float halfChord = sqrt(max(light.emitter.halfSize.x * light.emitter.halfSize.x - dot(beside, beside), 0.0));
    float middle = dot(unit, seen.toCenter);
    return rayEnd * (seen.cosine >= 0.0 ? middle - halfChord : middle + halfChord) / length(direction);
}

// Solid angle of a cone's sample, up to a factor: the windows are flat. 0 for what belongs to another face or lies
// beyond the cone.
float coneWeight(SeenLight seen, vec2 uv, vec3 direction) {
    float inverseLength = inversesqrt(dot(direction, direction));
    if (seen.patches == 6) {
        if (max(abs(uv.x), abs(uv.y)) * widestTangent > 1.0) return 0.0;
        if (dot(direction, seen.axis) * inverseLength < seen.cosine) return 0.0;
    }
    return inverseLength * inverseLength * inverseLength;
}

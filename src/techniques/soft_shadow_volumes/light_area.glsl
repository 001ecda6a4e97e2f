// SPDX-License-Identifier: Apache-2.0
// The light as a receiver sees it. Thesis, section 4.2.7: the space in which the receiver is the origin and the light a
// unit square (rect) or a unit disk in the plane z = 1. Blockers lie at 0 < z < 1; what lies at z < 0 is behind the
// receiver. Requires view.glsl and volumes_io.h.

const float lightTau = 6.28318530717958647692;

const float widest = 100.0;  // tangent of half of all that is over a horizon, but for a hundredth of it

struct LightFrame {
    vec3 x, y, z;      // rows of unitFromLight, to be applied to a point minus the receiver
    float handedness;  // 1 or -1: the sign of the determinant
    vec3 horizon;      // the light's points (u, v) with dot(horizon, (u, v, 1)) > 0 are above the receiver's horizon
    float rounding;    // of `horizon`: points no higher than this are on the horizon
    float tangent;     // of the angle of a sphere's or distant light's radius; 0 for flat lights
    bool isEndless;    // the light is infinitely far: nothing is behind it
    bool isInside;     // the receiver is in a spherical light, which it sees in all directions over its horizon
};

// False where none of the light can be seen for want of a side, or the receiver lies in the plane of a flat one.
bool makeLightFrame(Receiver receiver, out LightFrame frame) {
    vec3 p = receiver.posLight;
    vec3 u, v, center;
    frame.tangent = 0.0;
    frame.isEndless = false;
    frame.isInside = false;
    frame.handedness = 1.0;
    if (volume.light.shape == shapeDistant) {
        frame.tangent = volume.light.halfSize.x;
        frame.isEndless = true;
        u = vec3(frame.tangent, 0.0, 0.0);
        v = vec3(0.0, frame.tangent, 0.0);
        center = vec3(0.0, 0.0, 1.0);
        frame.x = vec3(1.0 / frame.tangent, 0.0, 0.0);
        frame.y = vec3(0.0, 1.0 / frame.tangent, 0.0);
        frame.z = center;
    } else if (volume.light.shape == shapeSphere) {
        // The circle in which a cone from the receiver touches the sphere. All that lies in the cone, clear of the
        // sphere, is before the circle's plane or behind it as it is before the sphere or behind it.
        float distance2 = dot(p, p), radius2 = volume.light.halfSize.x * volume.light.halfSize.x;
        frame.isInside = distance2 <= radius2 * 1.0001;
        frame.tangent = frame.isInside ? widest : sqrt(radius2 / (distance2 - radius2));
        float distance = sqrt(distance2);
        vec3 axis = frame.isInside ? receiver.normalLight : -p / distance;
        vec3 side = normalize(abs(axis.x) < 0.7 ? cross(vec3(1.0, 0.0, 0.0), axis) : cross(vec3(0.0, 1.0, 0.0), axis));
        vec3 up = cross(axis, side);
        float along = frame.isInside ? volume.light.halfSize.x : (distance2 - radius2) / distance;
        float radius = frame.tangent * along;
        u = side * radius;
        v = up * radius;
        center = axis * along;
        frame.x = side / radius;
        frame.y = up / radius;
        frame.z = axis / along;
    } else {
        if (p.z == 0.0 || (volume.light.isOneSided && p.z > 0.0)) return false;
        vec2 size = volume.light.halfSize;
        u = vec3(size.x, 0.0, 0.0);
        v = vec3(0.0, size.y, 0.0);
        center = -p;
        frame.handedness = p.z < 0.0 ? 1.0 : -1.0;
        frame.z = vec3(0.0, 0.0, -1.0 / p.z);
        frame.x = vec3(1.0 / size.x, 0.0, -p.x / (p.z * size.x));
        frame.y = vec3(0.0, 1.0 / size.y, -p.y / (p.z * size.y));
    }
    frame.rounding = 1e-5 * length(center);
    frame.horizon = vec3(dot(receiver.normalLight, u), dot(receiver.normalLight, v), dot(receiver.normalLight, center));
    return true;
}

bool isFlatLight() { return volume.light.shape == shapeRect || volume.light.shape == shapeDisk; }
bool isSquareLight() { return volume.light.shape == shapeRect; }

// How much higher than its centre the light's highest point is.
float horizonReach(LightFrame frame) {
    return isSquareLight() ? abs(frame.horizon.x) + abs(frame.horizon.y) : length(frame.horizon.xy);
}

// 1: all of the light is above the horizon; -1: none; 0: some.
int horizonSide(LightFrame frame) {
    float reach = horizonReach(frame);
    return frame.horizon.z >= reach ? 1 : frame.horizon.z + reach <= frame.rounding ? -1 : 0;
}

bool isAboveHorizon(LightFrame frame, vec2 s) { return dot(frame.horizon, vec3(s, 1.0)) > 0.0; }

// The area of the unit square (or disk) in the angle from direction `a` to `b`, the smaller of the two, as a share of
// the whole: the first lookup of the thesis (figures 12 a and 14 a), in closed form. Within each of the square's four
// sides the area grows with the tangent.
float squareAreaTo(vec2 d) {
    vec2 size = abs(d);
    if (size.x >= size.y) return (d.x > 0.0 ? 0.0 : 2.0) + 0.5 * d.y / d.x;
    return (d.y > 0.0 ? 1.0 : 3.0) - 0.5 * d.x / d.y;
}

float sectorShare(vec2 a, vec2 b, float turn) {
    if (!isSquareLight()) return abs(atan(turn, dot(a, b))) / lightTau;
    float area = abs(squareAreaTo(b) - squareAreaTo(a));
    return 0.25 * min(area, 4.0 - area);
}

// The share of the light that lies beyond the segment from `a` to `b`, which is within the square around the light, as seen
// from the light's centre: the angle's area less the triangle's (figures 12 c and 14 c).
float shareBeyond(vec2 a, vec2 b) {
    vec2 from = a, to = b;
    if (!isSquareLight()) {
        // The part in the disk.
        vec2 along = b - a;
        float square = dot(along, along);
        if (square == 0.0) return 0.0;
        float nearest = -dot(a, along) / square;
        vec2 foot = a + nearest * along;
        float half2 = (1.0 - dot(foot, foot)) / square;
        if (half2 <= 0.0) return 0.0;
        float begin = max(0.0, nearest - sqrt(half2)), end = min(1.0, nearest + sqrt(half2));
        if (begin >= end) return 0.0;
        from = a + begin * along;
        to = a + end * along;
    }
    float turn = from.x * to.y - from.y * to.x;
    float triangle = 0.5 * abs(turn) / (isSquareLight() ? 4.0 : 0.5 * lightTau);
    return max(sectorShare(from, to, turn) - triangle, 0.0);
}

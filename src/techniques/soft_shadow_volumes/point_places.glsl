// SPDX-License-Identifier: Apache-2.0
// Where the light's points are for a receiver. Requires light_area.glsl and light_points.glsl.
//
// SAMPLES: the number of points of the light at which layers are counted.
#ifndef SAMPLES
#define SAMPLES 64
#endif

// A sphere shows its directions, not the area of its disk. Above this tangent (of some 9 degrees) the two differ by more
// than a hundredth, and samples are placed by solid angle.
const float wideLight = 0.15;

// What the points are spread over: all of the light; or, where most of it is below the receiver's horizon and few of its
// points would be left, the box around the rest.
bool isSliver = false;
vec2 boxMiddle = vec2(0.0);
mat2 boxFromPoints = mat2(1.0);

void spreadPoints(LightFrame frame) {
    vec2 up = frame.horizon.xy, slope = abs(up);
    float reach = horizonReach(frame);
    // Of a textured light no more than must be: there points stand for what is around them.
    isSliver = horizonSide(frame) == 0 && frame.horizon.z < (volume.light.isTextured ? -0.6 * reach : 0.0);
    if (!isSliver) return;
    if (isSquareLight()) {
        // How far down from the highest corner each of its sides is above the horizon.
        vec2 low = max((-frame.horizon.z - slope.yx) / max(slope, 1e-30), -1.0);
        vec2 corner = vec2(up.x < 0.0 ? -1.0 : 1.0, up.y < 0.0 ? -1.0 : 1.0);
        boxMiddle = corner * 0.5 * (1.0 + low);
        boxFromPoints = mat2(0.5 * (1.0 - low.x), 0.0, 0.0, 0.5 * (1.0 - low.y));
    } else {
        // From the horizon to the disk's highest point, and as wide as the chord.
        float low = -frame.horizon.z / reach;
        vec2 axis = up / reach;
        boxMiddle = axis * 0.5 * (1.0 + low);
        boxFromPoints = mat2(axis * 0.5 * (1.0 - low), vec2(-axis.y, axis.x) * sqrt(max(1.0 - low * low, 0.0)));
    }
}

vec2 samplePlace(LightFrame frame, int i) {
    vec4 s = samples[i];
    // What a disk's points have been made from fills a square.
    if (isSliver) return boxMiddle + boxFromPoints * (isSquareLight() ? s.xy : 2.0 * s.zw - 1.0);
    if (frame.tangent <= wideLight) return s.xy;
    // Uniform in solid angle: the cosine falls linearly with the share of the cone.
    float tangent2 = frame.tangent * frame.tangent;
    float cosine = 1.0 - s.z * (1.0 - inversesqrt(1.0 + tangent2));
    return s.xy * sqrt((1.0 / (cosine * cosine) - 1.0) / (s.z * tangent2));
}

// Whether a point is on the light and above the horizon.
bool isInView(LightFrame frame, vec2 s) {
    bool isOnLight = !isSliver || isSquareLight() || dot(s, s) <= 1.0;
    return isOnLight && isAboveHorizon(frame, s);
}

// Points of a sliver are spread over an area, where those of a wide light stand for solid angles.
float sampleWeight(LightFrame frame, vec2 s) {
    if (!isSliver || frame.tangent <= wideLight) return 1.0;
    float longer2 = 1.0 + frame.tangent * frame.tangent * dot(s, s);
    return inversesqrt(longer2) / longer2;
}

// SPDX-License-Identifier: Apache-2.0
// Which triangle a receiver lies on. The position that comes out of a depth buffer may lie further below it than the
// lift of rays (`apexOf`) makes good, so such a triangle is told by its plane, and hides nothing.
//
// How far below? The depth of a triangle is interpolated with the rounding of the greatest nearness on it, where it
// comes closest to the eye: 2^-24 of that, times a few. Far behind that point a small step of nearness is a long way,
// which grows with the square of the distance. And corners that are far away are rounded more than a receiver is.

const float rounding = 5.9604645e-8;  // 2^-24, of a float of size 1
// The least with which no random ground of tests/ground_test.cpp and tests/host_depth_test.cpp shadows itself. With more,
// contacts lose their shadows in depths that are not reversed (HostDepth.ThatIsNotReversedMakesNoSpeckles).
const float depthRoundings = 8.0;
const float cornerRoundings = 8.0;

struct Footing {
    float share;             // clip-space w of the receiver
    float inverseNearness;
    float heightPerNearness;  // how far across its surface a receiver moves where its nearness grows by a share of itself
};

Footing footingOf(ivec2 pixel, Receiver receiver) {
    const float step_ = 1.0 / 256.0;
    float depth = depthAt(pixel);
    float nearness = depth * view.nearnessScale + view.nearnessOffset;
    vec3 moved = positionLight(pixel, depth + step_ * nearness * view.nearnessScale) - positionLight(pixel, depth);
    return Footing(dot(frame.sight, receiver.posLight) + frame.sightOffset, 1.0 / nearness,
                   abs(dot(receiver.normalLight, moved)) / step_);
}

// Whether a receiver with this normal lies on a triangle, whose corners begin at where its rays start.
bool isUnderfoot(Footing footing, vec3 normal, vec3 apex, vec3 a, vec3 b, vec3 c) {
    vec3 across = cross(b - a, c - a);
    float along = dot(across, normal);
    bool isAcross = along * along > 0.98 * dot(across, across);  // up to 8 degrees

    // Nearness at the triangle's nearest point over that at the receiver. Depths of orthographic views, and those that
    // are not reversed, have the rounding of a nearness of 1 everywhere.
    vec3 shares = vec3(dot(frame.sight, a), dot(frame.sight, b), dot(frame.sight, c)) +
                  dot(frame.sight, apex) + frame.sightOffset;
    float nearest = max(min(shares.x, min(shares.y, shares.z)), 1e-30);
    bool isEven = frame.sight == vec3(0.0) || view.nearnessScale < 0.0;
    float ratio = isEven ? footing.inverseNearness : clamp(footing.share / nearest, 1.0, footing.inverseNearness);

    vec3 size = max(abs(a), max(abs(b), abs(c)));
    float error = rounding * (depthRoundings * ratio * footing.heightPerNearness +
                              cornerRoundings * max(size.x, max(size.y, size.z)));
    return isAcross && dot(across, a) * sign(along) <= error * abs(along);
}

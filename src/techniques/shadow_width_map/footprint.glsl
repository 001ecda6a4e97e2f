// SPDX-License-Identifier: Apache-2.0
// How much of a light is seen past a straight edge.
//
// Let a light camera at the light's centre look along z. A point l of the light sees the receiver r = z_r (t_r, 1) past
// a blocker's edge at depth z_b through the place x where the segment from l to r crosses z = z_b. To the first order
// in l, x / z_b = t_r + (1 / z_b - 1 / z_r) (l.xy - t_r l.z). So in the map's tangents, an edge at a distance d from t_r
// cuts the light's footprint { l.xy - t_r l.z } at d / (1 / z_b - 1 / z_r): the footprint is the light as the receiver
// sees it, sheared into the map's plane. For distant lights the same holds with metres, sd tan(angle / 2).

// The footprint's axes in the camera's plane; of a sphere, the slope of the ray that lengthens it.
struct Footprint {
    vec2 axisX, axisY;
};

Footprint footprintOf(Receiving r) {
    vec2 slope = constants.light.shape == shapeDistant ? vec2(0.0) : r.posFace.xy / r.posFace.z;
    if (constants.light.shape >= shapeSphere) return Footprint(slope, vec2(0.0));
    vec3 x = turnedToFace(r.camera, constants.halfAxisX), y = turnedToFace(r.camera, constants.halfAxisY);
    return Footprint(x.xy - slope * x.z, y.xy - slope * y.z);
}

// Half extents along the unit vector `across`, for each of the light's axes; round lights have one.
vec2 halfExtents(Footprint footprint, vec2 across) {
    vec2 extents = abs(vec2(dot(across, footprint.axisX), dot(across, footprint.axisY)));
    if (constants.light.shape == shapeRect) return extents;
    if (constants.light.shape == shapeDisk) return vec2(length(extents), 0.0);
    return vec2(constants.radius * sqrt(1.0 + extents.x * extents.x), 0.0);
}

// Share of the footprint at places below `edge`.
float shareBelow(vec2 extents, float edge) {
    if (constants.light.shape != shapeRect) {
        float d = clamp(edge / extents.x, -1.0, 1.0);
        return 0.5 + (asin(d) + d * sqrt(1.0 - d * d)) / 3.14159265;
    }
    // A sheared rectangle has the density of a trapezoid: a box of the wide half extent, blurred by the narrow one.
    float wide = max(extents.x, extents.y), narrow = min(extents.x, extents.y);
    float e = abs(edge);
    float ramp = e / (2.0 * wide);
    float beyond = e - (wide - narrow);
    if (beyond > 0.0) ramp -= beyond * beyond / (8.0 * wide * narrow);
    ramp = e >= wide + narrow ? 0.5 : min(ramp, 0.5);
    return 0.5 + sign(edge) * ramp;
}

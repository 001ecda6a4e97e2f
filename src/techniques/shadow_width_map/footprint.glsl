// SPDX-License-Identifier: Apache-2.0
// How much of a light is seen past a straight edge.
//
// Let a light camera at the light's centre look along z. A point l of the light sees the receiver r = z_r (t_r, 1) past
// a blocker's edge at depth z_b through the place x where the segment from l to r crosses z = z_b. To the first order
// in l, x / z_b = t_r + (1 / z_b - 1 / z_r) (l.xy - t_r l.z). So in the map's tangents, an edge at a distance d from t_r
// cuts the light's footprint { l.xy - t_r l.z } at d / (1 / z_b - 1 / z_r): the footprint is the light as the receiver
// sees it, sheared into the map's plane. For distant lights the same holds with metres, sd tan(angle / 2).

// Half extents of the footprint along the unit vector `across`, for each of the light's axes; round lights have one.
vec2 footprintHalfExtents(int camera, MapPoint point, vec2 across) {
    vec3 covector = vec3(across, lightCameras[camera].depth.z == 1.0 ? 0.0 : -dot(across, point.posFace.xy) / point.posFace.z);
    if (constants.light.x == distantLight) return vec2(constants.halfAxisX.w, 0.0);
    if (constants.light.x == sphereLight) return vec2(constants.halfAxisX.w * length(covector), 0.0);
    vec3 covectorLight = covector * mat3(lightCameras[camera].faceFromLight);
    vec2 extents = abs(vec2(dot(covectorLight, constants.halfAxisX.xyz), dot(covectorLight, constants.halfAxisY.xyz)));
    return constants.light.x == diskLight ? vec2(length(extents), 0.0) : extents;
}

// Share of the footprint at places below `edge`.
float shareBelow(vec2 halfExtents, float edge) {
    if (constants.light.x != rectLight) {
        float d = clamp(edge / halfExtents.x, -1.0, 1.0);
        return 0.5 + (asin(d) + d * sqrt(1.0 - d * d)) / 3.14159265;
    }
    // A sheared rectangle has the density of a trapezoid: a box of the wide half extent, blurred by the narrow one.
    float wide = max(halfExtents.x, halfExtents.y), narrow = min(halfExtents.x, halfExtents.y);
    float e = abs(edge);
    float ramp = e / (2.0 * wide);
    float beyond = e - (wide - narrow);
    if (beyond > 0.0) ramp -= beyond * beyond / (8.0 * wide * narrow);
    ramp = e >= wide + narrow ? 0.5 : min(ramp, 0.5);
    return 0.5 + sign(edge) * ramp;
}

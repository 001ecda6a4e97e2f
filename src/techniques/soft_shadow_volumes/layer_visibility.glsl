// SPDX-License-Identifier: Apache-2.0
// The share of the light that no layer hides. Requires layer_counts.glsl.

const float texturedLimit = 6.0;  // points of mean radiance that the brightest two may weigh

vec3 visibilityOf(LightFrame frame, int atCenter) {
    vec3 seen = vec3(0.0), all = vec3(0.0), layers = vec3(0.0);
    int points = 0, covered = 0, layerSum = 0, least = 1 << 20, most = 0;
    bool isTextured = volume.light.isTextured && !isSliver;
    bool isCut = horizonSide(frame) == 0;
    if (edgesCounted == 0) return vec3(atCenter <= 0 ? 1.0 : 0.0);
    for (int i = 0; i < SAMPLES; ++i) {
        vec2 s = samplePlace(frame, i);
        if (isCut && !isInView(frame, s)) continue;
        vec3 radiance = isTextured ? radiances[i].rgb : vec3(sampleWeight(frame, s));
        int count = max(changes[i] + atCenter, 0);
        all += radiance;
        ++points;
        if (count == 0) {
            seen += radiance;
        } else {
            ++covered;
            layers += float(count) * radiance;
            layerSum += count;
            least = min(least, count);
            most = max(most, count);
        }
    }
    if (points == 0) return vec3(0.0);
    vec3 share = vec3(1.0 - float(covered) / float(points));  // where a channel is black all over
    vec3 sampled = mix(share, seen / max(all, 1e-30), greaterThan(all, vec3(0.0)));
    if (isCut || frame.tangent > wideLight) return sampled;

    // The exact mean number of layers tells how far the samples' own mean is off; where every blocker is as many layers
    // deep, their share follows exactly.
    vec3 mean = vec3(meanChangeFixed) / fixedOne + float(atCenter);
    if (covered == 0) return clamp(1.0 - mean / float(leastChange), 1.0 - 1.0 / float(SAMPLES), 1.0);
    if (least == most) return clamp(1.0 - mean / float(least), 0.0, 1.0);
    // Else by how many layers the points that are hidden have on average, and no farther from what they say themselves than
    // two of them, or the brightest two, may be off.
    vec3 depth = mix(vec3(float(layerSum) / float(covered)), layers / max(all - seen, 1e-30), greaterThan(all, seen));
    float limit = covered == SAMPLES ? 0.0 : (isTextured ? texturedLimit : 2.0) / float(SAMPLES);
    return clamp(clamp(1.0 - mean / depth, sampled - limit, sampled + limit), 0.0, 1.0);
}

// SPDX-License-Identifier: Apache-2.0
// The share of the light that no layer hides. Requires layer_counts.glsl.

vec3 visibilityOf(LightFrame frame, int atCenter) {
    vec3 seen = vec3(0.0), all = vec3(0.0);
    int points = 0, covered = 0, layerSum = 0, least = 1 << 20, most = 0;
    bool isTextured = volume.lightKind.w == 1 && !isSliver;
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
            layerSum += count;
            least = min(least, count);
            most = max(most, count);
        }
    }
    if (points == 0) return vec3(0.0);
    vec3 share = vec3(1.0 - float(covered) / float(points));  // where a channel is black all over
    vec3 sampled = mix(share, seen / max(all, 1e-30), greaterThan(all, vec3(0.0)));
    if (isTextured || isCut || frame.tangent > wideLight) return sampled;

    // The exact mean number of layers tells how far the samples' own mean is off; where every blocker is as many layers
    // deep, their share follows exactly.
    float mean = float(meanChangeFixed) / fixedOne + float(atCenter);
    if (covered == 0) return vec3(clamp(1.0 - mean / float(leastChange), 1.0 - 1.0 / float(SAMPLES), 1.0));
    float depth = float(layerSum) / float(covered);
    float corrected = 1.0 - mean / depth;
    if (least < most) {
        float limit = covered == SAMPLES ? 0.0 : 2.0 / float(SAMPLES);
        corrected = clamp(corrected, sampled.r - limit, sampled.r + limit);
    }
    return vec3(clamp(corrected, 0.0, 1.0));
}

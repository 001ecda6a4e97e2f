// SPDX-License-Identifier: Apache-2.0
// The share of the light that no layer hides. Requires layer_counts.glsl and radiance_beyond.glsl.

const float limitInPoints = 2.0;  // as far as the exact mean may move what the points say
const float texturedLimit = 6.0;  // the same for points of mean radiance, of which the brightest two may weigh so much

struct PointCount {
    int layers;      // at the point, less those before the light's centre
    float mean;      // over its area, less `layers`
    float isBehind;  // the share of its area that edges say is behind something that the point is not behind; negative:
                     // that is not behind something that it is
};

PointCount pointCount(int i) {
    PointCount count;
    count.layers = bitfieldExtract(changes[i], 0, countBits);
    int rest = (changes[i] - count.layers) >> countBits, mean = bitfieldExtract(rest, 0, offsetBits);
    count.mean = float(mean) / offsetOne;
    count.isBehind = float((rest - mean) >> offsetBits) / offsetOne;
    return count;
}

// Of what a point stands for.
float hiddenShare(PointCount point, int count) {
    if (count == 0) return clamp(min(point.isBehind, point.mean), 0.0, 1.0);
    // What is not behind the edges near it, is it behind something else?
    bool isBehindMore = point.isBehind >= 0.0 || float(count) - point.mean / point.isBehind > 0.5;
    return isBehindMore ? 1.0 : clamp(1.0 + point.isBehind, 0.0, 1.0);
}

vec3 visibilityOf(LightFrame frame, int atCenter) {
    if (edgesCounted == 0) return vec3(atCenter <= 0 ? 1.0 : 0.0);
    bool isTextured = volume.light.isTextured, isCut = horizonSide(frame) == 0;
    bool hasMean = !isCut && frame.tangent <= wideLight;
    int points = 0, covered = 0, layerSum = 0, least = 1 << 20, most = 0;
    for (int i = 0; i < SAMPLES; ++i) {
        if (isCut && !isInView(frame, samplePlace(frame, i))) continue;
        int count = max(bitfieldExtract(changes[i], 0, countBits) + atCenter, 0);
        ++points;
        covered += min(count, 1);
        layerSum += count;
        least = count == 0 ? least : min(least, count);
        most = max(most, count);
    }
    if (points == 0) return vec3(0.0);
    // The exact mean number of layers tells how far the points' own mean is off; where every blocker is as many layers
    // deep, their share follows exactly.
    vec3 mean = vec3(meanChangeFixed) / fixedOne + float(atCenter);
    if (hasMean && covered == 0) return clamp(1.0 - mean / float(leastChange), 1.0 - 1.0 / float(SAMPLES), 1.0);
    if (hasMean && least == most) return clamp(1.0 - mean / float(least), 0.0, 1.0);
    if (covered == points) return vec3(0.0);

    // hidden: of what the points stand for; covered: of the points themselves.
    vec3 hidden = vec3(0.0), all = vec3(0.0), layers = vec3(0.0), coveredLayers = vec3(0.0), coveredRadiance = vec3(0.0);
    float pointsHidden = 0.0;
    for (int i = 0; i < SAMPLES; ++i) {
        vec2 s = samplePlace(frame, i);
        if (isCut && !isInView(frame, s)) continue;
        vec3 radiance = vec3(sampleWeight(frame, s));
        if (isTextured) radiance = isSliver ? radianceAt(s) : radiances[i].rgb;
        PointCount point = pointCount(i);
        int count = max(point.layers + atCenter, 0);
        float share = isCut ? float(min(count, 1)) : hiddenShare(point, count);
        all += radiance;
        layers += max(float(count) + point.mean, 0.0) * radiance;
        hidden += share * radiance;
        pointsHidden += share;
        coveredLayers += float(count) * radiance;
        coveredRadiance += float(min(count, 1)) * radiance;
    }
    bvec3 isLit = greaterThan(all, vec3(0.0));  // else the channel is black all over
    vec3 told = 1.0 - mix(vec3(pointsHidden / float(points)), hidden / max(all, 1e-30), isLit);
    if (!hasMean) return told;
    // By how many layers the points that are hidden have on average, and no farther than a few of them may be off.
    vec3 depth = mix(vec3(float(layerSum) / float(covered)), coveredLayers / max(coveredRadiance, 1e-30),
                     greaterThan(coveredRadiance, vec3(0.0)));
    float limit = (isTextured ? texturedLimit : limitInPoints) / float(SAMPLES);
    vec3 off = (mean - layers / max(all, 1e-30)) / depth;
    return clamp(told - mix(vec3(0.0), clamp(off, -limit, limit), isLit), 0.0, 1.0);
}

// SPDX-License-Identifier: Apache-2.0
// Candela of a profile by direction, as CandelaGrid::at has them: linear between the file's own angles. Includers have
// declared the buffer `Profile` of floats, `profileValues`, and say `profileType` and whether it `hasEvenAngles`.

const int mostSteps = 12;  // to find an angle among 2^12

// The angles [first, first + count) of the buffer increase; the index of the last that is not above `angle`, but for
// the very last.
int lastNotAbove(int first, int count, float angle) {
    if (hasEvenAngles) {
        float least = profileValues[first], most = profileValues[first + count - 1];
        int at = clamp(int((angle - least) / (most - least) * float(count - 1)), 0, count - 2);
        // But for rounding.
        if (at > 0 && angle < profileValues[first + at]) return at - 1;
        return at + (at < count - 2 && angle >= profileValues[first + at + 1] ? 1 : 0);
    }
    int low = 0, high = count - 1;
    for (int step = 0; step < mostSteps && high - low > 1; ++step) {
        int middle = (low + high) / 2;
        if (profileValues[first + middle] <= angle) low = middle;
        else high = middle;
    }
    return low;
}

// x: index of the first of two angles, y: the share of the second; x is -1 outside.
vec2 between(int first, int count, float angle) {
    const float rounding_rad = 2e-6;
    float least = profileValues[first], most = profileValues[first + count - 1];
    if (angle < least - rounding_rad || angle > most + rounding_rad) return vec2(-1.0, 0.0);
    if (count == 1) return vec2(0.0);
    int at = lastNotAbove(first, count, angle);
    float below = profileValues[first + at], above = profileValues[first + at + 1];
    return vec2(float(at), clamp((angle - below) / (above - below), 0.0, 1.0));
}

// A C angle turned to the first plane and mirrored into what the planes cover.
float foldedPlane(ProfileConstants profile, float c) {
    float span = profileValues[profile.verticals + profile.horizontals - 1];
    if (profile.horizontals == 1) return 0.0;
    float beyond = mod(c - profile.firstPlane_rad, 2.0 * pi);
    const float nearly = 0.1;  // spans are quarters, halves and whole turns
    if (span < 2.0 * pi - nearly && beyond > pi) beyond = 2.0 * pi - beyond;
    if (span < pi - nearly && beyond > 0.5 * pi) beyond = pi - beyond;
    return min(beyond, span);
}

// For a direction of length 1 away from the light.
float profileCandela(ProfileConstants profile, vec3 directionLight) {
    vec3 towardsC90 = cross(profile.towardsZenith, profile.towardsC0);
    vec3 direction = vec3(dot(directionLight, profile.towardsC0), dot(directionLight, towardsC90),
                          dot(directionLight, profile.towardsZenith));
    float gamma = atan(length(direction.xy), -direction.z);
    float c = direction.xy == vec2(0.0) ? 0.0 : atan(direction.y, direction.x);
    if (profile.angleScale > 0.0) gamma /= profile.angleScale;
    if (profile.angleScale < 0.0) gamma = pi - (pi - gamma) / -profile.angleScale;
    if (gamma < 0.0 || gamma > pi) return 0.0;

    float vertical = gamma, horizontal;
    if (profileType == profileTypeC) {
        horizontal = foldedPlane(profile, c);
    } else {
        vec3 d = vec3(sin(gamma) * vec2(cos(c), sin(c)), -cos(gamma));
        vertical = profileType == profileTypeB ? atan(d.x, -d.z) : asin(clamp(d.z, -1.0, 1.0));
        horizontal = profileType == profileTypeB ? asin(clamp(-d.y, -1.0, 1.0)) : atan(-d.y, d.x);
        if (profile.isMirrored) horizontal = abs(horizontal);
    }
    vec2 v = between(0, profile.verticals, vertical);
    vec2 h = between(profile.verticals, profile.horizontals, horizontal);
    if (v.x < 0.0 || h.x < 0.0) return 0.0;
    int first = profile.verticals + profile.horizontals + int(h.x) * profile.verticals + int(v.x);
    int nextPlane = profile.horizontals > 1 ? profile.verticals : 0;
    vec2 below = vec2(profileValues[first], profileValues[first + 1]);
    vec2 above = vec2(profileValues[first + nextPlane], profileValues[first + nextPlane + 1]);
    vec2 values = mix(below, above, h.y);
    return profile.factor * mix(values.x, values.y, v.y);
}

// How many points to take along an extent that is so far away: so dense that summing at their middles is within a few
// thousandths of the integral, also close by.
int pointsAlong(float extent_m, float distance_m, float pointsPerDistance) {
    const float fewest = 2.0, mostUnlessSteep = 24.0;
    // Mesa ends all of a shader's loops after 65,535 turns, of which each of most^2 points takes 1 + 2 mostSteps.
    const float mostOfAll = 48.0;
    float most = min(mostUnlessSteep * pointsPerDistance / leastPointsPerDistance, mostOfAll);
    return int(clamp(ceil(pointsPerDistance * extent_m / max(distance_m, 1e-6)), fewest, most));
}

// The same of a profile, also where its candela fall off steeply.
int pointsAlong(ProfileConstants profile, float extent_m, float distance_m) {
    return pointsAlong(extent_m, distance_m, profile.pointsPerDistance);
}

// What one point of a light sends to the receiver: of a luminaire, candela by cos / d^2; else the same times the cosine
// at the light, which is what luminance is of.
float fromPoint(ProfileConstants profile, vec3 pos, vec3 normal, vec3 point, bool hasCosine) {
    vec3 towards = point - pos;
    float distance2 = dot(towards, towards);
    if (distance2 <= 0.0) return 0.0;
    vec3 direction = towards * inversesqrt(distance2);
    float cosine = dot(normal, direction);
    if (cosine <= 0.0) return 0.0;
    return profileCandela(profile, -direction) * cosine / distance2 * (hasCosine ? abs(direction.z) : 1.0);
}

// Means over the light of fromPoint; irradiance for an emission of 1.
float profiledRect(ProfileConstants profile, vec3 pos, vec3 normal, vec2 halfSize_m) {
    float distance_m = length(vec3(max(abs(pos.xy) - halfSize_m, 0.0), pos.z));
    ivec2 points = ivec2(pointsAlong(profile, 2.0 * halfSize_m.x, distance_m),
                         pointsAlong(profile, 2.0 * halfSize_m.y, distance_m));
    float sum = 0.0;
    for (int y = 0; y < points.y; ++y) {
        for (int x = 0; x < points.x; ++x) {
            vec2 place = (2.0 * (vec2(x, y) + 0.5) / vec2(points) - 1.0) * halfSize_m;
            sum += fromPoint(profile, pos, normal, vec3(place, 0.0), !profile.isLuminaire);
        }
    }
    float area_m2 = profile.isLuminaire ? 1.0 : 4.0 * halfSize_m.x * halfSize_m.y;
    return sum / float(points.x * points.y) * area_m2;
}

// Over rings of equal area of a disk of any orientation around the origin.
float profiledDisk(ProfileConstants profile, vec3 pos, vec3 normal, float radius_m, float distance_m, vec3 x, vec3 y,
                   bool hasCosine) {
    int points = pointsAlong(profile, 2.0 * radius_m, distance_m);
    int rings = (points + 1) / 2, sectors = 2 * points;
    float sum = 0.0;
    for (int ring = 0; ring < rings; ++ring) {
        float radius = radius_m * sqrt((float(ring) + 0.5) / float(rings));
        for (int sector = 0; sector < sectors; ++sector) {
            float angle = 2.0 * pi * (float(sector) + 0.5) / float(sectors);
            vec3 point = radius * (cos(angle) * x + sin(angle) * y);
            sum += fromPoint(profile, pos, normal, point, hasCosine);
        }
    }
    return sum / float(rings * sectors);
}

// Over what a tube shows. Candela by its share of what is seen from afar: points evenly across its width. Luminance in the plane
// of its outline, by what each line there meets.
float profiledTube(ProfileConstants profile, vec3 pos, vec3 normal, float halfLength_m, float radius_m) {
    SeenTube seen = seeTube(pos, radius_m);
    if (seen.away <= radius_m) return 0.0;
    float distance_m = length(vec2(max(abs(pos.x) - halfLength_m, 0.0), seen.away - radius_m));
    ivec2 points = ivec2(pointsAlong(profile, 2.0 * halfLength_m, distance_m),
                         pointsAlong(profile, 2.0 * radius_m, distance_m));
    float along2 = seen.away * seen.plane, beyond = (seen.away - radius_m) * (seen.away + radius_m);
    float sum = 0.0;
    for (int y = 0; y < points.y; ++y) {
        float aside = (2.0 * (float(y) + 0.5) / float(points.y) - 1.0) * seen.halfWidth;
        vec3 line = aside * seen.aside - sqrt(max(radius_m * radius_m - aside * aside, 0.0)) * seen.ahead;
        float share = 1.0;  // of the way to a place of the outline, where it meets the tube
        if (!profile.isLuminaire) {
            float length2 = seen.plane * seen.plane + aside * aside;
            share = beyond / (along2 + sqrt(max(along2 * along2 - length2 * beyond, 0.0)));
            line = vec3(0.0, pos.yz) + share * (seen.plane * seen.ahead + aside * seen.aside);
        }
        for (int x = 0; x < points.x; ++x) {
            float along = (2.0 * (float(x) + 0.5) / float(points.x) - 1.0) * halfLength_m;
            vec3 point = line + vec3(along, 0.0, 0.0);
            float part = fromPoint(profile, pos, normal, point, false);
            sum += profile.isLuminaire ? part : part * seen.plane * share * share / distance(point, pos);
        }
    }
    float mean = sum / float(points.x * points.y);
    return profile.isLuminaire ? mean : mean * 4.0 * halfLength_m * seen.halfWidth;
}

float profiledIrradiance(ProfileConstants profile, int shape, bool isPoint, vec2 halfSize_m, float radius_m, vec3 pos,
                         vec3 normal) {
    if (isPoint) return fromPoint(profile, pos, normal, vec3(0.0), false);
    if (shape == shapeRect) return profiledRect(profile, pos, normal, halfSize_m);
    if (shape == shapeDisk) {
        float distance_m = length(vec2(max(length(pos.xy) - radius_m, 0.0), pos.z));
        float mean = profiledDisk(profile, pos, normal, radius_m, distance_m, vec3(1.0, 0.0, 0.0),
                                  vec3(0.0, 1.0, 0.0), !profile.isLuminaire);
        return profile.isLuminaire ? mean : pi * radius_m * radius_m * mean;
    }
    if (shape == shapeCylinder) return profiledTube(profile, pos, normal, halfSize_m.x, radius_m);
    // A sphere shows a disk from any side. Its luminance times the disk's area is candela, as a luminaire's.
    float distance = length(pos);
    if (distance <= radius_m) return 0.0;
    vec3 axis = pos / distance;
    vec3 x = normalize(cross(axis, abs(axis.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    float mean = profiledDisk(profile, pos, normal, radius_m, distance - radius_m, x, cross(axis, x), false);
    return profile.isLuminaire ? mean : pi * radius_m * radius_m * mean;
}

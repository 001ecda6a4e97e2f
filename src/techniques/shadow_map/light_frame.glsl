// SPDX-License-Identifier: Apache-2.0
// The light as a receiver sees it, and what a map says about the space between the two.
//
// Everything happens in the plane through the receiver p that is parallel to the light (a sphere: to the disk that it
// shows). A blocker b at the distance h from the light, where the receiver's is H, hides the light's point l if
//     b = p + (l - p) (1 - h/H),   so that   b H/h = p + k l   with   k = H/h - 1.
// Seen from the light's centre, where the map was made, b thus appears beside p by k l: exactly, at any tilt. For a
// distant light l is a tangent, k the distance from blocker to receiver along the light's axis, and b = p + k (l, -1).

struct LightFrame {
    vec3 pos;          // the receiver; the light's centre is the origin (distant: any)
    vec3 normal;       // the receiver's
    vec3 away;         // unit length: from the light to the receiver, across the light's plane
    vec3 axisX, axisY; // of the light, from its centre to its border
    float distance_m;  // H
};

LightFrame rotated(LightFrame frame, mat3 rotation) {
    return LightFrame(rotation * frame.pos, rotation * frame.normal, rotation * frame.away, rotation * frame.axisX,
                      rotation * frame.axisY, frame.distance_m);
}

// The frame as a camera sees it.
LightFrame faceFrame(int camera, LightFrame frame) {
    mat4 faceFromLight = lightCameras[camera].faceFromLight;
    LightFrame face = rotated(frame, mat3(faceFromLight));
    face.pos = (faceFromLight * vec4(frame.pos, 1.0)).xyz;
    return face;
}

// Where the receiver's plane sees the light's point `place` (in axes), not of unit length.
vec3 towardsLight(LightFrame frame, vec2 place, bool isDistant) {
    return place.x * frame.axisX + place.y * frame.axisY - (isDistant ? frame.away : frame.pos);
}

// Tolerances as in map_depth.glsl. A filter looks beside the receiver as well, where an error in the normal's direction
// becomes one of height.
const float toleranceNormal = 5e-4;

struct Tap {
    bool isBlocked;
    float k;  // of what blocks
};

// Looks in the direction of p + offset, `offset` being k times a place on the light, in axes. False if the camera does
// not see that far.
bool tapCamera(int camera, LightFrame face, vec2 offset, out Tap tap) {
    tap = Tap(false, 0.0);
    LightCameraConstants c = lightCameras[camera];
    bool orthographic = c.depth.isOrthographic;
    vec3 beside = offset.x * face.axisX + offset.y * face.axisY;
    vec3 aim = face.pos + beside;
    if (!orthographic && aim.z <= 0.0) return false;
    vec2 uv = ((orthographic ? aim.xy : aim.xy / aim.z) - c.window.min) * c.window.perExtent;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThanEqual(uv, vec2(1.0)))) return false;
    int size_px = textureSize(depthMaps, 0).x;
    ivec2 texel = ivec2(uv * float(size_px));
    float stored = texelFetch(depthMaps, ivec3(texel, camera), 0).r;
    if (stored == 0.0) return true;

    // The blocker, on the ray through the texel's centre; its height over the receiver's own plane there, and its
    // distance from the light, both as linear functions of its depth.
    float depth_m = depthFace_m(camera, stored);
    vec2 center = (vec2(texel) + 0.5) / float(size_px) / c.window.perExtent + c.window.min;
    vec3 ray = orthographic ? vec3(0.0, 0.0, 1.0) : vec3(center, 1.0);
    vec3 foot = orthographic ? vec3(center, 0.0) : vec3(0.0);
    float texel_m = c.depth.texelSize * (orthographic ? 1.0 : aim.z);
    float precision_m = tolerancePrecision * length(face.pos);
    float rise = dot(face.normal, ray);
    float height_m = rise * depth_m + dot(face.normal, foot - face.pos);
    float approach = dot(face.away, ray);
    float above_m = dot(face.away, face.pos - foot) - approach * depth_m;  // H - h
    float h_m = face.distance_m - above_m;
    tap.isBlocked = height_m > toleranceTexels * texel_m * abs(rise) + toleranceNormal * length(beside) + precision_m &&
                    above_m > toleranceTexels * texel_m * abs(approach) + precision_m && (orthographic || h_m > 0.0);
    tap.k = orthographic ? above_m : above_m / h_m;
    return true;
}

// The same for whichever camera sees that far; what none sees is taken for unblocked. `lightFrame` is the frame in
// light space, `face` that of `camera`.
Tap tapAny(int camera, int mapCount, LightFrame face, LightFrame lightFrame, vec2 offset) {
    Tap tap;
    if (tapCamera(camera, face, offset, tap)) return tap;
    for (int other = 0; other < mapCount; ++other) {
        if (other != camera && tapCamera(other, faceFrame(other, lightFrame), offset, tap)) return tap;
    }
    return Tap(false, 0.0);
}

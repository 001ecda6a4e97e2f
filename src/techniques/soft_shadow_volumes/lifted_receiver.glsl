// SPDX-License-Identifier: Apache-2.0
// Receivers as all passes of this room see them: lifted off their surface by some roundings, so that each is in front of
// its own face and behind those beyond its horizon, whichever way its depth was rounded. Lifted along the line of sight,
// they stay in their pixel: a depth buffer can hold them, and the count of layers at the light's centre, which is found
// by comparing depths, is that of the very point from which edges are seen. Nor by more where the surface is seen at a
// grazing angle, though its height is less there: receivers would slide over what lies around them on a fine mesh.

// Of the largest coordinate: some thirty roundings, as many as the ray-traced reference takes.
const float lift = 4e-6;

float liftedDepth(Receiver receiver) {
    vec3 p = receiver.posLight;
    vec3 toEye = volume.eyeLight.xyz - volume.eyeLight.w * p;
    float distance = length(toEye);
    toEye /= distance;
    float along = lift * (max(abs(p.x), max(abs(p.y), abs(p.z))) + volume.eyeLight.w * distance);
    if (volume.eyeLight.w != 0.0) along = min(along, 0.5 * distance);
    vec4 clip = volume.clipFromLight * vec4(p + along * toEye, 1.0);
    return clip.z / clip.w;
}

uniform sampler2D liftedDepths;

// False where the texel's pixel shows no receiver.
bool loadLiftedReceiver(ivec2 texel, out Receiver receiver) {
    ivec2 pixel = texel * volume.pixelsPerTexel;
    if (!loadReceiver(pixel, receiver)) return false;
    receiver.posLight = positionLight(vec2(pixel), texelFetch(liftedDepths, texel, 0).r);
    return true;
}

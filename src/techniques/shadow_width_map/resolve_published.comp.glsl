// SPDX-License-Identifier: Apache-2.0
#version 450
// Kirsch and Döllner 2003, sections 3 and 4: attenuation I(sd, sw) of shadow depth and shadow width, both filtered
// linearly as by the texture units of their time.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/shadow_width_map/receiver.glsl"

layout(std140) uniform Constants { AttenuationConstants attenuation; };
uniform sampler2DArray widths;
uniform sampler2D curve;

// Linear depth of a texel; where there is no caster, the shadow depth shall be 0.
float blockerDepth_m(int camera, vec3 receiverFace, float stored) {
    return stored == attenuation.background ? receiverFace.z : min(depthFace_m(camera, stored), receiverFace.z);
}

float seenBy(Receiver receiver) {
    if (!isFacing(receiver, false)) return 0.0;
    MapPoint point;
    int camera = deepestMap(receiver.posLight, point);
    if (camera < 0) return 1.0;
    float size_px = float(textureSize(depthMaps, 0).x);

    ivec2 corner = ivec2(floor(point.uv * size_px - 0.5));
    vec2 weight = point.uv * size_px - 0.5 - vec2(corner);
    float sd_m = 0.0, width = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec3 texel = ivec3(clamp(corner + offset, ivec2(0), ivec2(size_px - 1.0)), camera);
        vec2 w = mix(1.0 - weight, weight, vec2(offset));
        sd_m += w.x * w.y * (point.posFace.z - blockerDepth_m(camera, point.posFace, texelFetch(depthMaps, texel, 0).r));
        width += w.x * w.y * texelFetch(widths, texel, 0).r;
    }
    // The receiver's own surface is no blocker: less than a texel and rounding apart.
    vec3 normalFace = turnedToFace(camera, receiver.normalLight);
    float slope = length(normalFace.xy) / max(0.1, abs(normalFace.z));
    float tolerance_m = mapTolerance_m(point.texel_m * (1.0 + slope), point.posFace);
    if (sd_m <= tolerance_m) return 1.0;
    MapDepth depth = cameraOf(camera).depth;
    float texel_m = attenuation.plane_m == 0.0 || depth.isOrthographic ? point.texel_m : depth.texelSize * attenuation.plane_m;
    float sw_m = width * attenuation.unit_px * texel_m;
    float scale = attenuation.cScale;
    // The true umbra begins where the width is a share of the light's half extent: sw = a sd / z_b. Widths end at 1, which
    // is umbra too: where that is less than the light asks for, the penumbra is as narrow.
    if (attenuation.isPhysical) {
        bool distant = constants.light.shape == shapeDistant;
        float extent = attenuation.meanHalfExtent;
        if (extent == 0.0) return sw_m > 0.0 ? 0.0 : 1.0;
        scale = distant ? 1.0 / extent : max(point.posFace.z - sd_m, 0.0) / extent;
    }
    float ratio = scale * sw_m / sd_m;
    if (attenuation.isPhysical) ratio = max(ratio, width * (attenuation.umbraBegins + attenuation.cBias));
    // The bias moves the curve outwards, which for the published one is to add it: 1 + c_bias - c_scale sw / sd.
    float entries = float(textureSize(curve, 0).x);
    float entry = clamp((ratio - attenuation.cBias) / attenuation.curveEnd, 0.0, 1.0) * (entries - 1.0) + 0.5;
    return clamp(textureLod(curve, vec2(entry / entries, 0.5), 0.0).r, 0.0, 1.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    imageStore(visibility, pixel, vec4(loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0));
}

// SPDX-License-Identifier: Apache-2.0
// What both halves' fragments know.
#define DEPTH_MAP_UNIT 0
#define DEPTH_MAP_BLOCK 0
#define SMOOTHIE_BLOCK 1
#include "src/techniques/smoothies/smoothies.glsl"

// What receives without casting is not in the depth maps, but smoothies fall on it all the same.
layout(binding = 1) uniform sampler2DArray receiverMaps;
layout(location = 0) uniform bool hasReceiverMaps;

layout(location = 0) flat in vec4 edge;
layout(location = 1) flat in vec2 nearness;
layout(location = 2) flat in int camera;

struct Fragment {
    vec2 place;      // of this texel
    vec2 closest;    // the edge's point that is closest to it
    vec2 normal;     // from there to here, unit length; the edge's normal where that vanishes
    float distance_;  // between the two
    float blocker;   // the nearness of the edge there
};

Fragment fragment(vec2 outward) {
    Fragment f;
    f.place = placeOf(camera, gl_FragCoord.xy / vec2(textureSize(depthMaps, 0).xy));
    vec2 along = edge.zw - edge.xy;
    float s = clamp(dot(f.place - edge.xy, along) / dot(along, along), 0.0, 1.0);
    f.closest = edge.xy + s * along;
    f.blocker = mix(nearness.x, nearness.y, s);
    vec2 offset = f.place - f.closest;
    f.distance_ = length(offset);
    f.normal = f.distance_ > 1e-3 * lightCameras[camera].depth.w ? offset / f.distance_ : outward;
    return f;
}

// The nearness of the surface that the light sees in a texel past an edge at nearness `blocker`. False: another
// blocker hides the edge there.
bool findReceiver(ivec2 texel, float blocker, out float receiver) {
    texel = clamp(texel, ivec2(0), textureSize(depthMaps, 0).xy - 1);
    receiver = storedNearness(camera, texelFetch(depthMaps, ivec3(texel, camera), 0).r);
    if (receiver >= blocker) return false;
    if (hasReceiverMaps) {
        float other = storedNearness(camera, texelFetch(receiverMaps, ivec3(texel, camera), 0).r);
        if (other < blocker) receiver = max(receiver, other);
    }
    return true;
}

// SPDX-License-Identifier: Apache-2.0
#version 450
// What one edge covers of the light, added to one of the V-buffer's two layers (thesis, sections 4.2.3 and 4.2.7).
#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"
#include "src/techniques/soft_shadow_volumes/light_area.glsl"

layout(location = 0) flat in vec3 aLight;
layout(location = 1) flat in vec3 bLight;
layout(location = 2) flat in float weight;
layout(location = 0) out vec2 layers;  // x: additive, y: subtractive
layout(location = 1) out float evaluations;

void main() {
    layers = vec2(0.0);
    evaluations = 1.0;
    Receiver receiver;
    LightFrame frame;
    if (!loadLiftedReceiver(ivec2(gl_FragCoord.xy), receiver) || !makeLightFrame(receiver, frame)) return;
    if (frame.isInside) return;
    vec3 a, b;
    if (!edgeBeforeLight(frame, receiver.posLight, vec4(aLight, 0.0), vec4(bLight, 0.0), a, b)) return;
    a.xy /= a.z;
    b.xy /= b.z;
    float turn = a.x * b.y - a.y * b.x;
    // A face that shows the light its front shows the receiver, on the other side of the edge, its back.
    float change = -sign(turn) * weight * frame.handedness * 0.5 * shareBeyond(a.xy, b.xy);
    layers = vec2(max(-change, 0.0), max(change, 0.0));
}

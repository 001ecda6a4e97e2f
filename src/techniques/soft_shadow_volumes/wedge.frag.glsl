// SPDX-License-Identifier: Apache-2.0
#version 450
// What one edge covers of the light, added to one of the V-buffer's two layers (thesis, sections 4.2.3 and 4.2.7).
//
// SPLIT: defined where layers are bytes, as published.
#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"
#include "src/techniques/soft_shadow_volumes/light_area.glsl"
#include "src/techniques/soft_shadow_volumes/seen_edges.glsl"
#include "src/techniques/soft_shadow_volumes/light_table.glsl"
#include "src/techniques/soft_shadow_volumes/radiance_beyond.glsl"

layout(location = 0) flat in vec3 aLight;
layout(location = 1) flat in vec3 bLight;
layout(location = 2) flat in float weight;
layout(location = 0) out float evaluations;
#ifdef SPLIT
#include "src/techniques/soft_shadow_volumes/split_values.glsl"
layout(location = 1) out vec4 additive;
layout(location = 2) out vec4 subtractive;

void put(vec3 change) {
    float mean = dot(change, vec3(1.0 / 3.0));
    additive = splitValue(mean);
    subtractive = splitValue(-mean);
}
#else
layout(location = 1) out vec2 layers;  // x: additive, y: subtractive
layout(location = 2) out vec4 colored;  // of a textured light: additive less subtractive, for each channel

void put(vec3 change) {
    float mean = dot(change, vec3(1.0 / 3.0));
    layers = vec2(max(mean, 0.0), max(-mean, 0.0));
    colored = vec4(change, 0.0);
}
#endif

void main() {
    put(vec3(0.0));
    evaluations = 1.0;
    Receiver receiver;
    LightFrame frame;
    if (!loadLiftedReceiver(ivec2(gl_FragCoord.xy), receiver) || !makeLightFrame(receiver, frame)) return;
    if (frame.isInside) return;
    SeenEdge edge;
    if (!seeEdge(frame, receiver.posLight, aLight, bLight, 0.0, edge)) return;
    vec2 from, to;
    if (!partBeforeLight(frame, edge, from, to)) return;
    // A face that shows the light its front shows the receiver, on the other side of the edge, its back.
    float blockers = (edge.hasLeft ? weight : -weight) * frame.handedness * 0.5;
    vec3 share = volume.light.isTextured ? radianceBeyond(edge, from, to) : vec3(shareBeyond(from, to));
    put(blockers * share);
}

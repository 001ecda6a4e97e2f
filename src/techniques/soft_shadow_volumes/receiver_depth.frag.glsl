// SPDX-License-Identifier: Apache-2.0
#version 450
// The depths of the receivers that the texels of the V-buffer stand for.
#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"

void main() {
    Receiver receiver;
    bool isReceiver = loadReceiver(ivec2(gl_FragCoord.xy) * volume.pixelsPerTexel, receiver);
    // Where nothing receives, nothing needs counting: no side lies before the nearest depth.
    gl_FragDepth = isReceiver ? liftedDepth(receiver) : (volume.isReversed ? 1.0 : 0.0);
}

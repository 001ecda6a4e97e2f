// SPDX-License-Identifier: Apache-2.0
#version 450
// Where the receivers of each small tile are.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"
#include "src/techniques/soft_shadow_volumes/light_area.glsl"

struct TileBounds { vec4 low, high; };
layout(std430, binding = 0) writeonly buffer Bounds { TileBounds bounds[]; };

shared uint low[3];
shared uint high[3];

// Unsigned integers in the order of the floats that they stand for.
uint orderedFrom(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float floatFrom(uint ordered) {
    return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    if (lane < 3u) {
        low[lane] = 0xffffffffu;
        high[lane] = 0u;
    }
    barrier();
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    Receiver receiver;
    LightFrame frame;
    if (all(lessThan(texel, volume.buffer_px.xy)) && loadLiftedReceiver(texel, receiver) &&
        makeLightFrame(receiver, frame) && horizonSide(frame) >= 0) {
        for (int axis = 0; axis < 3; ++axis) {
            atomicMin(low[axis], orderedFrom(receiver.posLight[axis]));
            atomicMax(high[axis], orderedFrom(receiver.posLight[axis]));
        }
    }
    barrier();
    if (lane > 0u) return;
    TileBounds tile = TileBounds(vec4(1.0), vec4(0.0));
    if (low[0] <= high[0]) {
        tile.low = vec4(floatFrom(low[0]), floatFrom(low[1]), floatFrom(low[2]), 0.0);
        tile.high = vec4(floatFrom(high[0]), floatFrom(high[1]), floatFrom(high[2]), 0.0);
    }
    bounds[gl_WorkGroupID.y * uint(volume.tiles.x) + gl_WorkGroupID.x] = tile;
}

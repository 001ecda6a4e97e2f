// SPDX-License-Identifier: Apache-2.0
#version 450
// Where the receivers of each small tile are.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"
#include "src/techniques/soft_shadow_volumes/light_area.glsl"

struct TileBounds { vec4 low, high; };
layout(std430) writeonly buffer Bounds { TileBounds bounds[]; };

shared vec3 places[64];
shared bool isThere[64];
shared vec2 ranges[3];

void main() {
    uint lane = gl_LocalInvocationIndex;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    Receiver receiver;
    LightFrame frame;
    isThere[lane] = all(lessThan(texel, volume.buffer_px)) && loadLiftedReceiver(texel, receiver) &&
                    makeLightFrame(receiver, frame) && horizonSide(frame) >= 0;
    places[lane] = receiver.posLight;
    barrier();
    // Three lanes, an axis each.
    if (lane < 3u) {
        vec2 range = vec2(3e38, -3e38);
        for (int i = 0; i < 64; ++i) {
            float place = places[i][lane];
            range = isThere[i] ? vec2(min(range.x, place), max(range.y, place)) : range;
        }
        ranges[lane] = range;
    }
    barrier();
    if (lane > 0u) return;
    bool isEmpty = ranges[0].x > ranges[0].y;
    vec4 low = isEmpty ? vec4(1.0) : vec4(ranges[0].x, ranges[1].x, ranges[2].x, 0.0);
    vec4 high = isEmpty ? vec4(0.0) : vec4(ranges[0].y, ranges[1].y, ranges[2].y, 0.0);
    bounds[gl_WorkGroupID.y * volume.smallTilesAcross + gl_WorkGroupID.x] = TileBounds(low, high);
}

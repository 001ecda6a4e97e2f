// SPDX-License-Identifier: Apache-2.0
#version 450
// Visibility as the thesis has it: the additive layer, one and what wedges add, less the subtractive one, the umbra of the
// light's centre and what wedges subtract (figure 8).
//
// SPLIT: see wedge.frag.glsl.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/common/view.glsl"
#include "src/techniques/soft_shadow_volumes/volumes_io.h"
#include "src/techniques/soft_shadow_volumes/lifted_receiver.glsl"
#include "src/techniques/soft_shadow_volumes/light_area.glsl"

uniform sampler2D volumeCounts;
#ifdef SPLIT
#include "src/techniques/soft_shadow_volumes/split_values.glsl"
uniform sampler2D additiveBytes;
uniform sampler2D subtractiveBytes;
layout(rg32f) uniform writeonly image2D wedgeLayers;
#else
layout(rg32f) uniform image2D wedgeLayers;
uniform sampler2D wedgeColors;  // of a textured light
#endif
layout(std430) readonly buffer Eye { EyeState eye; };
uniform writeonly image2D visibility;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, volume.buffer_px))) return;
    Receiver receiver;
    LightFrame frame;
    vec3 seen = vec3(1.0);
    vec2 shown = vec2(1.0, 0.0);
    if (loadLiftedReceiver(texel, receiver)) {
        seen = vec3(0.0);
        if (makeLightFrame(receiver, frame) && horizonSide(frame) >= 0) {
            float hard = 0.5 * (texelFetch(volumeCounts, texel, 0).r + float(eye.blockers));
#ifdef SPLIT
            vec2 layers = vec2(joinedValue(texelFetch(additiveBytes, texel, 0)),
                               joinedValue(texelFetch(subtractiveBytes, texel, 0)));
            vec3 soft = vec3(layers.x - layers.y);
#else
            vec2 layers = imageLoad(wedgeLayers, texel).rg;
            vec3 soft = volume.light.isTextured ? texelFetch(wedgeColors, texel, 0).rgb : vec3(layers.x - layers.y);
#endif
            seen = frame.isInside ? vec3(1.0) : clamp(1.0 - hard + soft, 0.0, 1.0);
            shown = vec2(1.0, hard) + layers;
        }
    }
    imageStore(wedgeLayers, texel, vec4(shown, 0.0, 0.0));
    imageStore(visibility, texel, vec4(seen, 1.0));
}

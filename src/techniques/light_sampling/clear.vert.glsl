// SPDX-License-Identifier: Apache-2.0
#version 450
#ifndef LAYER_BY_LAYER
#extension GL_ARB_shader_viewport_layer_array : require
#endif
// Two triangles over the cells that a map has to show, infinitely far away.
#include "src/techniques/light_sampling/sampling_io.h"

layout(std430) readonly buffer Masks { LayerMask masks[]; };

in ivec2 layerAndCaster;  // one an instance

void main() {
    int layer = layerAndCaster.x;
    ivec4 cells = masks[layer].cells;
    const ivec2 corners[6] = ivec2[6](ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 0), ivec2(1, 1), ivec2(0, 1));
    ivec2 corner = corners[gl_VertexID];
    vec2 place = vec2(corner.x == 0 ? cells.x : cells.z + 1, corner.y == 0 ? cells.y : cells.w + 1);
    gl_Position = vec4(2.0 * place / float(maskSide) - 1.0, 0.0, 1.0);
#ifndef LAYER_BY_LAYER
    gl_Layer = layer;
#endif
}

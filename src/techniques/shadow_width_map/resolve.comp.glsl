// SPDX-License-Identifier: Apache-2.0
#version 450
// Exact mode, first of two passes: pixels too far from any edge for a penumbra are lit or in umbra, which one texel
// tells. The others are listed for penumbra.comp.glsl: two passes, since software rasterizers run both sides of every
// branch, and graphics hardware where both sides are taken by pixels side by side.
layout(local_size_x = 8, local_size_y = 8) in;

#include "src/techniques/shadow_width_map/receiving.glsl"
#include "src/techniques/shadow_width_map/penumbra_pixels.glsl"

uniform sampler2DArray widths;

// The nearness at which penumbrae of the edges around this place begin: those of all cells that penumbra.comp.glsl
// interpolates between, so that what is skipped is exact.
float penumbraBeginsAt(Receiving r) {
    vec2 uv = r.place_px / float(constants.cell_px * constants.cellsAcross);
    vec4 begins = textureGather(widths, vec3(uv, r.camera), 1);
    return max(max(begins.x, begins.y), max(begins.z, begins.w));
}

// Negative: in a penumbra, perhaps.
float seenBy(Receiver receiver) {
    Receiving r;
    if (!isFacing(receiver, true)) return 0.0;
    if (!startReceiving(receiver, r)) return 1.0;
    if (penumbraBeginsAt(r) > r.nearness) return -1.0;
    ivec2 texel = ivec2(r.place_px);
    return isAbove(r, texel, texelFetch(depthMaps, ivec3(texel, r.camera), 0).r) ? 0.0 : 1.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px))) return;
    Receiver receiver;
    float seen = loadReceiver(pixel, receiver) ? seenBy(receiver) : 1.0;
    if (seen >= 0.0) {
        imageStore(visibility, pixel, vec4(seen));
    } else {
        uint index = atomicAdd(pixelCount, 1u);
        if (index % 64u == 0u) atomicAdd(groupCount, 1u);
        penumbraPixels[index] = uint(pixel.x) | uint(pixel.y) << 16;
    }
}

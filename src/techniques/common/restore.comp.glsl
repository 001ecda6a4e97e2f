// SPDX-License-Identifier: Apache-2.0
#version 450
// The answer of the last frame, where nothing has changed since.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D kept;
uniform writeonly image2D visibility;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    // Not the image's size: it may be a part of the host's texture.
    if (any(greaterThanEqual(pixel, textureSize(kept, 0)))) return;
    imageStore(visibility, pixel, texelFetch(kept, pixel, 0));
}

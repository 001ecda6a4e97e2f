// SPDX-License-Identifier: Apache-2.0
#version 450
// For casters with holes; all others need no fragment stage.
layout(binding = 0) uniform sampler2D alphaTexture;

layout(location = 0) in vec2 uv;
layout(location = 1) flat in vec2 alpha;

void main() {
    if (texture(alphaTexture, uv).a * alpha.x < alpha.y) discard;
}

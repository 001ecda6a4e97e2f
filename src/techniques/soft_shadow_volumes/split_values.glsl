// SPDX-License-Identifier: Apache-2.0
// Shares of the light in four bytes, three bits in each (thesis, section 4.2.3, figures 5 to 7): the other five leave room for
// 31 of them to be added up.

const float splitMost = 4095.0;

vec4 splitValue(float share) {
    uint value = uint(round(clamp(share, 0.0, 1.0) * splitMost));
    return vec4((uvec4(value) >> uvec4(9u, 6u, 3u, 0u)) & 7u) / 255.0;
}

float joinedValue(vec4 bytes) { return dot(bytes * 255.0, vec4(512.0, 64.0, 8.0, 1.0)) / splitMost; }

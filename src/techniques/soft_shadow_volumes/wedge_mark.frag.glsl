// SPDX-License-Identifier: Apache-2.0
#version 450
// What marks pixels in the stencil, or outlines a wedge.
layout(location = 0) out float line;
void main() { line = 1.0; }

// SPDX-License-Identifier: Apache-2.0
#version 450
// Adds up; a float holds every integer to 16 million, so that the order of the sum does not matter.
layout(location = 0) flat in float change;
layout(location = 0) out float count;
void main() { count = change; }

// SPDX-License-Identifier: Apache-2.0
// Mean radiance of a textured light around each sample: an element of `weights`, which the includer declares.

int weightIndex(int lattice, int i, int j) { return (lattice * EXACT_MAX_ROWS + j) * EXACT_MAX_ROWS + i; }

// What emits nothing, or less, or is not a number.
vec3 emitted(vec3 texel) { return mix(vec3(0.0), min(texel, vec3(3e38)), greaterThan(texel, vec3(0.0))); }

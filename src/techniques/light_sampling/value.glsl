// SPDX-License-Identifier: Apache-2.0
// What is summed: a number, or a channel each where the light is textured (variant COLORED).
#ifdef COLORED
#define VALUE vec3
#define WEIGHT(light) light.radianceShare
#define FORMAT rgba32f
#define FROM(texel) texel.rgb
#define TO(value) vec4(value, 1.0)
#else
#define VALUE float
#define WEIGHT(light) light.areaShare
#define FORMAT r32f
#define FROM(texel) texel.r
#define TO(value) vec4(value)
#endif

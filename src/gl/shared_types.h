// SPDX-License-Identifier: Apache-2.0
// Types of the structs that C++ and GLSL share (*_io.h). In them vectors stand where std140 and std430 put
// them anyway: a vec3 or vec4 at a multiple of 16 bytes, a vec2 at one of 8; numbers and flags fill what is
// left. SHARED_STRUCT pads its size to 16 bytes, as std140 does.
#ifndef PENUMBRA_SHARED_TYPES_H
#define PENUMBRA_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define SHARED_STRUCT struct alignas(16)
namespace penumbra {
using glm::ivec2;
using glm::ivec3;
using glm::ivec4;
using glm::mat4;
using glm::uint;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
/// A bool as shaders have it.
using bool32 = std::uint32_t;
}  // namespace penumbra
#else
#define SHARED_STRUCT struct
#define bool32 bool
#endif
#endif

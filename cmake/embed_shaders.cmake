# SPDX-License-Identifier: Apache-2.0
# Run by the build: writes OUTPUT, a C++ file that defines penumbra::shaders_of::TABLE() over FILES (see shaders.cmake).
# Texts are literals of string_view, whose length the compiler knows: one that must count it at compile time stops at
# its limit of steps (clang).
string(REPLACE "," ";" files "${FILES}")
set(entries "")
foreach(file IN LISTS files)
    file(RELATIVE_PATH name ${ROOT} ${file})
    file(READ ${file} text)
    string(APPEND entries "    {\"${name}\", R\"penumbra_glsl(${text})penumbra_glsl\"sv},\n")
endforeach()
file(WRITE ${OUTPUT} "// Generated from the files it names.
#include <span>

#include \"src/gl/shader_library.h\"

namespace penumbra::shaders_of {

std::span<const gl::EmbeddedShader> ${TABLE}() {
    using namespace std::string_view_literals;
    static constexpr gl::EmbeddedShader shaders[] = {
${entries}    };
    return shaders;
}

}  // namespace penumbra::shaders_of
")

# SPDX-License-Identifier: Apache-2.0
# Run by the build: writes OUTPUT, a C++ file that defines penumbra::FUNCTION() over FILES (see shaders.cmake).
string(REPLACE "," ";" files "${FILES}")
set(entries "")
foreach(file IN LISTS files)
    file(RELATIVE_PATH name ${ROOT} ${file})
    file(READ ${file} text)
    string(APPEND entries "    {\"${name}\", R\"penumbra_glsl(${text})penumbra_glsl\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Generated from the files it names.
#include \"${HEADER}\"

namespace penumbra {

std::span<const gl::EmbeddedShader> ${FUNCTION}() {
    static constexpr gl::EmbeddedShader shaders[] = {
${entries}    };
    return shaders;
}

}  // namespace penumbra
")

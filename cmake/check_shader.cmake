# SPDX-License-Identifier: Apache-2.0
# Run by the build: GLSLANG must accept FILE as STAGE; then writes STAMP. Our files use a bare #include (the library
# expands it), which glslangValidator knows as an extension.
file(READ ${FILE} text)
string(REPLACE "#version 450\n" "#version 450\n#extension GL_GOOGLE_include_directive : require\n" text "${text}")
file(WRITE ${STAMP}.glsl "${text}")
execute_process(COMMAND ${GLSLANG} -l -S ${STAGE} -I${ROOT} ${STAMP}.glsl
    RESULT_VARIABLE failed OUTPUT_VARIABLE messages ERROR_VARIABLE messages)
if(failed)
    message(FATAL_ERROR "${FILE} (line numbers are one too large):\n${messages}")
endif()
file(WRITE ${STAMP} "")

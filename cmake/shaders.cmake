# SPDX-License-Identifier: Apache-2.0
# penumbra_embed_shaders(TARGET HEADER FUNCTION FILES ...): puts GLSL files, and the headers they share with C++, into
# TARGET as the table that penumbra::FUNCTION() (declared in HEADER) returns, and checks every stage at build time.
find_program(PENUMBRA_GLSLANG glslangValidator)
if(NOT PENUMBRA_GLSLANG)
    message(STATUS "glslangValidator not found: shaders are not checked at build time")
endif()

function(penumbra_embed_shaders target header function)
    cmake_parse_arguments(PARSE_ARGV 3 arg "" "" "FILES")
    list(TRANSFORM arg_FILES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE files)
    set(generated ${CMAKE_CURRENT_BINARY_DIR}/${target}_shaders.cpp)
    string(REPLACE ";" "," joined "${files}")
    add_custom_command(OUTPUT ${generated}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${generated} -DROOT=${PROJECT_SOURCE_DIR} -DHEADER=${header}
            -DFUNCTION=${function} -DFILES=${joined} -P ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
        DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
        COMMENT "Embedding the shaders of ${target}" VERBATIM)
    target_sources(${target} PRIVATE ${generated})

    if(PENUMBRA_GLSLANG)
        foreach(file IN LISTS files)
            if(file MATCHES "\\.(vert|geom|frag|comp)\\.glsl$")
                set(stage ${CMAKE_MATCH_1})
                file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${file})
                string(REPLACE "/" "-" stamp ${name})
                set(stamp ${CMAKE_CURRENT_BINARY_DIR}/${stamp}.checked)
                add_custom_command(OUTPUT ${stamp}
                    COMMAND ${CMAKE_COMMAND} -DGLSLANG=${PENUMBRA_GLSLANG} -DSTAGE=${stage} -DFILE=${file}
                        -DROOT=${PROJECT_SOURCE_DIR} -DSTAMP=${stamp} -P ${PROJECT_SOURCE_DIR}/cmake/check_shader.cmake
                    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/check_shader.cmake
                    COMMENT "Checking ${name}" VERBATIM)
                list(APPEND stamps ${stamp})
            endif()
        endforeach()
        add_custom_target(${target}_shader_check DEPENDS ${stamps})
        add_dependencies(${target} ${target}_shader_check)
    endif()
endfunction()

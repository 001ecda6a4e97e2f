# SPDX-License-Identifier: Apache-2.0
# Everything we compile goes through penumbra_compile_options(), so that a flag is said once.
find_program(PENUMBRA_CCACHE ccache)
if(PENUMBRA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${PENUMBRA_CCACHE})
endif()

function(penumbra_compile_options target)
    target_compile_options(${target} PRIVATE
        -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wno-missing-field-initializers)
    if(PENUMBRA_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(PENUMBRA_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=${PENUMBRA_SANITIZE} -fno-sanitize-recover=undefined
            -fno-omit-frame-pointer)
        target_link_options(${target} PUBLIC -fsanitize=${PENUMBRA_SANITIZE})
    endif()
endfunction()

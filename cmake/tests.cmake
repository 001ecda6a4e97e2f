# SPDX-License-Identifier: Apache-2.0
include(GoogleTest)

# penumbra_test(NAME [IN_BOTH_PROFILES | SLOWLY_IN_BOTH_PROFILES] SOURCES a_test.cpp ... LIBRARIES lib ...): one GoogleTest
# program, its cases known to ctest, which also knows them by the label NAME; IN_BOTH_PROFILES: each once in a core context of
# OpenGL and once in a compatibility context; SLOWLY: that among the slow tests. The limit of time is there to end what hangs,
# on however busy a machine.
function(penumbra_test name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "IN_BOTH_PROFILES;SLOWLY_IN_BOTH_PROFILES" "" "SOURCES;LIBRARIES")
    add_executable(${name} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} GTest::gtest_main)
    penumbra_compile_options(${name})
    gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 1200 LABELS ${name})
    if(arg_IN_BOTH_PROFILES OR arg_SLOWLY_IN_BOTH_PROFILES)
        set(label ${name})
        if(arg_SLOWLY_IN_BOTH_PROFILES)
            string(APPEND label .slow)
        endif()
        gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 TEST_SUFFIX .compatibility
            PROPERTIES TIMEOUT 1200 LABELS ${label} ENVIRONMENT PENUMBRA_TEST_PROFILE=compatibility)
    endif()
endfunction()

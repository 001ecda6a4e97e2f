# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` lays down, and how others find it. Components: library (what programs need to run),
# development (headers, static library, CMake package, pkg-config), tools (the command), python (the module).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# Whoever finds the package knows the shared library as penumbra::penumbra and the static one as penumbra::static.
set_target_properties(penumbra_shared PROPERTIES EXPORT_NAME penumbra)
set_target_properties(penumbra PROPERTIES EXPORT_NAME static)
install(TARGETS penumbra_shared penumbra EXPORT penumbra
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/penumbra DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/penumbra)
install(EXPORT penumbra NAMESPACE penumbra:: FILE penumbra-targets.cmake
    DESTINATION ${package_folder} COMPONENT development)
configure_package_config_file(cmake/penumbra-config.cmake.in penumbra-config.cmake
    INSTALL_DESTINATION ${package_folder})
# Until 1.0 every minor version may break its users.
write_basic_package_version_file(penumbra-config-version.cmake COMPATIBILITY SameMinorVersion)
file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/penumbra.pc.in penumbra.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/penumbra-config.cmake ${PROJECT_BINARY_DIR}/penumbra-config-version.cmake
    cmake/FindEpoxy.cmake DESTINATION ${package_folder} COMPONENT development)
install(FILES ${PROJECT_BINARY_DIR}/penumbra.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

if(PENUMBRA_STUDIO)
    install(TARGETS penumbra_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
    install(FILES docs/penumbra.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
    install(FILES apps/penumbra/completion.bash
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME penumbra COMPONENT tools)
endif()

# Each package keeps its own copy of the licence, where Debian looks for it.
set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(package_of_library libpenumbra${soversion})
set(package_of_development libpenumbra-dev)
set(package_of_tools penumbra)
set(package_of_python python3-penumbra)
foreach(component library development tools python)
    install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package_of_${component}} RENAME copyright
        COMPONENT ${component})
endforeach()

# Debian packages: `cpack -G DEB` in the build folder.
set(CPACK_PACKAGE_VENDOR "Penumbra")
set(CPACK_PACKAGE_CONTACT "Penumbra <penumbra@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL library development)
if(PENUMBRA_STUDIO)
    list(APPEND CPACK_COMPONENTS_ALL tools)
endif()
if(PENUMBRA_PYTHON)
    list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${package_of_library})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/triggers)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "${PROJECT_DESCRIPTION}: the shared library")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME ${package_of_development})
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${package_of_library} (= ${PROJECT_VERSION}), libepoxy-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION}: headers and static library")
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME ${package_of_tools})
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "libegl1, libgl1-mesa-dri")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "${PROJECT_DESCRIPTION}: the command")
if(PENUMBRA_PYTHON)
    # A module is for the Python that it was built with.
    math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME ${package_of_python})
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy, libegl1, libgl1-mesa-dri")
    set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${PROJECT_DESCRIPTION}: the Python module")
endif()
include(CPack)

# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` lays down, and how others find it. Components: library (what programs need to run),
# development (headers, static library, CMake package, pkg-config), tools (the command), documentation, python (the module).
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

include(cmake/packages.cmake)

if(PENUMBRA_STUDIO)
    install(TARGETS penumbra_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
    compressed(${PROJECT_SOURCE_DIR}/docs/penumbra.1 ${PROJECT_BINARY_DIR}/penumbra.1.gz)
    install(FILES ${PROJECT_BINARY_DIR}/penumbra.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
    install(FILES apps/penumbra/completion.bash
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME penumbra COMPONENT tools)
    install(FILES apps/penumbra/desktop/penumbra.desktop
        DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT tools)
    install(FILES apps/penumbra/desktop/penumbra.svg
        DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT tools)
    install(FILES docs/lights.schema.json docs/json.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/penumbra COMPONENT tools)

    # As they lie here, so that what refers to each other does so there, too.
    set(documentation ${CMAKE_INSTALL_DATADIR}/doc/${package_of_documentation})
    install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${documentation} COMPONENT documentation)
    install(DIRECTORY docs examples DESTINATION ${documentation} COMPONENT documentation
        PATTERN penumbra.1 EXCLUDE PATTERN "__pycache__" EXCLUDE PATTERN "build*" EXCLUDE)
endif()

# SPDX-License-Identifier: Apache-2.0
# The components as Debian packages: `cpack -G DEB` in the build folder, or ./dev package. What only a package has, such as a
# Debian changelog, is laid down by every installation: it is little, and one prefix is like the other.
include(GNUInstallDirs)

set(package_of_library libpenumbra${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(package_of_development libpenumbra-dev)
set(package_of_tools penumbra)
set(package_of_documentation penumbra-doc)
set(package_of_python python3-penumbra)
set(components library development)
if(PENUMBRA_STUDIO)
    list(APPEND components tools documentation)
endif()
if(PENUMBRA_PYTHON)
    list(APPEND components python)
endif()

# Whoever makes packages is named in them, as Debian's own tools have it.
set(CPACK_PACKAGE_CONTACT "The Penumbra authors <penumbra@localhost>")
if(DEFINED ENV{DEBEMAIL})
    set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH's where that is set
configure_file(cmake/debian/changelog.in changelog @ONLY)

# compressed(SOURCE RESULT): as Debian wants it, always the same bytes.
function(compressed source result)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    execute_process(COMMAND gzip -9nc ${source} OUTPUT_FILE ${result} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
compressed(${PROJECT_BINARY_DIR}/changelog ${PROJECT_BINARY_DIR}/changelog.gz)
foreach(component IN LISTS components)
    set(package ${package_of_${component}})
    install(FILES cmake/debian/copyright ${PROJECT_BINARY_DIR}/changelog.gz
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
    set(more_overrides "")
    if(component STREQUAL library)
        set(more_overrides "
# CPack writes scripts that call ldconfig, beside the trigger that it is given.
${package}: maintscript-calls-ldconfig *")
    endif()
    configure_file(cmake/debian/lintian-overrides.in lintian-overrides/${package} @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/lintian-overrides/${package}
        DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT ${component})
endforeach()

set(CPACK_PACKAGE_VENDOR "Penumbra")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own

# package(COMPONENT SECTION SYNOPSIS DESCRIPTION)
macro(package component section synopsis description)
    string(TOUPPER ${component} upper)
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package_of_${component}})
    set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
    set(CPACK_DEBIAN_${upper}_DESCRIPTION "${synopsis}\n${description}")
endmacro()
set(about "Penumbra renders the shadows of lamps that have a size, by published techniques
and an exact one of its own, on any OpenGL 4.5 machine, with or without a GPU.")
package(library libs "soft shadows of lights that have a size: shared library" "${about}\n
This package contains the library that programs need to run.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
package(development libdevel "soft shadows of lights that have a size: development files" "${about}\n
This package contains the headers, the static library, and what CMake and
pkg-config need to find them.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${package_of_library} (= ${PROJECT_VERSION}), libepoxy-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "${package_of_documentation}")
package(tools graphics "soft shadows of lights that have a size: command and viewer" "${about}\n
This package contains the command, which renders glTF scenes, judges every
technique against a ray-traced reference and measures illuminance, and its
viewer.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "libegl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "${package_of_documentation}")
package(documentation doc "soft shadows of lights that have a size: manual and examples" "${about}\n
This package contains the manual, the schema of files of lights, and examples:
the library in renderers of many kinds, Python, an office to be measured.")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
package(python python "soft shadows of lights that have a size: Python module" "${about}\n
This package contains the module penumbra, which renders scenes into NumPy
arrays.")
if(PENUMBRA_PYTHON)
    # A module is for the Python that it was built with.
    math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy, libegl1, libgl1-mesa-dri")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "${package_of_documentation}, python3-matplotlib")
endif()
include(CPack)

# SPDX-License-Identifier: Apache-2.0
# Epoxy::Epoxy, the OpenGL loader (libepoxy 1.5 or newer). It brings no CMake package of its own, and searched for by
# name it is found wherever it was put: CMAKE_PREFIX_PATH, conda, a tarball. Global, since whoever links Penumbra in another
# folder links it, too.
find_path(Epoxy_INCLUDE_DIR epoxy/gl.h)
find_library(Epoxy_LIBRARY epoxy)
mark_as_advanced(Epoxy_INCLUDE_DIR Epoxy_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Epoxy REQUIRED_VARS Epoxy_LIBRARY Epoxy_INCLUDE_DIR)
if(Epoxy_FOUND AND NOT TARGET Epoxy::Epoxy)
    add_library(Epoxy::Epoxy UNKNOWN IMPORTED GLOBAL)
    set_target_properties(Epoxy::Epoxy PROPERTIES
        IMPORTED_LOCATION ${Epoxy_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${Epoxy_INCLUDE_DIR})
endif()

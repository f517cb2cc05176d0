# OpenEXR's C library. Its own CMake package fails on Debian 12 unless python3-imath is installed.
find_path(OpenEXRCore_INCLUDE_DIR NAMES openexr.h PATH_SUFFIXES OpenEXR)
find_library(OpenEXRCore_LIBRARY NAMES OpenEXRCore)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenEXRCore REQUIRED_VARS OpenEXRCore_LIBRARY OpenEXRCore_INCLUDE_DIR)
if(OpenEXRCore_FOUND AND NOT TARGET OpenEXR::Core)
    add_library(OpenEXR::Core UNKNOWN IMPORTED)
    set_target_properties(OpenEXR::Core PROPERTIES
        IMPORTED_LOCATION "${OpenEXRCore_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenEXRCore_INCLUDE_DIR}")
endif()

# Embree 4 where it is, else Embree 3. Defines Embree::Embree, which brings AUR_EMBREE_VERSION (3 or 4) along. Header and
# library must be of one version, so the version is chosen by the header.
find_path(Embree_INCLUDE_DIR NAMES embree4/rtcore.h)
find_path(Embree_INCLUDE_DIR NAMES embree3/rtcore.h)
if(Embree_INCLUDE_DIR AND EXISTS "${Embree_INCLUDE_DIR}/embree4/rtcore.h")
    set(Embree_MAJOR 4)
else()
    set(Embree_MAJOR 3)
endif()
find_library(Embree_LIBRARY NAMES embree${Embree_MAJOR})
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Embree REQUIRED_VARS Embree_LIBRARY Embree_INCLUDE_DIR)
if(Embree_FOUND AND NOT TARGET Embree::Embree)
    add_library(Embree::Embree UNKNOWN IMPORTED)
    set_target_properties(Embree::Embree PROPERTIES
        IMPORTED_LOCATION "${Embree_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${Embree_INCLUDE_DIR}"
        INTERFACE_COMPILE_DEFINITIONS "AUR_EMBREE_VERSION=${Embree_MAJOR}")
endif()

# From this tree; of a release, vcpkg_from_github or vcpkg_download_distfile takes the place of this line.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS -DAUREOLE_RENDER=OFF -DAUREOLE_PROGRAM=OFF -DAUREOLE_TESTS=OFF -DAUREOLE_PYTHON=OFF -DAUREOLE_WERROR=OFF)
vcpkg_cmake_install()
if(VCPKG_LIBRARY_LINKAGE STREQUAL "dynamic")
    vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/aureole)
    vcpkg_fixup_pkgconfig()
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")

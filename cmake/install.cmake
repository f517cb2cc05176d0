# What `cmake --install` lays down: libraries, program, headers, and how other projects find them (CMake and pkg-config).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Components are the packages that cmake/packages.cmake makes; `cmake --install` lays down all of them.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)
foreach(library IN LISTS libraries)
    string(REPLACE aureole lib component ${library}) # lib, lib-render
    install(TARGETS ${library} EXPORT aureole-targets
            LIBRARY COMPONENT ${component} NAMELINK_COMPONENT dev INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endforeach()

if(TARGET aureole-lab)
    install(TARGETS aureole-lab EXPORT aureole-targets
            LIBRARY COMPONENT lib-lighting NAMELINK_COMPONENT dev INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    install(DIRECTORY include/aureole-lab DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()

# Program and libraries find each other wherever the tree is moved to.
foreach(name render lighting)
    if(TARGET aureole-${name})
        set_target_properties(aureole-${name} PROPERTIES EXPORT_NAME ${name} INSTALL_RPATH "$ORIGIN")
    endif()
endforeach()
if(AUREOLE_PROGRAM)
    file(RELATIVE_PATH bin_to_lib "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
    set_target_properties(aureole-program PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
    install(TARGETS aureole-program COMPONENT program)
    if(TARGET aureole-serve)
        install(TARGETS aureole-serve DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program)
    endif()
endif()
if(TARGET aureole-mpi)
    set_target_properties(aureole-mpi PROPERTIES INSTALL_RPATH "$ORIGIN")
    install(TARGETS aureole-mpi DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT lib-render)
endif()
if(TARGET aureole-import) # nobody starts it by hand
    set_target_properties(aureole-import PROPERTIES INSTALL_RPATH "$ORIGIN;$ORIGIN/..")
    install(TARGETS aureole-import RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR}/aureole COMPONENT lib-render)
endif()

# What the wheel aureole-render holds (python/render): libraries and modules beside each other in a folder of Python's.
if(AUREOLE_RENDER AND BUILD_SHARED_LIBS)
    set(wheel_targets ${libraries})
    if(TARGET aureole-lab)
        list(APPEND wheel_targets aureole-lab)
    endif()
    if(TARGET aureole-import)
        list(APPEND wheel_targets aureole-import)
    endif()
    add_custom_target(aureole-python-render DEPENDS ${wheel_targets})
    if(SKBUILD) # a wheel has no links
        set_target_properties(${libraries} aureole-lab PROPERTIES VERSION 1)
    endif()
    install(TARGETS ${wheel_targets} LIBRARY DESTINATION aureole_render COMPONENT python-render NAMELINK_SKIP EXCLUDE_FROM_ALL
            RUNTIME DESTINATION aureole_render COMPONENT python-render EXCLUDE_FROM_ALL)
    install(FILES python/render/aureole_render/__init__.py DESTINATION aureole_render COMPONENT python-render EXCLUDE_FROM_ALL)
endif()
foreach(library IN LISTS libraries)
    install(DIRECTORY include/${library} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endforeach()
# Names that headers had before each library had a folder of them, for one version.
set(moved_headers)
if(AUREOLE_RENDER)
    list(APPEND moved_headers render/film.h render/image.h render/radiosity.h render/render.h render/render.hpp render/scene.h)
endif()
if(TARGET aureole-lighting)
    list(APPEND moved_headers lighting/daylight.h lighting/irradiance.h lighting/view_factors.h)
endif()
foreach(header IN LISTS moved_headers)
    get_filename_component(name "${header}" NAME)
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/moved/${name}"
         CONTENT "/* The old name of this header, which the next version will not have. */\n#include <aureole-${header}>\n")
    install(FILES "${PROJECT_BINARY_DIR}/moved/${name}" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/aureole)
endforeach()
install(FILES include/aureole_sampling.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

# Completion, where the shells look for it.
set(shell_files)
if(AUREOLE_PROGRAM)
    set(shell_files bash:bash-completion/completions/aureole zsh:zsh/site-functions/_aureole
                    fish:fish/vendor_completions.d/aureole.fish)
endif()
foreach(shell_file IN LISTS shell_files)
    string(REGEX MATCH "^([a-z]+):(.*)/(.*)$" matched "${shell_file}")
    set(script "${PROJECT_BINARY_DIR}/completion/${CMAKE_MATCH_3}")
    add_custom_command(OUTPUT "${script}" VERBATIM DEPENDS aureole-program
        COMMAND "${CMAKE_COMMAND}" -E make_directory "${PROJECT_BINARY_DIR}/completion"
        COMMAND aureole-program completion ${CMAKE_MATCH_1} > "${script}")
    list(APPEND completion_scripts "${script}")
    install(FILES "${script}" DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/${CMAKE_MATCH_2} COMPONENT program)
endforeach()
add_custom_target(completion-scripts ALL DEPENDS ${completion_scripts})

# Manual pages.
if(AUREOLE_PROGRAM)
    set(manual_pages "${PROJECT_BINARY_DIR}/man")
    add_custom_command(OUTPUT "${manual_pages}/man1/aureole.1" VERBATIM DEPENDS aureole-program
        COMMAND "${CMAKE_COMMAND}" -E rm -rf "${manual_pages}"
        COMMAND aureole-program manual -o "${manual_pages}")
    add_custom_target(manual-pages ALL DEPENDS "${manual_pages}/man1/aureole.1")
    install(DIRECTORY "${manual_pages}/" DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
endif()

# A static build would have to hand on its own dependencies, so only the shared one is a package.
if(BUILD_SHARED_LIBS)
    set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/aureole)
    install(EXPORT aureole-targets NAMESPACE Aureole:: DESTINATION ${package_dir})
    configure_package_config_file(cmake/aureole-config.cmake.in aureole-config.cmake INSTALL_DESTINATION ${package_dir})
    write_basic_package_version_file(aureole-config-version.cmake COMPATIBILITY SameMinorVersion)
    install(FILES "${PROJECT_BINARY_DIR}/aureole-config.cmake" "${PROJECT_BINARY_DIR}/aureole-config-version.cmake"
            DESTINATION ${package_dir})

    # pkg-config files name the prefix, which `cmake --install --prefix` may change, so they say it by their own place.
    file(RELATIVE_PATH AUREOLE_PC_PREFIX "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
    set(packages ${libraries})
    if(TARGET aureole-lab)
        list(APPEND packages aureole-lab)
    endif()
    foreach(name IN LISTS packages)
        configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
        install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
    endforeach()
endif()

# The Python package: one extension with libaureole in it, which cffi makes from the public headers, beside the modules of
# python/aureole. It needs cffi to be built (Debian: python3-cffi, python3-dev), and NumPy and cffi to run.
if(NOT CMAKE_CROSSCOMPILING)
    if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
        set(Python_EXECUTABLE /usr/bin/python3) # before others, which have not Debian's packages
    endif()
    find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
    set(python_found OFF)
    if(Python_FOUND)
        execute_process(COMMAND "${Python_EXECUTABLE}" -c "import cffi" RESULT_VARIABLE no_cffi ERROR_QUIET)
        if(no_cffi EQUAL 0)
            set(python_found ON)
        endif()
    endif()
endif()
option(AUREOLE_PYTHON "Build the Python package" ${python_found})
if(NOT AUREOLE_PYTHON)
    return()
endif()
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)

set(python_package "${PROJECT_BINARY_DIR}/python/aureole")
set(bridge "${PROJECT_SOURCE_DIR}/python/declare.py")
set(native "${PROJECT_BINARY_DIR}/python/native.c")
set(library "${python_package}/_library.py")
file(GLOB lab_headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/aureole-lab/*.h")
add_custom_command(OUTPUT "${native}" "${library}" VERBATIM
    DEPENDS "${bridge}" "${PROJECT_SOURCE_DIR}/python/native.c" ${public_headers} ${lab_headers}
    COMMAND "${Python_EXECUTABLE}" "${bridge}" native "${PROJECT_SOURCE_DIR}/include" "${native}"
    COMMAND "${Python_EXECUTABLE}" "${bridge}" library "${PROJECT_SOURCE_DIR}/include" "${library}")
# What cffi writes keeps to the stable interface of Python by itself. A free-threaded Python has none, and needs its own build.
execute_process(COMMAND "${Python_EXECUTABLE}" -c "import sysconfig; print(sysconfig.get_config_var('Py_GIL_DISABLED') or 0, end='')"
    OUTPUT_VARIABLE python_free_threaded)
set(python_suffix .abi3.so)
if(python_free_threaded EQUAL 1)
    set(python_suffix .so)
endif()
add_library(aureole-python MODULE "${native}" "${library}" ${point_objects})
target_include_directories(aureole-python PRIVATE "${PROJECT_SOURCE_DIR}/include")
target_link_libraries(aureole-python PRIVATE Python::Module Threads::Threads ${CMAKE_DL_LIBS} m)
# It shows its beginning alone, so that another libaureole in the process stays another one.
file(WRITE "${PROJECT_BINARY_DIR}/python/native.map" "{ global: PyInit__native; local: *; };\n")
target_link_options(aureole-python PRIVATE "-Wl,--version-script=${PROJECT_BINARY_DIR}/python/native.map"
                                           -Wl,-Bsymbolic-functions)
if(AUREOLE_SANITIZE)
    target_link_options(aureole-python PRIVATE -fsanitize=address,undefined)
endif()
set_target_properties(aureole-python PROPERTIES PREFIX "" OUTPUT_NAME _native LIBRARY_OUTPUT_DIRECTORY "${python_package}"
                                                SUFFIX "${python_suffix}")

# The modules lie beside the extension, so that PYTHONPATH=build/release/python is the package.
file(GLOB python_modules CONFIGURE_DEPENDS python/aureole/*.py python/aureole/*.pyi python/aureole/py.typed)
foreach(module IN LISTS python_modules)
    get_filename_component(name "${module}" NAME)
    configure_file("${module}" "${python_package}/${name}" COPYONLY)
endforeach()
install(TARGETS aureole-python DESTINATION aureole COMPONENT python EXCLUDE_FROM_ALL)
install(FILES "${library}" DESTINATION aureole COMPONENT python EXCLUDE_FROM_ALL)

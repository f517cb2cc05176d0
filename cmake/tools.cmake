# The bench, and the programs that make scenes.
file(GLOB bench_files CONFIGURE_DEPENDS bench/*.[ch])
aureole_kernels(bench_files "${PROJECT_SOURCE_DIR}")
add_executable(aureole-bench ${bench_files})
# LAPACKE is a limit of the bench and an oracle of the tests; no library of ours needs it. Embree's rays are traced again
# by themselves, and dlsym finds them behind the recorders.
target_link_libraries(aureole-bench PRIVATE aureole_flags aureole_all PkgConfig::LAPACKE)
target_include_directories(aureole-bench PRIVATE "${PROJECT_SOURCE_DIR}") # of its kernels
target_compile_options(aureole-bench PRIVATE -fopenmp-simd) # its pragmas for sums, without OpenMP's threads
set_target_properties(aureole-bench PROPERTIES C_VISIBILITY_PRESET default) # bench/recorder.h
target_compile_definitions(aureole-bench PRIVATE AUR_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
foreach(file IN LISTS bench_files)
    if(file MATCHES "_avx2\\.c$")
        set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma;-ffp-contract=fast")
    elseif(file MATCHES "_avx512\\.c$")
        set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS
            "-mavx512f;-mavx2;-mfma;-mprefer-vector-width=512;-ffp-contract=fast")
    endif()
endforeach()

# The programs that make the meshes of the bundled scenes. The meshes are small and committed, so that a scene renders
# without a build tree; the target makes them again, and a test compares the two.
foreach(maker teapot keller)
    add_executable(${maker} scenes/${maker}.c scenes/make/teapot_patches.c scenes/make/solids.c)
    target_link_libraries(${maker} PRIVATE aureole_flags aureole aureole_helpers_of_points Embree::Embree m)
endforeach()
add_custom_target(scene-meshes COMMAND teapot "${PROJECT_SOURCE_DIR}/scenes/cornell-box/meshes/teapot.obj"
                               COMMAND keller "${PROJECT_SOURCE_DIR}/scenes/keller" VERBATIM)

# The larger meshes and the environments are made at first use, by scripts/scenes.sh.
file(GLOB make_files CONFIGURE_DEPENDS scenes/make/*.[ch])
add_executable(aureole-scenes ${make_files})
target_link_libraries(aureole-scenes PRIVATE aureole_flags aureole-render aureole_helpers_of_points Embree::Embree m)
target_compile_definitions(aureole-scenes PRIVATE AUR_SCENES_FOLDER="${PROJECT_SOURCE_DIR}/scenes")

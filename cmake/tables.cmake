# Tables of numbers. Each data/NAME.txt, whose head says on lines that begin with # what it holds, becomes NAME.inc, the text of a C
# initialiser: a line with several numbers is a row in braces.
file(GLOB data_files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/data/*.txt")
foreach(file IN LISTS data_files)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
    file(STRINGS "${file}" rows REGEX "^[^#]")
    list(TRANSFORM rows REPLACE " +" ", ")
    list(TRANSFORM rows REPLACE "^.*, .*$" "{\\0}")
    list(JOIN rows ",\n" rows)
    get_filename_component(name "${file}" NAME_WE)
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/data/${name}.inc" CONTENT "${rows},\n" @ONLY)
endforeach()
target_include_directories(aureole_flags INTERFACE "${PROJECT_BINARY_DIR}")

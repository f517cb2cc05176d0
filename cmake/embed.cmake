# Writes OUTPUT, a C file with the content of FILES as the array ARRAY of report_asset (src/program/report/page/page.h) that HEADER declares:
# cmake -DOUTPUT=... -DHEADER=... -DARRAY=... -DFILES=a;b -P embed.cmake
set(arrays)
set(rows)
set(index 0)
foreach(file IN LISTS FILES)
    file(READ "${file}" content HEX)
    string(REGEX REPLACE "(..)" "0x\\1," content "${content}")
    get_filename_component(name "${file}" NAME)
    string(APPEND arrays "static const unsigned char asset_${index}[] = {${content}};\n")
    string(APPEND rows "    {\"${name}\", sizeof asset_${index}, asset_${index}},\n")
    math(EXPR index "${index} + 1")
endforeach()
file(WRITE "${OUTPUT}" "#include \"${HEADER}\"\n\n${arrays}\nconst report_asset ${ARRAY}[] = {\n${rows}    {0},\n};\n")

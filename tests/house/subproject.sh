#!/usr/bin/env bash
# As a part of another CMake project the tree is its libraries alone, under the names that an installed one has. It is configured here;
# building it is what the release build does.
set -u
source_tree=$2
mkdir -p project
echo 'int main(void) { return 0; }' >project/main.c
cat >project/CMakeLists.txt <<CMAKE
cmake_minimum_required(VERSION 3.22)
project(mine LANGUAGES C)
set(AUREOLE_RENDER OFF)
set(BUILD_SHARED_LIBS OFF)
add_subdirectory("$source_tree" aureole)
add_executable(mine main.c)
target_link_libraries(mine PRIVATE Aureole::aureole)
CMAKE
cmake -S project -B made -G Ninja >log 2>&1 || { cat log; exit 1; }
ninja -C made -t targets all >targets || exit 1
grep -q '^aureole/libaureole\.a:' targets || { echo "no static library"; exit 1; }
grep -E '^aureole/(tests|fuzz|bench)/|aureole-program' targets && { echo "more than the libraries is built"; exit 1; }
exit 0

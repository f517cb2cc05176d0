#!/usr/bin/env bash
# The program without the renderer links libaureole and the C library alone, and has the commands of points; commands of libraries
# that a program is built without say so. Both are also configured as a user configures them.
set -u
build=$(dirname "$1")
source_tree=$2
status=0
fail() { echo "$*"; status=1; }
points=$build/tests/program_of_points render=$build/tests/program_of_render

libraries() { readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -v '^lib\(c\|m\|asan\|ubsan\|tsan\)\.so' | sort | paste -sd' '; }
if [ -e "$build/libaureole.so" ]; then
  [ "$(libraries "$points")" = libaureole.so.1 ] || fail "the program of points needs $(libraries "$points")"
  libraries "$render" | grep -q lighting && fail "the program of the renderer needs $(libraries "$render")"
fi

aureole=$1
printf "u,v\n0.5,0.25\n" >queries.csv
for arguments in "sets" "points sobol -n 16" "points spherical-fibonacci -n 9 --domain sphere --format svg" "measure sobol -n 64 -m l2-star" \
  "weights spherical-fibonacci -n 32 --lobe cosine" "nearest sobol -n 8 queries.csv" "voronoi spherical-fibonacci -n 12"; do
  # shellcheck disable=SC2086 # words
  "$points" $arguments >part.txt 2>part.err
  part=$?
  # shellcheck disable=SC2086
  "$aureole" $arguments >whole.txt 2>whole.err
  [ $? = $part ] && cmp -s part.txt whole.txt && [ -s part.txt ] || fail "$arguments: the program of points says $(cat part.err)"
done
"$points" points sobol -n 4 -o points.csv && "$points" info points.csv | grep -q square || fail "points are not described"

# says PROGRAM LIBRARY ARGUMENTS: refused, and the message names the library.
says() {
  "$1" "${@:3}" >said 2>&1
  [ $? = 2 ] && grep -q "$2, which this program was built without" said || fail "$1 ${*:3} says: $(cat said)"
}
for command in render merge compare convert view; do says "$points" libaureole-render $command --spp 4 scene.xml; done
for command in irradiance viewfactors lab; do
  says "$points" libaureole-lighting $command
  says "$render" libaureole-lighting $command
done
says "$points" libaureole-render points sobol -n 4 --warp image.png
says "$points" libaureole-render points sobol -n 4 -o points.png
"$points" help >said && grep -q 'render *(needs libaureole-render)' said || fail "help does not say what is missing"
"$render" render "$source_tree/scenes/cornell-box/cornell-box.xml" -q --width 8 --spp 1 -o part.exr &&
  "$aureole" render "$source_tree/scenes/cornell-box/cornell-box.xml" -q --width 8 --spp 1 -o whole.exr && cmp part.exr whole.exr ||
  fail "the program of the renderer renders something else"

# configure FOLDER TARGET OPTION...
configure() {
  cmake -S "$source_tree" -B "$1" -G Ninja -DAUREOLE_PYTHON=OFF "${@:3}" >log 2>&1 && ninja -C "$1" -t targets all >targets &&
    grep -q "^$2:" targets || fail "${*:3}: $(tail -3 log)"
}
configure points aureole -DAUREOLE_RENDER=OFF -DCMAKE_DISABLE_FIND_PACKAGE_Embree=ON -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON
grep -q 'aureole-render\|aureole_rendering' targets && fail "AUREOLE_RENDER=OFF builds the renderer"
configure tests tests/test_quadrature_exact -DAUREOLE_RENDER=OFF -DAUREOLE_TESTS=ON
grep -q '^tests/test_scene_\|^tests/test_viewfactors' targets && fail "tests of libraries that are not built"
configure render libaureole-render.so -DAUREOLE_LIGHTING=OFF -DAUREOLE_TESTS=ON
grep -q 'aureole-lighting' targets && fail "AUREOLE_LIGHTING=OFF builds lighting"
grep -q '^tests/test_scene_' targets && ! grep -q '^tests/test_viewfactors' targets || fail "AUREOLE_LIGHTING=OFF has other tests"
exit $status

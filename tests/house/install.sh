#!/usr/bin/env bash
# Another project links the installed tree: by CMake's find_package and by pkg-config.
set -eu
build=$(dirname "$1")
[ -e "$build/libaureole.so" ] || { echo "skipped: a static build is no package"; exit 77; }
rm -rf prefix moved module consumer bare bare-prefix
cmake --install "$build" --prefix "$PWD/prefix" >install.log || { cat install.log; exit 1; }
# The tree may be moved after it was installed.
mv prefix moved
prefix=$PWD/moved
version=$("$prefix/bin/aureole" --version)
for script in bash-completion/completions/aureole zsh/site-functions/_aureole fish/vendor_completions.d/aureole.fish; do
  grep -q "completion words" "$prefix/share/$script" || { echo "no completion in share/$script"; exit 1; }
done
for page in man1/aureole.1 man1/aureole-render.1 man5/aureole-scene.5 man7/aureole-names.7; do
  grep -q '^\.TH' "$prefix/share/man/$page" || { echo "no manual page share/man/$page"; exit 1; }
done

# The module of --serve is found from wherever the program is called.
scene=$(realpath "$2/scenes/cornell-box/cornell-box.xml")
(cd / && "$prefix/bin/aureole" render "$scene" --width 8 --spp 1 --serve=0 -o "$OLDPWD/served.exr") 2>served.txt && grep -q 'http://127' served.txt ||
  { cat served.txt; echo "the installed program does not serve"; exit 1; }

# So may the program that reads models.
cat >model.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
 "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
GLTF
if [ -x "$build/aureole-import" ]; then
  (cd / && "$prefix/bin/aureole" info -q "$OLDPWD/model.gltf") >said 2>&1 && grep -q '^triangles  *1$' said ||
    { echo "the installed program does not read a model: $(cat said)"; exit 1; }
fi

mkdir consumer
cat >consumer/consumer.c <<'C'
#include <aureole-lighting/daylight.h>
#include <aureole-render/render.h>
#include <aureole/image.h> /* the old name */
#include <aureole/sphere.h>
#include <stdio.h>

int main(void) {
    printf("aureole %s\n", aur_version());
    return aur_set_at(aur_set_count()) != NULL || aur_reflected_name(AUR_REFLECTED_BY_PATHS) == NULL;
}
C
cat >consumer/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(consumer LANGUAGES C)
find_package(aureole 0.2 REQUIRED)
add_executable(consumer consumer.c)
target_link_libraries(consumer PRIVATE Aureole::lighting)
CMAKE
cmake -S consumer -B consumer/build -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >cmake.log 2>&1 || { cat cmake.log; exit 1; }
cmake --build consumer/build >cmake.log 2>&1 || { cat cmake.log; exit 1; }
[ "$(consumer/build/consumer)" = "$version" ] || { echo "the CMake consumer does not run"; exit 1; }
# Every header of every library compiles by itself, those under old names too.
for header in "$prefix"/include/*/*.h; do
  printf '#include "%s"\n' "$header" | cc -std=c17 -fsyntax-only -I"$prefix/include" -x c - || { echo "$header does not compile"; exit 1; }
done


# Whether find_package takes components: finds PREFIX COMPONENT...
finds() {
  local folder=$1
  shift
  rm -rf finder
  mkdir finder
  printf 'cmake_minimum_required(VERSION 3.22)\nproject(finder LANGUAGES C)\nfind_package(Threads)\nfind_package(aureole 0.2 REQUIRED COMPONENTS %s)\n' \
    "$*" >finder/CMakeLists.txt
  cmake -S finder -B finder/build -G Ninja -DCMAKE_PREFIX_PATH="$folder" >finder/log 2>&1
}
# A module of the lab, by both ways.
mkdir module && cp "$2"/examples/lab/* module/
cmake -S module -B module/build -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >cmake.log 2>&1 && cmake --build module/build >>cmake.log 2>&1 ||
  { cat cmake.log; echo "the lab's module does not compile"; exit 1; }
# shellcheck disable=SC2046 # the flags are words
cc -std=c17 -shared -fPIC module/custom_experiment.c $(PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name aureole-lab.pc)") pkg-config --cflags aureole-lab) \
  -lm -o module/by-pkg-config.so || { echo "the lab's module does not compile by pkg-config"; exit 1; }
for module in module/build/custom_experiment.so module/by-pkg-config.so; do
  "$prefix/bin/aureole" lab run custom-distances -q --module "$module" -o module/results >module.txt 2>&1 && grep -q ': holds' module.txt ||
    { cat module.txt; echo "$module does not run"; exit 1; }
done
finds "$prefix" aureole render lighting lab || { cat finder/log; echo "a component is not found"; exit 1; }
finds "$prefix" aureole nonsense && { echo "the component 'nonsense' is found"; exit 1; }
# Without the renderer its component is not found, and every header that is installed can be compiled and linked.
cmake -S "$2" -B bare -G Ninja -DAUREOLE_RENDER=OFF -DAUREOLE_PROGRAM=OFF -DAUREOLE_TESTS=OFF -DAUREOLE_PYTHON=OFF -DCMAKE_BUILD_TYPE=Release >cmake.log 2>&1 &&
  cp -P "$build"/libaureole.so* bare/ && cmake --install bare --prefix "$PWD/bare-prefix" >>cmake.log 2>&1 || { cat cmake.log; exit 1; }
finds "$PWD/bare-prefix" aureole || { cat finder/log; echo "libaureole alone is not found"; exit 1; }
finds "$PWD/bare-prefix" lighting && { echo "the component 'lighting' is found where there is no renderer"; exit 1; }
finds "$PWD/bare-prefix" render && { echo "the component 'render' is found where there is no renderer"; exit 1; }
grep -q "component 'render' was not built" finder/log || { cat finder/log; echo "the missing component is not named"; exit 1; }
nm -D --defined-only "$build/libaureole.so" | sed 's/.* //; s/@.*//' | sort >known
for header in bare-prefix/include/aureole/*.h; do
  grep -v '^ *\*\|^/\*' "$header" | grep -o '^AUR_[A-Z]* [^(]*\baur_[a-z0-9_]*(' | grep -o 'aur_[a-z0-9_]*(' | tr -d '(' | sort -u | comm -23 - known >missing
  [ ! -s missing ] || { echo "$header has functions that libaureole lacks:"; cat missing; exit 1; }
  echo "#include <aureole/$(basename "$header")>" | cc -std=c17 -fsyntax-only -Ibare-prefix/include -x c - || exit 1
done
[ "$(ls bare-prefix/include/aureole/*.h | wc -l)" -ge 15 ] || { echo "headers of libaureole are missing"; exit 1; }
[ ! -e bare-prefix/include/aureole-render ] && [ ! -e bare-prefix/include/aureole/image.h ] || { echo "headers of the renderer are installed without it"; exit 1; }
[ ! -e bare-prefix/bin ] || { echo "a program is installed"; exit 1; }

export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name aureole-render.pc)")
[ "aureole $(pkg-config --modversion aureole-render)" = "$version" ]
sanitizers=()
nm -D "$(find "$prefix" -name 'libaureole.so.1')" | grep -q __asan_init && sanitizers=(-fsanitize=address,undefined)
libraries=$(pkg-config --variable=libdir aureole)
# shellcheck disable=SC2046 # the flags are words
cc "${sanitizers[@]}" consumer/consumer.c -o consumer/by-pkg-config $(pkg-config --cflags --libs aureole-lighting)
[ "$(LD_LIBRARY_PATH=$libraries consumer/by-pkg-config)" = "$version" ] || { echo "the pkg-config consumer does not run"; exit 1; }

# The README's example is compiled as it stands, and prints what the README says.
block() { awk -v mark="$1" '$0 == "```" { inside = 0 } inside { print } $0 == "```" mark { inside = 1 }' "$2/README.md"; }
block c "$2" >consumer/example.c
block text "$2" >consumer/expected
[ -s consumer/example.c ] && [ -s consumer/expected ] || { echo "README.md has lost its example"; exit 1; }
# shellcheck disable=SC2046
cc -std=c17 -Wall -Wextra -Wpedantic -Werror "${sanitizers[@]}" consumer/example.c -o consumer/example \
  $(pkg-config --cflags --libs aureole)
LD_LIBRARY_PATH=$libraries consumer/example >consumer/printed
diff consumer/expected consumer/printed || { echo "README.md's example prints something else"; exit 1; }

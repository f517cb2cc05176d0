#!/usr/bin/env bash
# Another project links the installed tree: by CMake's find_package and by pkg-config.
set -eu
build=$(dirname "$1")
[ -e "$build/libaureole.so" ] || { echo "skipped: a static build is no package"; exit 77; }
rm -rf prefix moved consumer
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

mkdir consumer
cat >consumer/consumer.c <<'C'
#include <aureole/render.h>
#include <aureole/sphere.h>
#include <stdio.h>

int main(void) {
    printf("aureole %s\n", aur_version());
    return aur_set_at(aur_set_count()) != NULL;
}
C
cat >consumer/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(consumer LANGUAGES C)
find_package(aureole 0.1 REQUIRED)
add_executable(consumer consumer.c)
target_link_libraries(consumer PRIVATE Aureole::render)
CMAKE
cmake -S consumer -B consumer/build -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >cmake.log 2>&1 || { cat cmake.log; exit 1; }
cmake --build consumer/build >cmake.log 2>&1 || { cat cmake.log; exit 1; }
[ "$(consumer/build/consumer)" = "$version" ] || { echo "the CMake consumer does not run"; exit 1; }

export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name aureole-render.pc)")
[ "aureole $(pkg-config --modversion aureole-render)" = "$version" ]
sanitizers=()
nm -D "$(find "$prefix" -name 'libaureole.so.0')" | grep -q __asan_init && sanitizers=(-fsanitize=address,undefined)
libraries=$(pkg-config --variable=libdir aureole)
# shellcheck disable=SC2046 # the flags are words
cc "${sanitizers[@]}" consumer/consumer.c -o consumer/by-pkg-config $(pkg-config --cflags --libs aureole-render)
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

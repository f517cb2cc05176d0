#!/usr/bin/env bash
# What the libraries show: every function of the public headers, each in one library, in the version that stays or, where it is
# experimental, in one of this release; besides those only private names of this release, and none twice. Programs that know the
# public headers alone and are linked with the libraries alone (calls/*.c) call every public function.
set -u
build=$(dirname "$1")
source_tree=$2
[ -e "$build/libaureole.so" ] || { echo "skipped: the libraries are static"; exit 77; }
status=0
release=$(sed -nE 's/#define AUREOLE_VERSION_(MAJOR|MINOR|PATCH) //p' "$source_tree/include/aureole/version.h" | paste -sd.)
shown() {
  sed -n "s/@@$1\$//p" "$library.txt" | sort | diff "$2" - ||
    { echo "$1: < declared and not shown, or > shown twice or declared by no header"; status=1; }
}
for library in aureole aureole-render aureole-lighting; do
  nm -D --defined-only --with-symbol-versions "$build/lib$library.so" | awk '$2 != "A" { print $3 }' >"$library.txt"
  bash "$source_tree/cmake/symbols.sh" "$source_tree/include/$library"/*.h >declared.txt
  bash "$source_tree/cmake/symbols.sh" --experimental "$source_tree/include/$library"/*.h >experimental.txt
  comm -23 declared.txt experimental.txt >stable.txt
  cat declared.txt >>public.txt
  node=${library^^} node=${node//-/_}
  shown "${node}_1" stable.txt
  shown "${node}_EXPERIMENTAL_$release" experimental.txt
  grep -vE "^aur_[a-z0-9_]+@@${node}_(1|EXPERIMENTAL_$release|PRIVATE_$release)$" "$library.txt" && { echo "names that are not the library's own"; status=1; }
done
[ "$(wc -l <public.txt)" -gt 250 ] || { echo "only $(wc -l <public.txt) public functions were read"; exit 1; }
cat aureole.txt aureole-render.txt aureole-lighting.txt >shown.txt
sed 's/@.*//' shown.txt | sort | uniq -d | grep . && { echo "two libraries have these"; status=1; }

# A private name is one that another library needs, or the module of ranks.
nm -D --undefined-only "$build"/libaureole-{render,lighting}.so | awk '{ sub(/@.*/, "", $NF); print $NF }' >needed.txt
grep -ohE '\baur_[a-z0-9_]+\b' "$source_tree"/src/program/mpi/*.c >>needed.txt
sort -u -o needed.txt needed.txt
sed -n 's/@@AUREOLE_[A-Z_]*PRIVATE_.*//p' aureole.txt aureole-render.txt aureole-lighting.txt | sort | comm -23 - needed.txt | grep . &&
  { echo "these are AUR_INTERNAL, and no other library needs them"; status=1; }

# Every struct of options has a function that fills its defaults, which bindings can call: no inline code does.
while read -r name; do
  grep -qrE "\b${name}_init\(" "$source_tree/include" || { echo "no function fills $name"; status=1; }
done < <(grep -rhA1 -E '^typedef struct aur_[a-z0-9_]*_options\b' "$source_tree"/include/*/*.h | grep -B1 'size_t size;' | sed -n 's/^typedef struct \(aur_[a-z0-9_]*\).*/\1/p')
grep -rnE '^static inline aur_.*_(default|options)\(' "$source_tree"/include/*/*.h && { echo "defaults in inline code"; status=1; }

# Besides them the program does, which is a client of the public headers too, and the tests of two rooms.
while read -r name; do
  grep -qE "\b$name\(" "$source_tree"/tests/house/calls/*.c \
    "$source_tree"/src/program/cli/{,*/}*.c "$source_tree"/lab/gathering/*.c "$source_tree"/tests/{points/quadrature,lighting}/*.c ||
    { echo "no program calls $name"; status=1; }
done <public.txt
cc=$(sed -n 's/^CMAKE_C_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")
flags=$(sed -n 's/^AUREOLE_SANITIZE:[^=]*=\([a-z][a-z,]*\)$/-fsanitize=\1/p' "$build/CMakeCache.txt")
for program in core points light; do
  "$cc" -std=c17 -D_POSIX_C_SOURCE=200809L -Wall -Wextra -Werror $flags -I "$source_tree/include" \
    "$source_tree/tests/house/calls/$program.c" -o "$program" -L "$build" -laureole-lighting -laureole-render -laureole -lm \
    -Wl,-rpath,"$build" || exit 1
  ./"$program" || { echo "calls/$program.c failed"; status=1; }
done
exit $status

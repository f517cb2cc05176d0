#!/usr/bin/env bash
# The C++ headers compile without a warning as C++17 and C++20, and their numbers, errors and exceptions are those of the libraries.
set -u
build=$(dirname "$1")
source_tree=$2
[ -e "$build/libaureole.so" ] || { echo "skipped: the libraries are static"; exit 77; }
flags=$(sed -n 's/^AUREOLE_SANITIZE:[^=]*=\([a-z][a-z,]*\)$/-fsanitize=\1/p' "$build/CMakeCache.txt")
status=0
while read -r compiler standard program; do
  command -v "$compiler" >/dev/null || { echo "no $compiler here"; continue; }
  [ -n "$flags" ] && [ "$compiler" != g++ ] && continue # sanitizers are those of the compiler that built the libraries
  "$compiler" -std="$standard" -Wall -Wextra -Wpedantic -Wshadow -Werror $flags -I "$source_tree/include" \
    "$source_tree/tests/house/header_cxx/$program.cpp" -o "$program" -L "$build" -laureole-lighting -laureole-render -laureole -Wl,-rpath,"$build" &&
    ./"$program" "$source_tree/scenes/cornell-box/cornell-box.xml" || { echo "$compiler -std=$standard $program"; status=1; }
done <<'END'
g++ c++17 points
clang++ c++20 points
g++ c++20 image
END
exit $status

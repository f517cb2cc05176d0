#!/usr/bin/env bash
# aureole_sampling.h is what scripts/single_header.py makes of the sources, compiles alone without a warning as C99, C11, C++11 and
# C++17 by each compiler that there is, and has the library's points.
set -u
build=$(dirname "$1")
source_tree=$2
status=0
if command -v clang-format-14 >/dev/null; then
  python3 "$source_tree/scripts/single_header.py" made.h && diff "$source_tree/include/aureole_sampling.h" made.h ||
    { echo "run scripts/single_header.py"; status=1; }
fi
[ -e "$build/libaureole.so" ] || { echo "skipped: the libraries are static"; exit 77; }
flags=$(sed -n 's/^AUREOLE_SANITIZE:[^=]*=\([a-z][a-z,]*\)$/-fsanitize=\1/p' "$build/CMakeCache.txt")
cp "$source_tree/tests/house/header_single/points.c" points.c
cp points.c points.cpp
printf '#include <aureole_sampling.h>\n' >alone.c
cp alone.c alone.cpp
while read -r compiler standard; do
  command -v "$compiler" >/dev/null || { echo "no $compiler here"; continue; }
  suffix=c
  [ "${standard#c++}" = "$standard" ] || suffix=cpp
  "$compiler" -std="$standard" -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Werror -I "$source_tree/include" -c \
    alone.$suffix -o alone.o || { status=1; continue; }
  # Sanitizers are those of the compiler that built the library.
  [ -n "$flags" ] && [ "$compiler" != gcc ] && continue
  "$compiler" -std="$standard" -O2 -ffp-contract=off -Wall -Wextra -Werror $flags -I "$source_tree/include" points.$suffix -o points \
    -L "$build" -laureole -lm -Wl,-rpath,"$build" && ./points || { echo "$compiler -std=$standard"; status=1; }
done <<'END'
gcc c99
gcc c11
g++ c++17
clang c99
clang++ c++17
END
exit $status

#!/usr/bin/env bash
# Looks for mistakes in the room core, on which all others stand, by other means than the tests' own:
#   scripts/analyse.sh thread|memory|valgrind|analyzer
# thread and memory: clang's sanitizers over the tests of core, compiled with it; valgrind: memcheck over those of
# build/release; analyzer: gcc's -fanalyzer. The memory sanitizer goes no further than core:
# the other rooms need Embree, OpenEXR and expat, which Debian does not have instrumented. Exit status 1 where something is
# found.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export AUREOLE_CACHE=
flags=(-std=c17 -D_POSIX_C_SOURCE=200809L -D_FILE_OFFSET_BITS=64 -Iinclude -Isrc -Itests "-DAUR_SOURCE_DIR=\"$PWD\"")
status=0
case ${1:-} in
  thread | memory)
    sanitize=(-O1 -g "-fsanitize=$1" -ffp-contract=off)
    for file in src/core/*.c; do
      clang "${flags[@]}" "${sanitize[@]}" -c "$file" -o "$folder/$(basename "$file").o" || exit 2
    done
    for test in tests/core/test_*.c; do
      clang "${flags[@]}" "${sanitize[@]}" "$test" "$folder"/*.o -lcmocka -lm -lpthread -ldl -o "$folder/test" || exit 2
      if (cd "$folder" && ./test >said 2>&1); then echo "$(basename "$test" .c): nothing"; else
        status=1
        echo "$(basename "$test" .c):"
        grep -A12 'WARNING: \|FAILED' "$folder/said" | head -30
      fi
    done ;;
  valgrind)
    for test in build/release/tests/test_core_*; do
      if AUREOLE_ISA=avx2 valgrind -q --error-exitcode=9 --leak-check=full "$test" >"$folder/said" 2>&1; then
        echo "$(basename "$test"): nothing"
      else
        status=1
        echo "$(basename "$test"):"
        grep '^==\|FAILED' "$folder/said" | head -30
      fi
    done ;;
  analyzer)
    for file in src/core/*.c; do
      gcc "${flags[@]}" -O1 -fanalyzer -c -o /dev/null "$file" 2>&1 | grep -E 'warning: .*\[-Wanalyzer' && status=1
    done ;;
  *) echo "usage: scripts/analyse.sh thread|memory|valgrind|analyzer" >&2; exit 2 ;;
esac
exit $status

#!/usr/bin/env bash
# Looks for mistakes in the room core, on which all others stand, by other means than the tests' own:
#   scripts/analyse.sh thread|memory|valgrind|analyzer
# thread and memory: clang's sanitizers over the tests of core, compiled with it; valgrind: memcheck over those of
# build/release; analyzer: gcc's -fanalyzer. memory also runs the harnesses of the parsers that stand on core alone, of
# points, generator matrices and weather, on their corpus and 3000 mutations. It goes no further: the other rooms need
# Embree, OpenEXR, expat and LAPACK, which Debian does not have instrumented. Exit status 1 where something is found.
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
    files=(src/core/*.c) harnesses=()
    if [ "$1" = memory ]; then
      harnesses=(points matrices weather)
      sanitize+=(-DAUR_PORTABLE -Ifuzz)
      files+=($(find src/pointset -name '*.c' ! -name '*avx*') src/lighting/daylight/weather.c src/scene/lights/sun_position.c)
      # clang's sanitizer does not know that these functions of new C libraries write.
      for name in fstat64 stat64 lstat64; do
        of='const char *' && [ $name != fstat64 ] || of='int '
        echo "int __real_$name($of, struct stat *); int __wrap_$name($of what, struct stat *status);"
        echo "int __wrap_$name($of what, struct stat *status) { memset(status, 0, sizeof *status); return __real_$name(what, status); }"
        sanitize+=("-Wl,--wrap=$name")
      done >"$folder/wrap.c"
      cat >>"$folder/wrap.c" <<'C'
int __real_fstatat64(int folder, const char *path, struct stat *status, int flags);
int __wrap_fstatat64(int folder, const char *path, struct stat *status, int flags);
int __wrap_fstatat64(int folder, const char *path, struct stat *status, int flags) {
    memset(status, 0, sizeof *status);
    return __real_fstatat64(folder, path, status, flags);
}
C
      sed -i '1i #include <string.h>\n#include <sys/stat.h>' "$folder/wrap.c"
      sanitize+=(-Wl,--wrap=fstatat64)
      files+=("$folder/wrap.c")
    fi
    for file in "${files[@]}"; do
      clang "${flags[@]}" "${sanitize[@]}" -Wno-unused-command-line-argument -c "$file" \
        -o "$folder/$(tr / _ <<<"$file").o" || exit 2
    done
    for name in "${harnesses[@]}"; do
      clang "${flags[@]}" "${sanitize[@]}" "fuzz/fuzz_$name.c" fuzz/driver.c "$folder"/*.o -lm -lpthread -ldl -o "$folder/test" ||
        exit 2
      if (cd "$folder" && ./test --runs 3000 --dictionary "$OLDPWD/fuzz/keys.dict" "$OLDPWD"/fuzz/corpus/"$name"/* >said 2>&1); then
        echo "fuzz_$name: nothing"
      else
        status=1
        echo "fuzz_$name:"
        grep -A12 'WARNING: \|fuzz:' "$folder/said" | head -30
      fi
    done
    for test in tests/core/test_*.c; do
      clang "${flags[@]}" "${sanitize[@]}" "$test" "$folder"/*.o -lcmocka -lm -lpthread -ldl -o "$folder/test" 2>"$folder/said" ||
        { grep -q 'undefined reference' "$folder/said" && echo "$(basename "$test" .c): asks other rooms, not tried" && continue
          cat "$folder/said" >&2; exit 2; }
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

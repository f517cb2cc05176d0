#!/usr/bin/env bash
# Looks for mistakes by other means than the tests' own, and prints what it found; exit status 1 where that is something.
#   scripts/analyse.sh thread [ROOM...]     the tests under clang's thread sanitizer (preset tsan, or the folder BUILD), room by room
#   scripts/analyse.sh memory               clang's memory sanitizer, see below
#   scripts/analyse.sh valgrind [ROOM...]   memcheck over unit tests of build/release: core, points, measures and weights
#   scripts/analyse.sh analyzer [FILE...]   gcc's -fanalyzer over src/
#   scripts/analyse.sh tidy [FILE...]       clang-tidy over src/, with the checks of .clang-tidy
# memory compiles the tests of core, and the harnesses of the parsers that stand on core alone (points, generator matrices
# and weather), which are run on their corpus and 3000 mutations. It goes no further: the other rooms need
# Embree, OpenEXR, expat and LAPACK, which Debian does not have instrumented.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export AUREOLE_CACHE=
flags=(-std=c17 -D_POSIX_C_SOURCE=200809L -D_FILE_OFFSET_BITS=64 -Iinclude -Isrc -Itests -Ibuild/release "-DAUR_SOURCE_DIR=\"$PWD\"")
status=0
# Analysers read one file at a time, so they are told that functions that make errors never return AUR_OK: $folder/told.h.
tell() {
    cat >"$folder/told.h" <<'C'
#include "points/base/error.h"
static inline aur_result aur_told(aur_result result) {
    if (result == AUR_OK)
        __builtin_unreachable();
    return result;
}
#define aur_fail(...) aur_told(aur_fail(__VA_ARGS__))
#define aur_fail_at(...) aur_told(aur_fail_at(__VA_ARGS__))
#define aur_fail_memory(...) aur_told(aur_fail_memory(__VA_ARGS__))
#define aur_fail_memory_at(...) aur_told(aur_fail_memory_at(__VA_ARGS__))
C
}
verb=${1:-}
shift
case $verb in
  thread)
    build=$(realpath -m "${BUILD:-build/tsan}")
    cmake --preset tsan -B "$build" --log-level=ERROR >/dev/null && cmake --build "$build" >"$folder/said" || { tail "$folder/said"; exit 2; }
    [ $# -gt 0 ] || set -- $(ctest --test-dir "$build" -N | sed -n 's|.*: \([a-z]*\)/.*|\1|p' | sort -u)
    echo '| room | tests | of these failed or too slow | complaints |'
    echo '|---|---|---|---|'
    # Reports go to files, since many tests look at what the program says or do not show it.
    export TSAN_OPTIONS="ignore_noninstrumented_modules=1 log_path=$folder/report exitcode=0"
    for room in "$@"; do
      ctest --test-dir "$build" -R "^$room/" --timeout "${TIMEOUT:-600}" </dev/null >"$folder/said" 2>&1
      complaints=$(cat "$folder"/report.* 2>/dev/null | grep -c 'WARNING: ThreadSanitizer')
      failed=$(sed -n 's|^ *[0-9]* - \([^ ]*\) (.*|\1|p' "$folder/said" | paste -sd ' ')
      printf '| %s | %d | %s | %d |\n' "$room" "$(grep -c 'Test *#' "$folder/said")" "$failed" "$complaints"
      [ "$complaints" = 0 ] && [ -z "$failed" ] || status=1
      cat "$folder"/report.* 2>/dev/null | grep -A14 'WARNING: ThreadSanitizer' | head -60 >&2
      rm -f "$folder"/report.*
    done ;;
  memory)
    sanitize=(-O1 -g -fsanitize=memory -ffp-contract=off -DAUR_PORTABLE -Ifuzz)
    harnesses=(points matrices weather)
    files=(src/points/base/*.c $(find src/points/pointset -name '*.c') src/lighting/daylight/weather.c src/render/scene/lights/sun_position.c)
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
    for test in tests/points/base/test_*.c; do
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
    [ $# -gt 0 ] || set -- core pointset sphere quality quadrature
    # valgrind computes long double in double: tests whose oracle it is fail, and leak what they leave on the way out. Of those
    # reads and writes count alone.
    echo '| room | tests | complaints | took too long | failed |'
    echo '|---|---|---|---|---|'
    for room in "$@"; do
      tests=0 complaints=0 slow=0 failed=0
      for test in build/release/tests/test_"$room"_*; do
        for leaks in full no; do
          AUREOLE_SHORT_TESTS=1 AUREOLE_ISA=avx2 timeout "${TIMEOUT:-600}" \
            valgrind -q --error-exitcode=9 --leak-check=$leaks "$test" >"$folder/said" 2>&1
          result=$?
          grep -q '^\[  FAILED  \]' "$folder/said" || break
        done
        [ $leaks = full ] || failed=$((failed + 1))
        tests=$((tests + 1))
        [ $result != 124 ] || slow=$((slow + 1))
        [ $result != 9 ] || { complaints=$((complaints + 1)); echo "$test:" >&2; grep '^==' "$folder/said" | head -30 >&2; }
      done
      echo "| $room | $tests | $complaints | $slow | $failed |"
      [ $complaints = 0 ] || status=1
    done ;;
  analyzer)
    # Two warnings are off: it takes loops of three for ones that may be left before, and their arrays for unset (valgrind and the
    # memory sanitizer look for such), and shifts of vectors for those of single bits. What it says of sound places stands in
    # analyzer.txt: file, function, warning, and why it is none.
    tell
    flags+=(-O1 -fanalyzer -Wno-analyzer-use-of-uninitialized-value
            -Wno-analyzer-shift-count-overflow -c -o /dev/null $(pkg-config --cflags expat stb mpi assimp OpenEXR))
    [ $# -gt 0 ] || set -- $(find src -name '*.c' | sort)
    for file in "$@"; do
      told=(-include "$folder/told.h")
      [ "$file" != src/points/base/error.c ] || told=()
      told+=($(sed -nE 's/^#define (_[A-Z]+_SOURCE) *([0-9]*).*/-D\1=\2/p' "$file"))
      LC_ALL=C gcc "${flags[@]}" "${told[@]}" "$file" 2>&1 | awk '
        /: In function / { split($0, part, "\x27"); f = part[2] }
        /(error|warning): / { kind = $NF; gsub(/^\[-Wanalyzer-|\]$/, "", kind); print name, f == "" ? "?" : f, kind, $0 }' name="$file"
    done | sort -u >"$folder/said"
    while read -r file function kind words; do
      grep -qF "$file $function $kind:" scripts/analyzer.txt || { echo "$file: $words (in $function)"; status=1; }
    done <"$folder/said"
    echo "$# files, $(wc -l <"$folder/said") warnings, $(grep -c '^src' scripts/analyzer.txt) explained in scripts/analyzer.txt" ;;
  tidy)
    # What it says of sound places stands in tidy.txt: file, check, and why it is no mistake.
    [ $# -gt 0 ] || set -- $(find src -name '*.c' | sort)
    tell
    clang-tidy --version | sed -n 's/.*LLVM version/clang-tidy/p'
    export told=$folder/told.h
    printf '%s\n' "$@" | xargs -P "$(nproc)" -n 1 bash -c '
      [ "$0" = src/points/base/error.c ] || tell=(--extra-arg=-include --extra-arg="$told")
      clang-tidy -p build/release --quiet "${tell[@]}" "$0" 2>/dev/null' |
      grep -E '(warning|error): ' | sed "s|^$PWD/||" | sort -u >"$folder/said"
    while read -r line; do
      check=${line##*[}
      grep -qF "${line%%:*} ${check%]}:" scripts/tidy.txt || { echo "$line"; status=1; }
    done <"$folder/said"
    echo "$# files, $(wc -l <"$folder/said") warnings, $(grep -c '^src' scripts/tidy.txt) explained in scripts/tidy.txt" ;;
  *) sed -n '2,8p' "$0" >&2; exit 2 ;;
esac
exit $status

#!/usr/bin/env bash
# Set-up, release and sanitizer builds, and every test in both. The first and only command after a clone.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/deps.sh --all
jobs=$(nproc)
for preset in release asan; do
  echo "== build, $preset"
  cmake --preset "$preset" --log-level=WARNING
  cmake --build --preset "$preset" -j "$jobs"
done

# test_preset PRESET: ctest, whose closing lines come last; before them the tests that were skipped, and why.
test_preset() {
  local closing=build/$1/closing.txt code=0
  : >"$closing"
  ctest --preset "$1" -j "$jobs" </dev/null |
    awk -v closing="$closing" '/^[0-9]+% tests passed/ { closes = 1 } closes { print >closing; next } { print; fflush() }' || code=$?
  awk 'FNR == NR { if ($NF == "(Skipped)") skipped[$3] = "no reason given"; next }
       / Testing: / { name = $NF } /^skipped: / && name in skipped { skipped[name] = substr($0, 10) }
       END { for (name in skipped) print name ": " skipped[name] }' "$closing" "build/$1/Testing/Temporary/LastTest.log" |
    sort >"build/$1/skipped.txt"
  sed 's/^/not tested: /' "build/$1/skipped.txt"
  cat "$closing"
  return "$code"
}
# Sanitizers leave out what the release build is asked, which may leave out three tests for want of what Debian's packages lack.
for preset in asan release; do
  echo "== tests, $preset"
  test_preset "$preset"
done
[ "$(wc -l <build/release/skipped.txt)" -le 3 ] || { echo "check.sh: more than three tests were skipped" >&2; exit 1; }

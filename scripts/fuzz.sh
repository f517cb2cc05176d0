#!/usr/bin/env bash
# Minutes of libFuzzer for each harness, as a table: scripts/fuzz.sh MINUTES [HARNESS...], after
#   cmake --preset fuzz && cmake --build --preset fuzz --target fuzzers
# What it finds is kept in build/fuzz/found/HARNESS and is where the next call goes on from; FRESH=1 scripts/coverage.sh
# takes from there what reaches more than fuzz/corpus does. Exit status 1 where a harness complains: the input lies in build/fuzz/wrong.
set -euo pipefail
cd "$(dirname "$0")/.."
top=$PWD
build=$top/build/fuzz
[ $# -gt 0 ] || { echo "usage: scripts/fuzz.sh MINUTES [HARNESS...]" >&2; exit 2; }
seconds=$(awk "BEGIN { printf \"%d\", 60 * $1 }")
shift
harnesses=("$@")
[ $# -gt 0 ] || for file in "$build"/fuzz/fuzz_*; do [ -f "$file" ] && harnesses+=("${file##*/fuzz_}"); done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$build/wrong"
cd "$scratch"
export AUREOLE_CACHE= ASAN_OPTIONS=allocator_may_return_null=1 LLVM_PROFILE_FILE=/dev/null
status=0
echo '| harness | executions | seconds | edges reached | inputs kept | complaints |'
echo '|---|---|---|---|---|---|'
for name in "${harnesses[@]}"; do
  program=$build/fuzz/fuzz_$name found=$build/found/$name
  mkdir -p "$found"
  AUREOLE_FUZZ_SEEDS=$found "$program" >/dev/null 2>&1 || { echo "fuzz.sh: $program does not run" >&2; exit 2; }
  folders=("$found")
  [ -d "$top/fuzz/corpus/$name" ] && folders+=("$top/fuzz/corpus/$name")
  "$program" -max_total_time="$seconds" -dict="$top/fuzz/keys.dict" -timeout=60 -rss_limit_mb=6000 -max_len=8192 \
    -print_final_stats=1 -artifact_prefix="$build/wrong/$name-" "${folders[@]}" >said 2>&1 && wrong=0 || wrong=1
  [ "$wrong" = 0 ] || { status=1; grep -m3 'ERROR\|runtime error\|^fuzz:' said >&2 || tail -3 said >&2; }
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' said)
  last=$(grep -o 'cov: [0-9]*' said | tail -1 || true)
  echo "| $name | ${runs:-0} | $seconds | ${last#cov: } | $(find "$found" -type f | wc -l) | $wrong |"
done
exit $status

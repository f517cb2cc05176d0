#!/usr/bin/env bash
# report.sh RESULTS: keeps the tables of a full run of the lab (AUREOLE_ISA=avx2 aureole lab run NAME... -o RESULTS) in
# docs/report/results, which aureole lab check compares runs with: the tables in NAME, those of the quick form, which it runs by the
# program of build/release, in NAME/quick unless they are equal, and NAME-stamp.csv by lab_stamps.py. Times and images stay in RESULTS;
# the pages of the papers take their plots from there by papers_figures.sh, and their numbers by lab_numbers.py fill.
# report.sh --quick NAME...: keeps the quick forms alone, where the full form takes too long for now, and marks the tables as outdated.
set -eu
quick=$(mktemp -d)
trap 'rm -rf "$quick"' EXIT
names=()
if [ "$1" = --quick ]; then
  names=("${@:2}")
else
  results=$(realpath "$1")
  for folder in "$results"/*/; do
    name=$(basename "$folder")
    names+=("$name")
    grep -qs ' full form, set none, rows all' "$folder$name-run.csv" ||
      { echo "report.sh: $folder is no finished full run: aureole lab run $name -o $results" >&2; exit 2; }
    grep -q 'left out, scripts/scenes.sh' "$folder$name.csv" &&
      { echo "report.sh: $folder lacks scenes: scripts/scenes.sh, then aureole lab run $name -o $results" >&2; exit 2; }
  done
fi
cd "$(dirname "$0")/.."

# tables FOLDER NAME: those that are the same in every run.
tables() {
  find "$1/$2" -maxdepth 1 -name "$2*.csv" ! -name "$2-run.csv" ! -name "$2-timings.csv" ! -name "$2-pictures.csv"
}
AUREOLE_ISA=avx2 build/release/aureole lab run "${names[@]}" --quick -q -o "$quick" >/dev/null
for name in "${names[@]}"; do
  kept=docs/report/results/$name
  mkdir -p "$kept"
  if [ -n "${results:-}" ]; then
    rm -f "$kept"/*.csv
    tables "$results" "$name" | xargs -r cp -t "$kept"
  fi
  rm -rf "$kept/quick"
  tables "$quick" "$name" | while read -r table; do
    cmp -s "$table" "$kept/$(basename "$table")" && continue
    mkdir -p "$kept/quick"
    cp "$table" "$kept/quick"
  done
done
how=--outdated
[ -z "${results:-}" ] || how=--write
python3 scripts/lab_stamps.py $how "${names[@]}"

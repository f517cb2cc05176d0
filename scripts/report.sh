#!/usr/bin/env bash
# report.sh RESULTS: copies the tables of a full run of the lab (lab run --all -o RESULTS) to docs/report/results. They are the same to the
# bit in every run. Times and pictures stay in RESULTS; the pages of the papers take theirs from there by papers_pictures.sh.
set -eu
results=$(realpath "$1")
cd "$(dirname "$0")/../docs/report"
for folder in "$results"/*/; do
  name=$(basename "$folder")
  if ! grep -qs ' full form, set none, rows all' "$folder$name-run.csv"; then
    echo "report.sh: $folder is no finished full run: aureole lab run $name -o $results" >&2
    exit 2
  fi
done
for folder in "$results"/*/; do
  name=$(basename "$folder")
  rm -rf "results/$name"
  mkdir -p "results/$name"
  for table in "$folder$name"*.csv; do
    case ${table#"$folder$name"} in
    -run.csv | -timings.csv | -pictures.csv) ;;
    *) cp "$table" "results/$name" ;;
    esac
  done
done

#!/usr/bin/env bash
# papers_figures.sh PROGRAM RESULTS...: brings the plots and images that the pages in docs/papers show, from folders of results of the
# lab (lab run -o RESULTS). A page names what it shows by its link: pictures/NAME.svg is a plot of the report, pictures/NAME.png a
# image of an experiment, blanks and the like in its name as in the results. Those that are in no folder stay as they are.
set -eu
program=$(realpath "$1")
shift
folders=()
for results in "$@"; do folders+=("$(realpath "$results")"); done
cd "$(dirname "$0")/../docs/papers"
report=$(mktemp -d)
trap 'rm -rf "$report"' EXIT
for results in "${folders[@]}"; do
  "$program" lab report "$results" -o "$report" >/dev/null
  for link in $(grep -ohE 'pictures/[^) ]+\.(svg|png)' ./*.md | sort -u); do
    name=${link#pictures/}
    mkdir -p pictures
    for found in "$report/$name" "$results"/*/"$name"; do
      if [ -f "$found" ]; then
        cp "$found" "$link"
        echo "$link"
      fi
    done
  done
done

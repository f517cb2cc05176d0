#!/usr/bin/env bash
# Experiments in Python, and sets that are functions.
set -u
. "$2/tests/python/python.sh.inc"
[ -e "$build/libaureole-lab.so" ] || { echo "skipped: the libraries are static"; exit 77; }
export AUREOLE_RENDER_LIBRARY=$build/libaureole-lab.so
"${python[@]}" "$source_tree/examples/python/custom_experiment.py" --quick --set r2 -o results --report report >example.txt || exit 1
grep -q 'claim: golden points beat random ones: holds' example.txt && grep -q 'r2: error falls' example.txt && [ -s report/custom-bump-rmse.pdf ] ||
  { cat example.txt; exit 1; }
"${python[@]}" -W error "$source_tree/tests/python/lab.py" "$1" "$source_tree"

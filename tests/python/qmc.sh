#!/usr/bin/env bash
# Engines for scipy.stats.qmc: what its own functions take, with the points of the sets.
set -u
. "$2/tests/python/python.sh.inc"
"${python[@]}" -c "import scipy.stats" 2>import.log || { echo "skipped: there is no SciPy"; exit 77; }
"${python[@]}" "$source_tree/tests/python/qmc.py"

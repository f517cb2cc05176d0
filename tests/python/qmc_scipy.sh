#!/usr/bin/env bash
# SciPy's own tests of engines take aureole.qmc's: the same results, the same errors.
set -u
. "$2/tests/python/python.sh.inc"
"${python[@]}" -c "import scipy.stats.tests, pytest" 2>import.log || { echo "skipped: SciPy's tests or pytest are not there"; exit 77; }
"${python[@]}" -m pytest -q -p no:cacheprovider -p scipy.conftest -c /dev/null --rootdir . "$source_tree/tests/python/qmc_scipy.py"

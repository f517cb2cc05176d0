#!/usr/bin/env bash
# The Python package beside the program: the same bits, the library's errors, arrays that are not copied.
set -u
. "$2/tests/python/python.sh.inc"
"${python[@]}" -W error "$source_tree/tests/python/core.py" "$1"

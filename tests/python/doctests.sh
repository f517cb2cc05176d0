#!/usr/bin/env bash
# The examples in the docstrings and in docs/python.md print what they say, by the package of the build tree.
set -u
. "$2/tests/python/python.sh.inc"
"${python[@]}" -W error "$source_tree/tests/python/doctests.py" "$source_tree"

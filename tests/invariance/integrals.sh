#!/usr/bin/env bash
# Integrals from Python do not depend on rotations, added constants or factors where arithmetic says so (tests/invariance/integrals.py).
set -u
program=$1
. "$2/tests/python/python.sh.inc"
exec "${python[@]}" "$source_tree/tests/invariance/invariance.py" "$program" "$source_tree" integrals ${AUREOLE_FULL_INVARIANCE:+full}

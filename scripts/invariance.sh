#!/usr/bin/env bash
# invariance.sh [PROGRAM]: prints what must not change an answer, and whether it does; docs/reliability.md has a summary. The
# tests of tests/invariance run the same rows with fewer seeds and places.
set -euo pipefail
program=$(realpath "${1:-build/release/aureole}")
source=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export PYTHONPATH=${program%/*}/python # the rows of integrals need the Python package
AUREOLE_CACHE='' PYTHONDONTWRITEBYTECODE=1 python3 "$source/tests/invariance/invariance.py" "$program" "$source" all full

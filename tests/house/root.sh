#!/usr/bin/env bash
# The root of the tree has these files and no others: what a test or a fuzzer leaves there is not committed by mistake.
set -u
cd "$2" || exit 1
git rev-parse --is-inside-work-tree >/dev/null 2>&1 || { echo "skipped: needs a clone"; exit 77; }
known='CHANGELOG.md CITATION.cff CMakeLists.txt CMakePresets.json CODE_OF_CONDUCT.md CONTRIBUTING.md Containerfile LICENSE README.md SECURITY.md pyproject.toml'
others=$(git ls-files | grep -vE '/|^\.' | grep -vxF "$(tr ' ' '\n' <<<"$known")")
[ -z "$others" ] || { echo "files that do not belong into the root of the tree:" $others; exit 1; }

#!/usr/bin/env bash
# The root of the tree has these files and folders and no others: what a test or a fuzzer leaves there is not committed by mistake.
set -u
cd "$2" || exit 1
git rev-parse --is-inside-work-tree >/dev/null 2>&1 || { echo "skipped: needs a clone"; exit 77; }
known='CHANGELOG.md CITATION.cff CMakeLists.txt CMakePresets.json CODE_OF_CONDUCT.md CONTRIBUTING.md Containerfile LICENSE README.md SECURITY.md pyproject.toml'
known+=' bench cmake data docs examples fuzz include lab packaging python scenes scripts src tests'
others=$(git ls-files | cut -d/ -f1 | sort -u | grep -v '^\.' | grep -vxF "$(tr ' ' '\n' <<<"$known")")
[ -z "$others" ] || { echo "files or folders that do not belong into the root of the tree:" $others; exit 1; }

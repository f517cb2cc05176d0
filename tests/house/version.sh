#!/usr/bin/env bash
# One version: that of the header is the program's, the citation's, the recipes' and the newest of the changelog, with the citation's date; the
# Python package takes it from the header. scripts/release.sh finds the changelog's section.
set -u
program=$1
cd "$2" || exit 1
status=0
same() { # same WHAT VALUE EXPECTED
  [ "$2" = "$3" ] || { echo "$1 says '$2', and include/aureole/version.h '$3'"; status=1; }
}
version=$(awk '/#define AUREOLE_VERSION_(MAJOR|MINOR|PATCH) /{ printf "%s%s", dot, $3; dot = "." }' include/aureole/version.h)
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || { echo "include/aureole/version.h has no version: '$version'"; exit 1; }
same "aureole --version" "$("$program" --version)" "aureole $version"
same CITATION.cff "$(sed -n 's/^version: //p' CITATION.cff)" "$version"
heading=$(grep -m1 '^## \[[0-9]' CHANGELOG.md)
same CHANGELOG.md "$heading" "## [$version] - $(sed -n 's/^date-released: //p' CITATION.cff)"
same packaging/vcpkg/vcpkg.json "$(sed -n 's/^ *"version": "\(.*\)",$/\1/p' packaging/vcpkg/vcpkg.json)" "$version"
same packaging/conda/meta.yaml "$(sed -n 's/^ *version: "\(.*\)"$/\1/p' packaging/conda/meta.yaml)" "$version"
same packaging/spack/package.py "$(sed -n 's/^ *version("\([^"]*\)".*/\1/p' packaging/spack/package.py)" "$version"
python=$(sed -n '/^\[tool.scikit-build.metadata.version\]/,$ s/^input = "\(.*\)"$/\1/p' pyproject.toml)
[ "$python" = include/aureole/version.h ] || { echo "pyproject.toml takes its version from '$python'"; status=1; }
python=$(sed -n '/^\[tool.scikit-build.metadata.version\]/,$ s/^input = "\(.*\)"$/\1/p' python/render/pyproject.toml)
[ "$python" = ../../include/aureole/version.h ] || { echo "python/render/pyproject.toml takes its version from '$python'"; status=1; }
same "pyproject.toml's extra 'render'" "$(sed -n 's/^render = \["aureole-render==\(.*\)"\].*/\1/p' pyproject.toml)" "$version"
scripts/release.sh --notes >"$OLDPWD/notes" || status=1
grep -q '^### ' "$OLDPWD/notes" || { echo "scripts/release.sh --notes has no part of the changelog"; status=1; }
! grep -q '^## ' "$OLDPWD/notes" || { echo "scripts/release.sh --notes has more than one section"; status=1; }
exit $status

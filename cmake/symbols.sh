#!/usr/bin/env bash
# symbols.sh HEADER...: the public functions that the headers declare (AUR_API, AUR_EXPERIMENTAL), a line each, sorted.
# symbols.sh --map VERSION HEADER...: the linker's symbol map of the libraries. Public functions have a version that stays;
# all other names that a library shows, which are for the libraries and the tools of this tree, one of this release alone.
set -euo pipefail
map=
[ "$1" = --map ] && { map=$2; shift 2; }
names=$(sed '/^#/d' "$@" | tr '\n' ' ' | grep -oE '(AUR_API|AUR_EXPERIMENTAL) [^(;]*\(' | sed -E 's/.*[ *](aur_[a-z0-9_]+)\($/\1/' | sort -u)
[ -n "$map" ] || { echo "$names"; exit; }
printf 'AUREOLE_0 {\n  global:\n'
sed 's/.*/    &;/' <<<"$names"
printf '};\nAUREOLE_PRIVATE_%s {\n  global:\n    aur_*;\n  local:\n    *;\n};\n' "$map"

#!/usr/bin/env bash
# symbols.sh HEADER...: the public functions that the headers declare (AUR_API, AUR_EXPERIMENTAL), a line each, sorted.
# symbols.sh --experimental HEADER...: those of them that are AUR_EXPERIMENTAL.
# symbols.sh --map LIBRARY VERSION HEADER... --hide OBJECT...: the linker's symbol map of a library. Public functions have a version
# that stays; experimental ones, and all other names that a library shows, which are for the libraries and the tools of this tree,
# have one of this release alone, so that no program is bound to another release's. What the objects after --hide define is shown only
# where the headers declare it: each library has its own copy.
set -euo pipefail
map= node=
kinds='AUR_API|AUR_EXPERIMENTAL'
case $1 in
  --map) node=${2^^} map=$3; node=${node//-/_}; shift 3 ;;
  --experimental) kinds=AUR_EXPERIMENTAL; shift ;;
esac
names() {
  sed '/^#/d' "${@:2}" | tr '\n' ' ' | grep -oE "($1) [^(;]*\(" | sed -E 's/.*[ *]((aur|lab)_[a-z0-9_]+)\($/\1/' | sort -u
}
hidden=()
for i in $(seq $#); do [ "${!i}" != --hide ] || { hidden=("${@:i+1}"); set -- "${@:1:i-1}"; break; }; done
[ -n "$map" ] || { names "$kinds" "$@"; exit; }
# Written at once: another process may read it.
map=$(
  printf '%s_1 {\n  global:\n' "$node"
  names AUR_API "$@" | sed 's/.*/    &;/'
  printf '};\n%s_EXPERIMENTAL_%s {\n  global:\n' "$node" "$map"
  names AUR_EXPERIMENTAL "$@" | sed 's/.*/    &;/'
  printf '};\n%s_PRIVATE_%s {\n  global:\n    aur_*;\n  local:\n    *;\n' "$node" "$map"
  [ ${#hidden[@]} -eq 0 ] || "${NM:-nm}" --defined-only "${hidden[@]}" | sed -nE 's/.* T (aur_[a-z0-9_]+)$/\1/p' | sort -u |
    comm -23 - <(names "$kinds" "$@") | sed 's/.*/    &;/'
  echo '};'
)
echo "$map"

#!/usr/bin/env bash
# abi.sh check BUILD: whether the libraries of a build have the binary interface that stands in scripts/abi, by libabigail (Debian:
# abigail-tools). Additions pass; what would break a program that is linked with an older library is told, and the exit code is 1.
# abi.sh record BUILD: writes scripts/abi again. docs/embedding.md says when that is right.
# Only what stays is looked at, the symbols of versions AUREOLE_1, AUREOLE_RENDER_1 and AUREOLE_LIGHTING_1. Builds need their debug information.
set -euo pipefail
for tool in abidw abidiff xz; do
  command -v $tool >/dev/null || { echo "abi.sh: skipped: there is no $tool (Debian: abigail-tools, xz-utils)"; exit 77; }
done
verb=${1:-} build=${2:-}
[ -n "$build" ] && [ -e "$build/libaureole.so" ] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
tree=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
dump() {
  abidw --suppr "$tree/scripts/abi/private.abignore" --headers-dir "$tree/include" --drop-private-types --no-show-locs \
    --no-comp-dir-path --no-corpus-path --no-elf-needed --no-parameter-names --exported-interfaces-only --type-id-style hash \
    --out-file "$work/dump" "$build/$1.so"
  grep -vE "version='AUREOLE_[A-Z_]*(EXPERIMENTAL|PRIVATE)" "$work/dump" >"$work/$1.abi"
}
status=0
for library in libaureole libaureole-render libaureole-lighting; do
  [ -e "$build/$library.so" ] || continue
  dump $library
  [ "$(grep -c "<function-decl" "$work/$library.abi")" -ge 2 ] ||
    { echo "abi.sh: $library.so has no debug information to read"; exit 77; }
  case $verb in
  record) xz -9c "$work/$library.abi" >"$tree/scripts/abi/$library.abi.xz" ;;
  check)
    xz -dc "$tree/scripts/abi/$library.abi.xz" >"$work/kept.abi"
    # bits of abidiff's result: 1 and 2 are its own errors, 4 a change, 8 one that breaks programs
    code=0
    abidiff --no-added-syms --no-show-locs "$work/kept.abi" "$work/$library.abi" >"$work/changes" 2>&1 || code=$?
    [ $((code & 11)) = 0 ] || { echo "$library: the binary interface is another one than recorded:"; cat "$work/changes"; status=1; } ;;
  *) exit 2 ;;
  esac
done
exit $status

#!/usr/bin/env bash
# The libraries keep the binary interface that is recorded, and a library that lost a function, or has one with other arguments, is told.
set -u
build=$(dirname "$1")
source_tree=$2
[ -e "$build/libaureole.so" ] || { echo "skipped: the libraries are static"; exit 77; }
grep -q '^AUREOLE_SANITIZE:[^=]*=.' "$build/CMakeCache.txt" && { echo "skipped: the release build is asked"; exit 77; }
# Compilers describe the same interface in other words; the record is of gcc 12's on x86-64.
compiler=$(sed -n 's/^CMAKE_C_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")
case $(uname -m)-$("$compiler" --version | head -1) in
x86_64-*gcc*\ 12.* | x86_64-cc*\ 12.*) ;;
*) echo "skipped: the record is of gcc 12 on x86-64"; exit 77 ;;
esac
bash "$source_tree/scripts/abi.sh" check "$build"
code=$?
[ $code = 0 ] || exit $code
# Two small libraries, one with another argument: what the tool has to find is found.
for kind in int double; do
  mkdir -p $kind
  echo "int aur_f($kind x); int aur_f($kind x) { return (int)x; }" >$kind/f.c
  gcc -g -shared -fPIC $kind/f.c -o $kind/libf.so || exit 1
done
abidiff int/libf.so double/libf.so >/dev/null && { echo "abidiff finds no change where there is one"; exit 1; }
exit 0

#!/usr/bin/env bash
# Points, measures and weights are those that are recorded, to the bit, whatever processor recorded them.
set -u
build=$(dirname "$1")
source_tree=$2
grep -q '^AUREOLE_SANITIZE:[^=]*=.' "$build/CMakeCache.txt" && { echo "skipped: the release build is asked"; exit 77; }
# The C library's mathematics differs in last bits between its versions, and where a processor has no fused multiply-add.
record=$source_tree/scripts/bits.txt
grep -q "$(getconf GNU_LIBC_VERSION)," "$record" || { echo "skipped: the record is of another C library"; exit 77; }
[ "$(uname -m)" != x86_64 ] || grep -qw fma /proc/cpuinfo || { echo "skipped: no fused multiply-add"; exit 77; }
exec bash "$source_tree/scripts/bits.sh" "$1" check numbers

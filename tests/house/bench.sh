#!/usr/bin/env bash
# What aureole-bench refuses: names of benches and of instruction sets that do not exist, with the nearest one.
# bench_isa.sh.inc runs the benches.
set -u
bench=$(dirname "$1")/aureole-bench
refused() { # refused WORDS ARGUMENTS...
  local words=$1
  shift
  "$bench" "$@" >/dev/null 2>message
  [ $? = 2 ] || { echo "aureole-bench $*: exit status is not 2"; exit 1; }
  grep -q "$words" message || { echo "aureole-bench $*: does not say: $words"; cat message; exit 1; }
}
refused "no bench is named 'no-such-bench'" no-such-bench
refused "unknown instruction set 'avx3'; did you mean 'avx2'?" limits --isa avx3
refused "unknown instruction set ''; there are: portable, avx2, avx512" limits --isa ''
[ "$(uname -m)" = x86_64 ] || refused 'this processor has no avx2 instructions' limits --isa avx2

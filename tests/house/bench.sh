#!/usr/bin/env bash
# Every bench runs to its end in its quick form and prints a positive rate; a name that does not exist is refused.
set -u
bench=$(dirname "$1")/aureole-bench
"$bench" list >list || exit 1
"$bench" all --quick >figures || { echo "aureole-bench all --quick failed"; exit 1; }
while read -r name _; do
  grep -q "^$name: " figures || { echo "bench $name did not run"; exit 1; }
done <list
# "  NAME  RATE UNIT/s ...": the rate is a positive number.
grep -F '/s' figures >rates || { echo "no figure was printed"; exit 1; }
grep -vE ' [0-9][0-9.e+-]* [A-Za-z]+/s' rates && { echo "not a rate"; exit 1; }
grep -E ' 0 [A-Za-z]+/s' rates && { echo "a rate is zero"; exit 1; }
"$bench" no-such-bench 2>message && { echo "an unknown bench was accepted"; exit 1; }
grep -q "no-such-bench" message

#!/usr/bin/env bash
# Our own rows of the tables beside other packages say what the program computes today: those of bench/peers/fields.md, and of
# bench/peers/sets.md but for the sphere's, whose caps take long. Of each page one figure is changed, and the scripts name that one alone.
set -u
aureole=$1
peers=$2/bench/peers
/usr/bin/python3 -c 'import numpy' 2>message || { echo "skipped: Python has no NumPy"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
one_change() { # page, what sed changes in it, what the message begins with, script and options
  local page=$1 change=$2 beginning=$3
  shift 3
  sed "$change" "$docs/$page" >changed.md
  cmp -s changed.md "$docs/$page" && { echo "$page: the row that is to be changed is not there"; exit 1; }
  /usr/bin/python3 "$peers/$1" "${@:2}" --program "$aureole" --check --ours --page changed.md >message
  [ $? = 1 ] && [ "$(wc -l <message)" = 1 ] && grep -q "$beginning" message && return
  echo "$page: not the one change that was made:"
  cat message
  exit 1
}
docs=$2/bench/peers
one_change fields.md 's/| `random` | 194 | 1 /| `random` | 194 | 1.1 /' 'found | `random` | 194 |' fields.py --sizes 194
one_change sets.md 's/^\(| `sobol` | 1024 | \)4.4 /\14.5 /' 'square, `sobol`: ' sets.py --domains square,rotations
exit 0

#!/usr/bin/env bash
# Our own rows of the tables beside other packages say what the program computes today: those of docs/choosing.md.
set -u
aureole=$1
peers=$2/bench/peers
/usr/bin/python3 -c 'import numpy' 2>message || { echo "skipped: Python has no NumPy"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
/usr/bin/python3 "$peers/fields.py" --program "$aureole" --check --ours --sizes 50,194 || exit 1
# What it does not find there, it says.
sed 's/| `random` | 194 | 1 /| `random` | 194 | 1.1 /' "$2/docs/choosing.md" >changed.md
cmp -s changed.md "$2/docs/choosing.md" && { echo "the row that is to be changed is not there"; exit 1; }
/usr/bin/python3 "$peers/fields.py" --program "$aureole" --check --ours --sizes 194 --page changed.md >message &&
  { echo "a changed figure is not seen"; exit 1; }
grep -q 'random' message || { cat message; exit 1; }
exit 0

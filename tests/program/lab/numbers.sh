#!/usr/bin/env bash
# The numbers on the pages of docs are those of the kept tables, and a wrong one is found and mended by scripts/lab_numbers.py.
set -u
source=$2
command -v python3 >/dev/null || { echo "skipped: needs python3"; exit 77; }
python3 "$source/scripts/lab_numbers.py" check >said.txt || { cat said.txt; echo "FAILED: scripts/lab_numbers.py fill puts the numbers of the kept tables there"; exit 1; }
[ "$(awk 'END { print $1 }' said.txt)" -ge 900 ] || { echo "FAILED: $(tail -1 said.txt)"; exit 1; }

rm -rf tree && mkdir -p tree/docs/report tree/scripts
cp "$source/scripts/lab_numbers.py" tree/scripts
cp -r "$source/docs/papers" "$source"/docs/*.md tree/docs
ln -s "$source/docs/report/results" tree/docs/report/results
page=tree/docs/papers/keller-1994.md
sed -i -E 's/^(\| 1, cube \| )[0-9]+/\1301/; s/^(\| 3, cube \| )\.[0-9]+/\1.00062/' $page
python3 tree/scripts/lab_numbers.py check >said.txt && { echo "FAILED: wrong numbers are not found"; exit 1; }
[ "$(grep -c '^keller-1994.md:[0-9]*: \(301\|.00062\) is ' said.txt)" = 2 ] || { echo "FAILED: not both: $(cat said.txt)"; exit 1; }
python3 tree/scripts/lab_numbers.py fill >said.txt || { echo "FAILED: fill: $(cat said.txt)"; exit 1; }
cmp $page "$source/docs/papers/keller-1994.md" || { echo "FAILED: fill leaves another page"; exit 1; }
sed -i 's/^| 1, cube/| 1, box/' $page
python3 tree/scripts/lab_numbers.py fill >said.txt && { echo "FAILED: a lost line is not found"; exit 1; }
exit 0

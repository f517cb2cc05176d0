#!/usr/bin/env bash
# lab check: what it takes for the kept tables, and what not; and the stamps of those of the tree.
set -u
aureole=$1
source=$2
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
rm -rf results kept checked

# No rays: to the bit. Rays: within a hundredth of the value or of its interval. The run itself is kept here, then changed.
"$aureole" lab run domains-grids marques-2013-fig1 --quick -q --scenes "$source/scenes" -o results >run.txt 2>&1 || fail "$(cat run.txt)"
for name in domains-grids marques-2013-fig1; do
  mkdir -p kept/$name/quick
  cp results/$name/$name.csv kept/$name/quick
  rays=$([ $name = domains-grids ] && echo no || echo yes)
  printf 'experiment,rays,sources\n%s,%s,0\n' $name "$rays" >kept/$name/$name-stamp.csv
done
# change NAME COLUMN FACTOR: multiplies the first row's number of a column.
change() {
  awk -F, -v OFS=, -v name="$2" -v by="$3" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) at = i }
    NR == 2 { $at = sprintf("%.17g", $at * by) } 1' "results/$1/$1.csv" >"kept/$1/quick/$1.csv"
}
# said STATUS TEXT NAME...: the exit status and what the table says.
said() {
  "$aureole" lab check "${@:3}" --quick -q --scenes "$source/scenes" --stored kept -o checked >said.txt 2>&1
  local status=$?
  [ $status -eq "$1" ] || fail "${*:3}: exit status $status, not $1: $(cat said.txt)"
  grep -q -- "$2" said.txt || fail "${*:3}: no '$2': $(cat said.txt)"
}
said 0 '^domains-grids  *identical' domains-grids
said 0 '^marques-2013-fig1  *identical' marques-2013-fig1
column=$(head -1 results/domains-grids/domains-grids.csv | tr , '\n' | tail -1)
change domains-grids "$column" 1.0000000001
said 1 "^domains-grids  *DIFFERS .*row 1, $column" domains-grids
# A standard output that takes nothing is an error with a message, whatever the tables say; check.csv has the summary.
grep -q '^domains-grids,DIFFERS,' checked/check.csv || fail "check.csv: $(cat checked/check.csv)"
for output in full closed; do
  check=("$aureole" lab check domains-grids --quick -q --kept kept -o checked) # the name of --stored in version 0.1
  if [ $output = closed ]; then "${check[@]}" 2>said.txt >&-; elif [ -w /dev/full ]; then "${check[@]}" 2>said.txt >/dev/full; else continue; fi
  [ $? -eq 3 ] || fail "$output standard output: not exit status 3"
  grep -q 'standard output' said.txt || fail "$output standard output: $(cat said.txt)"
done
change marques-2013-fig1 its_own 1.001
said 0 '^marques-2013-fig1  *within tolerance' marques-2013-fig1
change marques-2013-fig1 its_own 1.5
said 1 '^marques-2013-fig1  *DIFFERS .*row 1, its_own: ' domains-grids marques-2013-fig1
grep -q '^domains-grids .*DIFFERS' said.txt || fail "not both: $(cat said.txt)"
sed '$d' results/domains-grids/domains-grids.csv >kept/domains-grids/quick/domains-grids.csv
said 1 '^domains-grids  *DIFFERS' domains-grids
cp results/domains-grids/domains-grids.csv kept/domains-grids/quick
echo '# one more note' >>kept/domains-grids/quick/domains-grids.csv
said 1 "note: 'one more note' stored" domains-grids
cp results/domains-grids/domains-grids.csv kept/domains-grids/quick
cp results/domains-grids/domains-grids.csv kept/domains-grids/quick/domains-grids-more.csv
said 1 "domains-grids-more.csv: the table: 'one' stored, 'none' now" domains-grids
said 1 '^domains-axes  *not stored' domains-axes
"$aureole" lab check domains-axes --set sobol -o checked >said.txt 2>&1
[ $? -eq 2 ] || fail "--set is accepted: $(cat said.txt)"

# Stamps: each kept table has one, of the experiments that there are. Sources are read from release builds.
build=$(dirname "$aureole")
for folder in "$source"/docs/report/results/*/; do
  name=$(basename "$folder")
  [ -e "$folder$name-stamp.csv" ] || fail "$name has no stamp: scripts/report.sh, or scripts/lab_stamps.py --outdated $name"
done
if command -v python3 >/dev/null && command -v nm >/dev/null && grep -q 'CMAKE_BUILD_TYPE:.*=RelWithDebInfo' "$build/CMakeCache.txt" 2>/dev/null &&
  ! grep -q 'AUREOLE_SANITIZE:.*=.*[a-z]' "$build/CMakeCache.txt"; then
  python3 "$source/scripts/lab_stamps.py" --build "$build" >stamps.txt || fail "lab_stamps.py"
  [ "$(wc -l <stamps.txt)" -eq "$("$aureole" lab list --format csv | tail -n +2 | wc -l)" ] || fail "stamps of other experiments: $(cat stamps.txt)"
  grep -q '^schretter-2012-gaps,no,' stamps.txt && grep -q '^keller-1994-table1,yes,' stamps.txt || fail "which trace rays: $(cat stamps.txt)"
  while IFS=, read -r name rays _; do
    [ ! -e "$source/docs/report/results/$name" ] || grep -q "^$name,$rays," "$source/docs/report/results/$name/$name-stamp.csv" || fail "$name: the stamp says other than rays $rays"
  done <stamps.txt
  python3 "$source/scripts/lab_stamps.py" --build "$build" --files keller-1994-table1 >files.txt
  for file in lab/keller-1994/study.h src/render/radiosity/walk.c scenes/keller/office.xml; do
    grep -qx "keller-1994-table1: $file" files.txt || fail "keller-1994-table1 does not depend on $file"
  done
  grep -q 'lab/marques' files.txt && fail "Keller's table depends on $(grep lab/marques files.txt)"
  python3 "$source/scripts/lab_stamps.py" --build "$build" --stale >stale.txt
  echo "sources have changed since the tables of $(wc -l <stale.txt) experiments were kept:" $(cat stale.txt)
fi
exit $((failures > 0))

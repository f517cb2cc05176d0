#!/usr/bin/env bash
# Every experiment in its quick form by one command, whether it still gives the kept tables, and what must hold for each: checks/*.sh,
# which see the results in $results. Then what a user meets: an interruption, --set, names that do not exist.
set -u
aureole=$1
source=$2
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
results=results
rm -rf results again
"$aureole" lab list --format csv | grep -q '^marques-2013-gather,.*Marques 2013' || fail "the list"
count=$("$aureole" lab list --format csv | tail -n +2 | wc -l)
if [ -n "${AUREOLE_SHORT_TESTS:-}" ]; then # those of a second by the list and those that are run again below; nothing is said of figures
  mapfile -t quick < <("$aureole" lab list --format csv | sed -n 's/^\([^,]*\),\("[^"]*"\|[^,]*\),1 s,.*/\1/p')
  [ ${#quick[@]} -ge 6 ] || fail "only ${#quick[@]} experiments are quick"
  checked=(marques-2013-gather marques-2013-table1 analytical-cases "${quick[@]}")
else
  checked=(--all)
fi
"$aureole" lab check "${checked[@]}" --quick -q --format csv --scenes "$source/scenes" --stored "$source/docs/report/results" -o results >summary.csv || {
  fail "the kept tables (scripts/report.sh keeps new ones):"
  grep -vE ',(identical|within tolerance|meshes missing),' summary.csv
}
if [ -z "${AUREOLE_SHORT_TESTS:-}" ]; then
  [ "$(tail -n +2 summary.csv | wc -l)" -eq "$count" ] || fail "not every experiment is in the summary"
  for check in "$source"/tests/program/lab/checks/*.sh; do
    # shellcheck disable=SC1090
    . "$check"
  done
  # What is finished is kept.
  "$aureole" lab run --all --quick -q --format csv --scenes "$source/scenes" -o results >summary.csv || fail "the second run"
  awk -F, 'NR > 1 && $2 != "stored" { bad = 1 } END { exit bad }' summary.csv || fail "$(cat summary.csv)"
fi
# Nothing is left of how results came about.
ls results/*/*unfinished* >left.txt 2>/dev/null && fail "left over: $(cat left.txt)"

# On one thread, stopped after the first measurements and continued: every file is the same but for the times.
gather=(lab run marques-2013-gather --quick -q --threads 1 --scenes "$source/scenes" -o again)
"$aureole" "${gather[@]}" >again.txt 2>&1 &
kept=again/marques-2013-gather/marques-2013-gather-unfinished.txt
for ((i = 0; i < 3000; ++i)); do
  [ -f $kept ] && [ "$(wc -l <$kept)" -ge 3 ] && break
  sleep .01
done
kill -KILL $!
wait $! 2>/dev/null
lines=$(wc -l <$kept)
[ "$lines" -ge 3 ] || fail "nothing was kept"
echo "not the end of a line" | tr -d '\n' >>$kept
sed -i '2s/0x[^ ]*/0x1p-9/' $kept # a number that no run measures shows that it was taken up
"$aureole" "${gather[@]}" >again.txt 2>&1 || fail "going on: $(cat again.txt)"
rmse=$(awk -F, 'NR == 2 { print $4 }' again/marques-2013-gather/marques-2013-gather.csv)
whole=$(awk -F, 'NR == 2 { print $4 }' results/marques-2013-gather/marques-2013-gather.csv)
[ "$rmse" != "$whole" ] || fail "what was kept was measured again"
"$aureole" "${gather[@]}" >again.txt 2>&1 || fail "again: $(cat again.txt)"
"$aureole" lab run factors-coverage analytical-cases --quick -q --threads 1 -o again >again.txt 2>&1 || fail "$(cat again.txt)"
for file in results/{marques-2013-gather,factors-coverage,analytical-cases}/*; do
  case $file in *-timings.csv) continue ;; esac
  cmp "$file" "again/${file#results/}" || fail "$file differs"
done

# One more set, also of a file, which has too few points for some sizes; and experiments that compare no sets.
"$aureole" points r2 -n 300 -o mine.csv || fail "points"
"$aureole" lab run domains-prefixes integrate-coverage --quick -q --set file:mine.csv -o again >set.txt 2>&1 || fail "$(cat set.txt)"
grep -q '^file:mine.csv  *the first n' set.txt || fail "one more set: $(cat set.txt)"
grep -q '^--set file:mine.csv is not compared here: ' set.txt || fail "an experiment without sets: $(cat set.txt)"
"$aureole" lab run weights-choosing --quick -q --set file:mine.csv -o again >set.txt 2>&1 || fail "$(cat set.txt)"
grep -q '^file:mine.csv  *64 ' set.txt || fail "a set of a file: $(cat set.txt)"
"$aureole" lab run marques-2018-slopes --quick -q --set file:mine.csv -o again >set.txt 2>&1 || fail "$(cat set.txt)"
grep -q '^file:mine.csv left out: mine.csv has 300 points, not 512' set.txt || fail "a set that is too small: $(cat set.txt)"
# Rows that are named are made alone, with the same figures.
"$aureole" lab run marques-2013-table1 --quick -q --scenes "$source/scenes" -o again --rows '*/diffuse/lambert/sobol' >rows.txt 2>&1 ||
  fail "rows by name: $(cat rows.txt)"
diff <(grep -v '^#' again/marques-2013-table1/marques-2013-table1.csv) \
  <(grep -E '^scene|,diffuse,lambert,sobol' results/marques-2013-table1/marques-2013-table1.csv) || fail "other figures of one row"
refused() {
  local words=$1
  shift
  "$aureole" lab "$@" -o again >message.txt 2>&1
  [ $? -eq 2 ] || fail "not refused: $*"
  grep -q "$words" message.txt || fail "$*: $(cat message.txt)"
}
refused "did you mean 'sobol'" run domains-prefixes --quick --set sobl
refused "marques-2031.*lab list" run marques-2031
refused "cannot be used with 'marques-2013-gather'" run marques-2013-gather --quick --rows '*'
refused "takes no names" run --all domains-axes
refused "no experiment given" run
"$aureole" lab 2>/dev/null
[ $? -eq 2 ] || fail "lab without a word"
exit $((failures > 0))

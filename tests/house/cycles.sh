#!/usr/bin/env bash
# No circles: the C files of every target (libraries, program, lab, bench, the reader of models, makers of scenes) can be put in an
# order in which each calls only files after it. Which file needs which is read from the symbols that its object defines and needs.
set -u
build=$(dirname "$1")
command -v nm >/dev/null && command -v tsort >/dev/null || { echo "skipped: needs nm and tsort"; exit 77; }
source_tree=$2
# Objects of files that are no longer in the tree stay in a build folder. Each program of the tests and fuzz harnesses is one file.
objects=$(find "$build"/CMakeFiles/*.dir -name '*.c.o' | while read -r object; do
  source=${object#*.dir/}
  [ "$source" = "${source#kernels/}" ] || source=${source#kernels/} source=${source%_avx*}.c.o
  [ ! -e "$source_tree/${source%.o}" ] || echo "$object"
done)
[ -n "$objects" ] || { echo "no object files below $build"; exit 1; }

# One line an arrow: FILE NEEDED SYMBOL. Two programs may have a function of one name: a target has its own, or its libraries'.
# shellcheck disable=SC2086
nm -A $objects | sed -E 's|^.*CMakeFiles/([^/]*)\.dir/([^:]*)\.o:|\1 \2 |; s|^([^ ]*) kernels/([^ ]*)_avx[0-9]+\.c |\1 \2.c |' |
  awk '$(NF - 1) == "U" { needs[++count] = $1 " " $2 " " $NF; next }
       $(NF - 1) ~ /^[A-Z]$/ { within[$1, $NF] = $2
                               if ($1 ~ /^aureole_/) shared[$NF] = $2 }
       END { for (i = 1; i <= count; ++i) {
               split(needs[i], part, " ")
               target = within[part[1], part[3]]
               if (target == "") target = shared[part[3]]
               if (target != "" && target != part[2]) print part[2], target, part[3] } }' | sort -u >arrows.txt
[ "$(wc -l <arrows.txt)" -gt 2000 ] || { echo "only $(wc -l <arrows.txt) arrows: the symbols were not read"; exit 1; }
for part in src/program/cli/ src/program/lab/ src/points/base/ src/render/scene/ src/lighting/viewfactors/ lab/ bench/; do
  grep -q "^$part" arrows.txt || { echo "no arrow from a file of $part: its symbols were not read"; exit 1; }
done

cut -d' ' -f1,2 arrows.txt | sort -u | tsort 2>loops.txt >/dev/null && exit 0
# Each circle that tsort met, with the symbols that close it.
sed 's/^tsort: //' loops.txt | awk '/contains a loop/ { print "a circle:"; next } { print "  " $0 }'
members=$(grep -v 'contains a loop' loops.txt | sed 's/^tsort: //' | sort -u)
awk -v members="$members" 'BEGIN { n = split(members, m, "\n"); for (i = 1; i <= n; ++i) in_loop[m[i]] = 1 }
                           ($1 in in_loop) && ($2 in in_loop) { print "  " $1 " needs " $3 " of " $2 }' arrows.txt
exit 1

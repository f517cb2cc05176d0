#!/usr/bin/env bash
# aureole voronoi: the areas of sets and files add up, corners are written in three formats that agree, bad input is refused
# with status 2 and one line.
set -u
aureole=$1
fail() { echo "$*"; exit 1; }
for domain in sphere hemisphere axes; do
  "$aureole" points halton -n 40 --domain $domain -o $domain.csv -q || fail "points on $domain"
  "$aureole" voronoi $domain.csv --domain $domain --cells $domain-cells.csv --format csv >areas.csv || fail "$domain"
  awk -F, -v whole=$([ $domain = sphere ] && echo 2 || echo 1) '
    NR > 1 { n += $5; area += $6; sides += $8 } END { exit !(NR == 41 && n > 40 - 1e-8 && n < 40 + 1e-8 &&
      area / (2 * 3.14159265358979 * whole) > 1 - 1e-8 && area / (2 * 3.14159265358979 * whole) < 1 + 1e-8) }' areas.csv ||
    fail "the areas on the $domain do not add up"
  sides=$(awk -F, 'NR > 1 { sides += $8 } END { print sides }' areas.csv)
  [ "$(wc -l <$domain-cells.csv)" = $((sides + 1)) ] || fail "$domain: corners"
  "$aureole" voronoi halton -n 40 --domain $domain -q --cells cells.obj --format csv >own.csv || fail "$domain: the set"
  [ "$(cut -d, -f5- own.csv)" = "$(cut -d, -f5- areas.csv)" ] || fail "$domain: the set is not its file"
  diff <(sed -n 's/^v //p' cells.obj) <(sed 1d $domain-cells.csv | cut -d, -f2- | tr , ' ') || fail "$domain: OBJ"
  "$aureole" voronoi halton -n 40 --domain $domain -q --cells cells.ply >table.txt || fail "$domain: PLY"
  [ "$(sed 1,/end_header/d cells.ply | awk 'NF == 3' | head -$sides)" = "$(sed -n 's/^v //p' cells.obj)" ] || fail "$domain: PLY"
  diff <(sed -n 's/^f //p' cells.obj) <(sed 1,/end_header/d cells.ply | tail -40 |
    awk '{ for (i = 2; i <= $1 + 1; ++i) printf "%d%s", $i + 1, i <= $1 ? " " : "\n" }') || fail "$domain: faces"
done
refuse() {
  "$aureole" voronoi "$@" -q >out.txt 2>err.txt
  [ $? = 2 ] || fail "voronoi $*: not refused"
  [ "$(wc -l <err.txt)" = 1 ] || fail "voronoi $*: $(cat err.txt)"
}
refuse
refuse halton
refuse haltn -n 40
refuse halton -n 3 --cells cells.obj # lunes
refuse halton -n 40 --domain square
refuse super-fibonacci -n 40
refuse halton -n 40 --cells cells.stl
refuse halton -n 40 --cells cells
refuse nothing.csv
exit 0

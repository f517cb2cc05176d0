#!/usr/bin/env bash
# The report and the viewer of images, as files, and as Chromium shows them where there is one.
set -u
aureole=$1
source=$2
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
rm -rf results page drawn drawing small kept ./*.html
"$aureole" lab report nowhere -o page 2>message.txt
[ $? -eq 2 ] && grep -q "no results of the lab: 'aureole lab run" message.txt || fail "no results: $(cat message.txt)"
"$aureole" lab run marques-2013-gather marques-2018-gains marques-2018-slopes --quick -q --scenes "$source/scenes" -o results >run.txt 2>&1 ||
  fail "$(cat run.txt)"
"$aureole" lab report results -o page >said.txt 2>&1 || fail "$(cat said.txt)"
[ "$(cat said.txt)" = page/index.html ] || fail "what is said: $(cat said.txt)"
for what in '<td class="within">within a factor of 1.1</td>' '<td class="agrees">agrees</td>' '<g class="l1" ' \
  'data-name="marques-2018-gains.csv"' 'href="marques-2018-slopes-equal.pdf"'; do
  grep -q "$what" page/index.html || fail "no $what in the page"
done
# It begins with papers in a sentence, a figure and their verdicts, then has what is new, then the tables.
for what in '<h2>Marques et al. 2018: optimal sample weights</h2>' '<p class="verdicts">Of [0-9]* published values [0-9]* agree' '<h2>All tables</h2>' \
  '<h3>Marques 2018' '<section id="marques-2018-slopes">'; do
  grep -n "$what" page/index.html | head -1 | cut -d: -f1
done >lines.txt
[ "$(wc -l <lines.txt)" = 5 ] && sort -nc lines.txt || fail "the order of the page: $(cat lines.txt)"
head -c 5 page/marques-2018-slopes-equal.pdf | grep -q '^%PDF-' || fail "no PDF"
grep -q 'begin{groupplot}' page/marques-2018-slopes-equal.tex || fail "no TikZ"
grep -q '^<svg' page/marques-2018-slopes-equal.svg || fail "no SVG"
# Two panels, each as large as a plot of one, above one legend.
grep -q 'width="1000" height="384"' page/marques-2018-slopes-equal.svg || fail "panels are squeezed"
grep -qE '(src|href)="?(https?:)?//' page/index.html && fail "the page looks for something elsewhere"
[ "$(wc -c <page/index.html)" -lt 1000000 ] || fail "the page is large"
"$aureole" lab report results -o again >/dev/null && cmp page/index.html again/index.html || fail "two reports differ"
# A small page has no plots for print, and large images as means.
"$aureole" lab run marques-2019-grids --quick -q -o drawn >run.txt 2>&1 || fail "$(cat run.txt)"
"$aureole" lab report drawn -o drawing >/dev/null && "$aureole" lab report drawn -o small --small >/dev/null || fail "a small page"
[ "$(ls small)" = index.html ] || fail "files beside a small page: $(ls small)"
for what in 'sphere (means of 2 x 2 pixels)' '"width": 210, "height": 210'; do
  grep -qF "$what" small/index.html || fail "no $what in the small page"
  grep -qF "$what" drawing/index.html && fail "$what in the page"
done
[ $((2 * $(wc -c <small/index.html))) -lt "$(wc -c <drawing/index.html)" ] || fail "the small page is not half as large"
# That of the kept tables is one to send.
"$aureole" lab report "$source/docs/report/results" --small -o kept >/dev/null || fail "the kept tables"
# Numbers along narrow axes leave room between each other.
awk '/Keller 1994: quasi/ { on = 1 } /Schretter et al/ { exit } on' kept/index.html >keller.html
grep -q '>100000<' keller.html && ! grep -q '>50000<' keller.html || fail "crowded numbers along an axis"
[ "$(wc -c <kept/index.html)" -lt 2000000 ] || fail "the small page of the kept tables has $(wc -c <kept/index.html) bytes"

# Values of images by the viewer: two images of known pixels; the first is the reference.
awk 'BEGIN { printf "PF\n4 2\n-1.0\n" }' >a.pfm
cp a.pfm b.pfm
for value in '\x00\x00\x80\x3f' '\x00\x00\x00\x40'; do # 1 and 2
  for _ in 1 2 3 4 5 6 7 8 9 10 11 12; do printf '%b' "$value"; done
done | tee -a a.pfm >/dev/null
for value in '\x00\x00\x80\x3f' '\x00\x00\x80\x40'; do # 1 and 4
  for _ in 1 2 3 4 5 6 7 8 9 10 11 12; do printf '%b' "$value"; done
done | tee -a b.pfm >/dev/null
"$aureole" compare a.pfm b.pfm --html view.html >compared.txt
[ $? -eq 1 ] || fail "compare: $(cat compared.txt)"
rmse=$(awk 'NR == 2 { print $2 }' compared.txt)
"$aureole" view a.pfm b.pfm -o alone.html | grep -qx alone.html || fail "view"
TMPDIR=$PWD "$aureole" view a.pfm >place.txt && [ -s "$(cat place.txt)" ] || fail "view into a new folder"
rm -rf ./aureole-view-*
printf 'PF\n1 1\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0' >small.pfm
"$aureole" view a.pfm small.pfm -o none.html 2>message.txt
[ $? -eq 2 ] && grep -q "small.pfm has 1 x 1 pixels, and a.pfm 4 x 2" message.txt || fail "two sizes: $(cat message.txt)"

command -v chromium >/dev/null || { echo "skipped: no chromium: what pages do is not tested"; exit $((failures > 0 ? 1 : 77)); }
see() { # see PAGE HASH: the document after its scripts
  timeout 100 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$PWD/chromium" --window-size=900,700 --virtual-time-budget=4000 \
    --dump-dom "file://$PWD/$1#$2" 2>chromium.txt
}
shows() { # shows WHAT PAGE HASH TEXT...
  local what=$1 page=$2 hash=$3
  shift 3
  see "$page" "$hash" >dom.html
  for text in "$@"; do grep -qF -- "$text" dom.html || fail "$what: no '$text' ($(grep -o 'data-state="[^"]*"' dom.html) $(grep -o '<output>[^<]*' dom.html))"; done
}
shows "the first view" view.html "" 'data-ready="1"' 'data-state="viewer=0&amp;mode=flip&amp;a=1&amp;b=0&amp;e=0'
shows "a pixel" view.html 'viewer=0&mode=flip&a=0&b=1&z=64&x=2.5&y=0.5' 'z=64' 'pixel 2, 0   a.pfm: 2.000 2.000 2.000   b.pfm: 4.000 4.000 4.000' \
  "RMSE of a.pfm against b.pfm: 1.414"
[ "${rmse:0:5}" = 1.414 ] || [ "${rmse:0:5}" = 1.4142 ] || fail "compare says $rmse"
shows "keys" view.html 'viewer=0&keys=1,s,+,e,e,ArrowRight' 'mode=split' 'a=1' 'e=1&amp;'
shows "false colour" view.html 'viewer=0&mode=error&a=1&b=0' 'mode=error' 'RMSE of b.pfm against a.pfm'
shows "to and fro" view.html 'viewer=0&keys=Space,d' 'mode=difference&amp;a=0&amp;b=1'
shows "side by side" view.html 'viewer=0&keys=g,0' 'mode=side'
shows "the report" page/index.html 'sort=1,3&down&theme=dark' 'data-ready="3"' 'aria-sort="descending"' 'color-scheme: dark' 'download="marques-2018-gains.csv"'
rm -rf chromium
exit $((failures > 0))

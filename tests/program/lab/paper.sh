#!/usr/bin/env bash
# Results as papers want them: LaTeX tables, PDF and TikZ plots of given size, data without quotes, raw runs.
set -u
aureole=$1
status=0
fail() { echo "FAILED: $*"; status=1; }
"$aureole" lab run aureole-integrand --quick -q --set esfg:base=16,levels=3 --integrand clamped-cosine -o results >run.txt 2>&1 || fail "$(cat run.txt)"
"$aureole" lab paper results -o paper --width 12 --height 7 --font-size 10 --times --digits 3 >written.txt 2>&1 || fail "$(cat written.txt)"
name=aureole-integrand
while read -r file; do
  [ -s "$file" ] || fail "no $file"
done <written.txt
[ "$(wc -l <written.txt)" -eq 5 ] || fail "$(cat written.txt)"
"$aureole" lab paper nowhere -o other >none.txt 2>&1 && fail "no results"

# The table: the rows and the numbers of the CSV, and only ampersands between them.
grep -q '\\begin{tabular}{lrrrrr}' paper/$name.tex && grep -q '\\bottomrule' paper/$name.tex || fail "$(head -3 paper/$name.tex)"
grep -q '^esfg:base=16,levels=3 & 64 & ' paper/$name.tex || fail "$(cat paper/$name.tex)"
[ "$(grep -c ' & .*\\\\$' paper/$name.tex)" -eq "$(grep -vc '^#' results/$name/$name.csv)" ] || fail "rows of the table"
"$aureole" lab list --format latex | grep -q 'booktabs' || fail "--format latex"
"$aureole" measure sobol -n 64 --domain square -m l2-star --format latex >measure.tex || fail "measure"
grep -q '^sobol & 64 & square & 0\.0[0-9]* \\\\$' measure.tex || fail "$(cat measure.tex)"
# The data: no quotes, as many cells in each line.
awk -F'\t' 'NR == 1 { cells = NF } NF != cells || /"/ { bad = 1 } END { exit bad || NR < 30 }' paper/$name.dat || fail "$(head -3 paper/$name.dat)"
awk 'NR == 1 { cells = NF } NF != cells { bad = 1 } END { exit bad || cells != 28 }' paper/$name-plot-rmse.dat || fail "$(head -3 paper/$name-plot-rmse.dat)"
grep -q "{$name-plot-rmse.dat}" paper/$name-plot-rmse.tex && ! grep -q 'row sep' paper/$name-plot-rmse.tex || fail "numbers in the TikZ"
# 12 cm are 340.2 points.
sed -n 's|.*MediaBox \[0 0 \([0-9.]*\) .*|\1|p' paper/$name-plot-rmse.pdf | awk '{ exit !($1 > 339 && $1 < 342) }' || fail "width of the PDF"
grep -aq 'BaseFont /Times-Roman' paper/$name-plot-rmse.pdf || fail "font"
if command -v pdflatex >/dev/null && kpsewhich pgfplots.sty booktabs.sty >/dev/null 2>&1 && [ "$(kpsewhich pgfplots.sty booktabs.sty | wc -l)" -eq 2 ]; then
  cat >paper/main.tex <<TEX
\documentclass{article}\usepackage{booktabs,pgfplots}\usepgfplotslibrary{groupplots}\pgfplotsset{compat=1.16}
\begin{document}\input{$name}\input{$name-plot-rmse}\end{document}
TEX
  (cd paper && pdflatex -interaction=nonstopmode -halt-on-error main.tex >latex.txt) || fail "LaTeX: $(tail -20 paper/latex.txt)"
fi

# Raw runs: an array for each set and size, whose mean square is the table's.
if python3 -c 'import numpy' 2>/dev/null; then
  python3 - results/$name/$name <<'PYTHON' || fail "raw runs"
import csv, sys
import numpy as np
runs = np.load(sys.argv[1] + "-runs.npz")
rows = list(csv.DictReader(line for line in open(sys.argv[1] + ".csv") if line[0] != "#"))
assert len(runs.files) == len(rows) == 35
for row in rows:
    squares = runs[f"clamped-cosine {row['set']} {row['points']}"]
    assert squares.shape == (16,) and abs(np.sqrt(squares.mean()) - float(row["rmse"])) < 1e-15
PYTHON
fi
exit $status

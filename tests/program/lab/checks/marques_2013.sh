# The figures of Marques 2013, and rotations that are correlated between pixels.
of() { echo "$results/marques-2013-$1/marques-2013-$1.csv"; }
# Fig. 2: four sets in the square and under two maps. The least distance is that of the measure; spherical Fibonacci's is the largest.
distance=$("$aureole" measure sobol -n 128 -m min-distance --domain square --scramble digit --format csv | awk -F, 'NR == 2 { print $4 }')
awk -F, -v d="$distance" '/^#/ || $1 == "set" { next } { ++rows }
  $1 == "sobol" && $2 == "square" { off = $4 - d * sqrt(128); if (off * off < 1e-20) found = 1 }
  $1 == "spherical-fibonacci" { fibonacci = $4 } $2 == "lambert" || $2 == "concentric" { if ($4 > most) most = $4 }
  END { exit !(rows == 10 && found && fibonacci > most) }' "$(of fig2)" || fail "fig. 2"
[ -s "$results/marques-2013-fig2/marques-2013-fig2-drawing.png" ] || fail "the drawing of fig. 2"
[ "$(grep -c '' "$results/marques-2013-fig2/marques-2013-fig2-points.csv")" -eq 1281 ] || fail "the points of fig. 2"
# Fig. 3: the energy is that of the measure, spherical Fibonacci's the least, and slopes are those of the rows.
energy=$("$aureole" measure spherical-fibonacci -n 64 -m energy --domain sphere --format csv | awk -F, 'NR == 2 { print $4 }')
awk -F, -v e="$energy" '/^#/ || $1 == "domain" { next } { ++rows }
  $2 == "spherical-fibonacci" { least[$1 $4] = $5 }
  $2 != "spherical-fibonacci" && !($5 > least[$1 $4]) { bad = 1 }
  $1 == "sphere" && $2 == "spherical-fibonacci" && $4 == 64 { off = $5 / e - 1; if (off * off > 1e-24) bad = 1 }
  END { exit bad || rows != 56 }' "$(of fig3)" || fail "fig. 3"
# Least squares for x = 0, 1, 2 (directions that double) are half the last minus the first.
slopes() { awk -F, -v by="$3" '/^#/ { next } FNR == 1 { ++file; next }
  file == 1 { n[$by]++; y[$by, n[$by]] = log($6); next }
  { key = $by; slope = (y[key, 3] - y[key, 1]) / (2 * log(2)); off = slope - $5; if (!(off * off < 1e-20)) bad = 1; ++rows }
  END { exit bad || rows != 14 }' "$1" "$2"; }
# Fig. 4: 7 patterns of 2 components at 3 counts, every error above 0 and less with four times the directions.
fig4=$(of fig4)
sed 's/,/ /; s/,/ /; s/,/ /; s/ /:/g; s/,/,,,,/' "$fig4" >fig4.txt
sed 's/,/ /; s/,/ /; s/,/ /; s/ /:/g; s/,/,,,,/' "${fig4%.csv}-slopes.csv" >slopes.txt
awk -F, '/^#/ || /^scene/ { next } { ++rows; if (!($6 > 0 && $7 <= $6 && $6 <= $8)) bad = 1
    if ($5 == 16) first[$1] = $6; if ($5 == 64 && !($6 < first[$1])) bad = 1 }
  END { exit bad || rows != 42 }' fig4.txt || fail "fig. 4"
slopes fig4.txt slopes.txt 1 || fail "slopes of fig. 4"
# Figs 5 to 7: 7 patterns in 2 windows, each with its image, and a sheet a window.
awk -F, '/^#/ || $1 == "scene" { next } { ++rows; if (!($6 > 0 && $8 >= $6)) bad = 1 } END { exit bad || rows != 14 }' \
  "$(of closeups)" || fail "close-ups"
for picture in sheet,_cornell-box,_block cornell-box,_hare-sobol_concentric cornell-box,_hare-reference cornell-box; do
  [ -s "$results/marques-2013-closeups/marques-2013-closeups-$picture.png" ] || fail "no image $picture"
done
# Fig. 1: two quantities at three counts.
awk -F, '/^#/ || $1 == "pattern" { next } { ++rows; if (!($4 > 0 && $5 > 0 && $6 > 0 && $7 <= $6 && $6 <= $8)) bad = 1 }
  END { exit bad || rows != 6 }' "$(of fig1)" || fail "fig. 1"
# Rotations: after a blur one pattern everywhere leaves more than random turns at 16 directions, by half and more.
awk -F, '/^#/ || $1 == "pattern" { next } { ++rows }
  $2 == "none" && $3 == "Gaussian 1" && $4 == 16 && !($8 > 1.2) { bad = 1 } $2 == "random" && $8 != 1 { bad = 1 }
  END { exit bad || rows != 48 }' "$results/aureole-correlated-rotations/aureole-correlated-rotations.csv" || fail "rotations"

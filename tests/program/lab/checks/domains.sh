# docs/domains.md. What is at rest has the least energy, to the last bits of its sum; a prefix and a shell have a few per cent more.
awk -F, '$1 ~ /^electrostatic/ && !($5 > -1e-9 && $5 < 6) { bad = 1 } END { exit bad || NR != 8 }' \
  "$results/domains-axes/domains-axes.csv" || fail "axes"
# The first row is the grid's base twice: 250 and 500 rotations.
awk -F, 'NR > 1 && !($4 > 1 && $4 < 1.2 && $5 < 1 && $6 < 1.4) { bad = 1 } END { exit bad || NR != 3 }' \
  "$results/domains-grids/domains-grids.csv" || fail "grids"
# Charges at rest are the most even, the spiral next, and every prefix is behind both.
awk -F, 'NR == 2 { rest = $3 } NR == 3 && !($3 > rest) { bad = 1 } NR == 3 { spiral = $3 } NR > 3 && !($3 > spiral) { bad = 1 }
  END { exit bad || NR != 8 }' "$results/domains-prefixes/domains-prefixes.csv" || fail "prefixes"
# Two sizes of each lift. E-SFG with several turns has no hole and no close pair beside the spiral; with one turn each it has both.
awk -F, 'NR > 1 { ++rows } /^"?esfg-rotations/ && !($(NF-2) < 1.2 && $(NF-1) > 0.7 && $NF < 1.1) { bad = 1 }
  /^"?E-SFG, turns i sqrt/ && !($(NF-2) > 1.2) { bad = 1 } END { exit bad || rows != 18 }' \
  "$results/domains-lifts/domains-lifts.csv" || fail "lifts"
# Greedy points at every number up to 128, and the others behind them.
awk -F, '/^#/ { next } $1 == "greedy" { greedy = $4; if (!($4 <= 1.12 && $6 < $4)) bad = 1 }
  NR > 2 && !($4 > greedy) { bad = 1 } { ++rows } END { exit bad || rows != 6 }' \
  "$results/domains-every-number/domains-every-number.csv" || fail "every number"

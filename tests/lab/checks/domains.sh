# docs/domains.md. What is at rest has the least energy, to the last bits of its sum; a prefix and a shell have a few per cent more.
awk -F, '$1 ~ /^electrostatic/ && !($5 > -1e-9 && $5 < 6) { bad = 1 } END { exit bad || NR != 8 }' \
  "$results/domains-axes/domains-axes.csv" || fail "axes"
# The first row is the grid's base twice: 250 and 500 rotations.
awk -F, 'NR > 1 && !($4 > 1 && $4 < 1.2 && $5 < 1 && $6 < 1.4) { bad = 1 } END { exit bad || NR != 3 }' \
  "$results/domains-grids/domains-grids.csv" || fail "grids"
# Charges at rest are the most even, the spiral next, and every prefix is behind both.
awk -F, 'NR == 2 { rest = $3 } NR == 3 && !($3 > rest) { bad = 1 } NR == 3 { spiral = $3 } NR > 3 && !($3 > spiral) { bad = 1 }
  END { exit bad || NR != 8 }' "$results/domains-prefixes/domains-prefixes.csv" || fail "prefixes"

# Intervals of irradiance. Of 180 runs, or 500, of an interval of 95 % fewer than 88 % hold once in 10^4 rows; the means are
# within five of their own standard errors.
awk -F, '!/^#/ && NR > 1 { ++rows
    bias = $5 < 0 ? -$5 : $5
    if (!($4 >= .88) || !(bias <= 5 * $6 / sqrt($3)) || ($1 ~ /pooled/ && !($4 >= .92 && $4 <= .98))) bad = 1 }
  END { exit bad || rows != 12 }' "$results/irradiance-coverage/irradiance-coverage.csv" || fail "intervals of irradiance"

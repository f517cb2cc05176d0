# Intervals of view factors, radiosities, images and measures. Numbers of one run are not independent (rows add up), so that a
# case has the weight of its seeds: of 100 seeds an interval of 95 % holds in fewer than 87 % once in 2000 times.
awk -F, '!/^#/ && NR > 1 { ++rows; if (!($4 >= .87 && $3 >= 1000) || ($1 == "pooled" && !($4 >= .93 && $4 <= .97))) bad = 1 }
  END { exit bad || rows != 9 }' "$results/factors-coverage/factors-coverage.csv" || fail "intervals of view factors"
# 40 renders that an error stops, and 40 of two rounds: fewer than 34 hold once in 200 times.
awk -F, '!/^#/ && NR > 1 { ++rows; if (!($4 >= .85)) bad = 1 } END { exit bad || rows != 6 }' \
  "$results/image-coverage/image-coverage.csv" || fail "intervals of images"

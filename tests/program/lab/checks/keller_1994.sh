# Keller's tables: every row has a published number or says that there is none, the deviations fall with N, and the ratio and
# spread that do not depend on the scene are what they must be.
csv() { echo "$results/keller-1994-table$1/keller-1994-table$1.csv"; }
# The verdict of each row is that of its own figures, and they are counted.
awk -F, '/^# of [0-9]+ published/ { split($0, word, " "); counted = word[3] " " word[6] " " $2 }
         !/^#/ && NR > 1 { verdict = "differs"
                           if ($7 / $4 <= 1.5 && $7 / $4 >= 1 / 1.5) verdict = "within a factor of 1.5"
                           if ($7 >= $5 && $7 <= $6) verdict = "agrees"
                           if ($7 == "") verdict = "not published"
                           ++count[verdict]
                           if ($9 != verdict || ($7 != "" && ($8 - $7 / $4) ^ 2 > 1e-20)) bad = 1 }
         END { split(counted, word, " ")
               exit bad || word[1] != count["agrees"] + count["within a factor of 1.5"] + count["differs"] || word[2] != count["agrees"] }' \
  "$(csv 3)" || fail "Keller, verdicts"
awk -F, '!/^#/ && NR > 1 { ++rows; if (!($5 <= $4 && $4 <= $6 && $4 >= 3000 && $8 > 0.4 && $8 < 2.5)) bad = 1 }
         END { exit !(rows == 6 && !bad) }' "$(csv 1)" || fail "Keller, table 1"
for table in 2 3; do
  awk -F, '!/^#/ && NR > 1 { ++rows; if (!($5 <= $4 && $4 <= $6)) bad = 1; if ($2 == 1000) first[$1 $3] = $4
                             if ($2 == 10000 && !($4 < 0.75 * first[$1 $3])) bad = 1 }
           END { exit !(rows == 12 && !bad) }' "$(csv $table)" || fail "Keller, table $table"
done
# By algebra, for 12 equal triangles; and the corridor in the published range.
awk -F': ' '/Delta_a \/ Delta_aw of the cube/ { cube = $2 } /1 x 1 x 26/ { box = $2 }
            END { exit !(cube > 3.463 && cube < 3.465 && box > 7.9 && box < 11) }' "$(csv 2)" || fail "Keller, the ratios"
# Independent points: 8 solutions of a skewed quantity each, within 30 %; two scenes. In the office, which has many triangles,
# paths of two flights have what follows for paths that never come back.
awk '/Delta_aw sqrt N of independent/ {
       ++scenes
       count = 0
       rest = $0
       while (match(rest, /0\.[0-9]+/)) { value[++count] = substr(rest, RSTART, RLENGTH); rest = substr(rest, RSTART + RLENGTH) }
       if (count != 8 || !(value[1] > 0.117 && value[1] < 0.217 && value[3] > 0.1 && value[3] < 0.188)) bad = 1
       if (/office/) for (i = 5; i <= 7; i += 2) if (!(value[i] > 0.7 * value[i + 1] && value[i] < 1.3 * value[i + 1])) bad = 1 }
     END { exit !(scenes == 2 && !bad) }' "$(csv 3)" || fail "Keller, the spread"
# One opening, fitted at the larger N, gives the published values of table 3 at both; unlit faces have the floors they are fitted to.
awk -F, '!/^#/ && NR > 1 { ++rows; if ($2 == "open" && $4 == 3 && !($10 > 0.75 && $10 < 1.33)) bad = 1
                           if ($2 == "unlit" && $4 == 3 && $5 == 10000) { ++fitted; over += log($10) } }
         END { exit !(rows == 36 && fitted == 3 && over < 0.01 && over > -0.01 && !bad) }' \
  "$results/keller-1994-floor/keller-1994-floor.csv" || fail "Keller, the floor"
# Twelve equal triangles have the root of 12 between the tables, whatever the points, and whichever come first.
awk -F, '!/^#/ && NR > 1 { ++rows; key = $1 $2 $4
                           if ($3 == 2) plain[key] = $5
                           else { ratio = plain[key] / $5; if ($1 == "cube" ? (ratio * ratio / 12 - 1) ^ 2 > 1e-18 : $2 == "halton" && ratio < 4) bad = 1 } }
         END { exit !(rows == 48 && !bad) }' "$results/keller-1994-boxes/keller-1994-boxes.csv" || fail "Keller, the boxes"
awk -F, '!/^#/ && NR > 1 { ++rows; if ($10 != 1 || $7 > 15 || $7 < -15) bad = 1 } END { exit !(rows == 3 && !bad) }' \
  "$results/keller-1994-figure1/keller-1994-figure1.csv" || fail "Keller, the images"
# Permuted lights take fewer rays, sharing takes few more, adaptive oversampling fewer for .03; and a mirror changes nothing.
awk -F, '!/^#/ && NR > 1 { rays[$1 $3] = $5; ++rows }
     END { exit !(rows == 13 && rays["permuted lightspermuted"] < 0.3 * rays["permuted lightsall lights"] &&
                  rays["neighbour sharingshared"] < 1.5 * rays["neighbour sharingseparate samples"] &&
                  rays["oversamplingadaptive to .03"] < rays["oversamplingadaptive to .01"]) }' \
  "$results/keller-1994-features/keller-1994-features.csv" || fail "Keller, the features"
awk -F, '/^# claim.*: holds$/ { said = 1 } $1 == "mirror" && $2 == 100000 { found = $3 } END { exit !(said && found > 0 && found < 6e-4) }' \
  "$results/keller-1994-mirrors/keller-1994-mirrors.csv" || fail "Keller, the mirror"

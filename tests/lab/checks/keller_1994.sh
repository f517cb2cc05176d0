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
# Independent points: 8 solutions of a skewed quantity each, within 30 %; two scenes.
awk '/Delta_aw sqrt N of independent/ {
       ++scenes
       for (i = 1; i < NF; ++i) if ($i == "points") { uniform = $(i + 1); cosine = $(i + 6) }
       if (!(uniform > 0.117 && uniform < 0.217 && cosine > 0.1 && cosine < 0.188)) bad = 1 }
     END { exit !(scenes == 2 && !bad) }' "$(csv 3)" || fail "Keller, the spread"

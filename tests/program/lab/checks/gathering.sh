# Patterns in images: final gathering and ambient occlusion.
gather=$results/marques-2013-gather/marques-2013-gather
# A row a component and pattern, each interval about its value, and Sobol's error above spherical Fibonacci's.
awk -F, '!/^#/ && NR > 1 { ++rows; if (!($5 <= $4 && $4 <= $6 && $4 > 0)) bad = 1; rmse[$1 "/" $2] = $4 }
         END { exit !(rows == 4 && !bad && rmse["diffuse/sobol"] > rmse["diffuse/spherical-fibonacci"] &&
                      rmse["glossy/sobol"] > rmse["glossy/spherical-fibonacci"]) }' \
  "$gather.csv" || fail "the table"
grep -q '^# bias of finalgather against path' "$gather.csv" || fail "the bias"
for picture in diffuse-reference glossy-sobol whole_light-finalgather whole_light-path; do
  [ -s "$gather-$picture.png" ] || fail "no image $picture"
done

# Table 1: 2 components x 2 maps x 2 rivals of spherical Fibonacci, each interval about its ratio; no rival is better than
# chance allows (a quarter below it would be), and all means together are worse.
awk -F, '/^#/ || $1 == "scene" { next }
         { ++rows; if (!($5 > 0 && $7 <= $6 && $6 <= $8 && $6 > 0.75 && $9 > 0 && $11 >= 1 && $10 > 512)) bad = 1; sum += log($6) }
         END { exit !(rows == 8 && !bad && sum > 0) }' "$results/marques-2013-table1/marques-2013-table1.csv" || fail "the table of table 1"

# The claim that none is better than spherical Fibonacci holds where no interval lies below 1, and is counted.
claim="does not hold"
awk -F, '!/^#/ && $1 != "scene" && $8 < 1 { bad = 1 } END { exit bad }' "$results/marques-2013-table1/marques-2013-table1.csv" && claim=holds
grep -q "^# claim: spherical Fibonacci is never outperformed: .*: $claim\$" "$results/marques-2013-table1/marques-2013-table1.csv" || fail "the claim"
awk -F, -v hold="$([ "$claim" = holds ] && echo 1 || echo 0)" 'NR == 2 && !($(NF-1) == 1 && $NF == hold) { bad = 1 } END { exit bad }' \
  "$results/marques-2013-table1/marques-2013-table1-run.csv" || fail "the count of claims"

# Ambient occlusion: 5 sets x 2 counts x 2 forms, each interval about its value; every set below random numbers at 64
# samples, where even the least of the gains is 2; and errors that are independent from pixel to pixel only where the set is
# randomised for each: banding is 1 then, up to its own scatter of about .1, and above 1.2 when it is not.
awk -F, '/^#/ || $1 == "pattern" { next }
         { ++rows; if (!($5 <= $4 && $4 <= $6 && $4 > 0)) bad = 1
           if ($2 == 64 && $1 != "random" && !($7 < 0.6)) bad = 1
           if ($3 == "pixel" ? !($8 > 0.7 && $8 < 1.3) : !($8 > 1.2)) bad = 1 }
         END { exit !(rows == 20 && !bad) }' "$results/schretter-2012-fig5/schretter-2012-fig5.csv" || fail "the table of fig. 5"
[ -s "$results/schretter-2012-fig5/schretter-2012-fig5-16_samples,_randomised_for_each_pixel-golden-set.exr" ] || fail "no image of fig. 5"

# Golden ratio sequences. Star discrepancies by brute force: .17214 .03557 .02672 of golden sets of 10, 64 and 100 points, .0537 of
# Hammersley's 64.
golden=$results/schretter-2012
awk -F, '$1 == "golden-set" && $2 == 10 && ($3 / .17214 - 1) ^ 2 < 1e-8 { ++good }
         $1 == "golden-set" && $2 == 64 && ($3 / .03557 - 1) ^ 2 < 1e-7 { ++good }
         $1 == "golden-set" && $2 == 100 && ($3 / .02672 - 1) ^ 2 < 1e-7 { ++good }
         $1 == "hammersley" && $2 == 64 && ($3 / .0537 - 1) ^ 2 < 1e-6 { ++good }
         END { exit good != 4 }' "$golden-sets/schretter-2012-sets.csv" || fail "star discrepancies"
grep -q '^# claim: fig. 2: .*: holds' "$golden-sets/schretter-2012-sets.csv" || fail "the projections of a golden set"
[ -s "$golden-sets/schretter-2012-sets-fig._3,_polar-golden-set.png" ] || fail "no image of polar coordinates"
# Five numbers: gaps by hand, 1/4 and 1/8 of van der Corput's, frac(2 Phi) and 5 (Phi - 1) - 3 of the golden sequence.
awk -F, '$1 == "van der Corput" && $2 == 5 && $3 == 1.25 && $4 == .625 { ++good }
         $1 == "golden ratio" && $2 == 5 && ($3 / 5 - .2360679774997897) ^ 2 < 1e-24 && ($4 / 5 - .0901699437494742) ^ 2 < 1e-24 { ++good }
         END { exit good != 2 }' "$golden-gaps/schretter-2012-gaps.csv" || fail "gaps"
[ "$(grep -c '^# claim: .*: holds' "$golden-gaps/schretter-2012-gaps.csv")" -eq 7 ] || fail "claims on golden sequences"
grep -q '^# claim: .*up to 2 in a row): does not hold' "$golden-gaps/schretter-2012-gaps.csv" || fail "what eq. 7 has to skip"
grep -q 'van der Corput over golden' "$golden-gaps/schretter-2012-gaps-timings.csv" || fail "times"
# Both sets follow both densities.
[ "$(grep -c '^# claim: .*: holds' "$golden-warp/schretter-2012-warp.csv")" -eq 2 ] || fail "warped points"
[ -s "$golden-warp/schretter-2012-warp-ramp-golden-set.exr" ] || fail "no image of warped points"

# The analytical lighting cases: references of two derivations agree to 1e-9, every point is within 3 % of its case's largest
# value, none is beyond five standard errors, and as many are outside of their intervals as chance allows. The experiment says
# so itself; here its words are held against its table.
csv=$results/analytical-cases/analytical-cases.csv
awk -F, '/^#/ || $1 == "case" { next }
         { ++rows; points += $3; outside += $7
           if (!($3 >= 5 && $4 <= 1e-9 && $5 <= 3e-2 && $6 <= 5)) { print "FAILED: " $0; bad = 1 } }
         END { exit bad || rows != 34 || points < 330 || outside > 10 }' "$csv" || fail "analytical cases"
grep -q '^# verdict: all holds' "$csv" || fail "the verdict on analytical cases"

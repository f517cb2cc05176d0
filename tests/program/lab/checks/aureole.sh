# Every set but those of one coordinate and of files by every measure, with the figures that `measure` prints.
csv=$results/aureole-every-measure/aureole-every-measure.csv
"$aureole" sets --format csv | tail -n +2 | cut -d, -f1 | grep -vxE 'van-der-corput|golden|file|matrices' >every.txt
while read -r set; do
  grep -q ",$set," "$csv" || fail "no row of $set in every measure"
done <every.txt
for metric in energy covering wce:1.5; do
  measured=$("$aureole" measure spherical-fibonacci -n 64 --domain sphere --metric $metric --format csv | tail -1 | cut -d, -f4)
  grep -qx "sphere,$metric,spherical-fibonacci,64,$measured" "$csv" || fail "$metric of spherical Fibonacci points: not $measured"
done

#!/usr/bin/env bash
# aureole irradiance --bifacial and --tracker: the sums of fixed modules are those of --weather for both sides, an hour of a tracker is
# that of modules fixed at its rotation, and what is refused.
. "$2/tests/lighting/checks.sh.inc"
command=irradiance
bash "$2/scripts/weather.sh" 48 11 1 | head -80 >days.epw # three days
cat >module.rad <<'RAD'
void plastic panel 0 0 5 .1 .1 .1 0 0
panel polygon module 0 0 12 -1 -10 0 1 -10 0 1 10 0 -1 10 0
RAD
cat >site.rad <<'RAD'
void plastic soil 0 0 5 .2 .2 .2 0 0
soil polygon ground 0 0 12 -60 -60 0 60 -60 0 60 60 0 -60 60 0
!xform -ry $angle -t -5 0 1.5 -a 3 -t 5 0 0 module.rad
RAD
printf '0 0 1.5 0 0 1\n.5 2 1.5 0 0 2\n' >cells.pts
run() { "$aureole" irradiance -q site.rad --weather days.epw -n 256 "$@" || fail "$*"; }
# column NAME FILE
column() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) k = i } NR > 1 { printf "%.6e\n", $k }' "$2"; }

# Fixed modules: the two sides of each sensor, in Wh/m2.
printf '0 0 1.5 0 0 1\n.5 2 1.5 0 0 1\n0 0 1.5 0 0 -1\n.5 2 1.5 0 0 -1\n' >sides.pts
run -D angle=20 --sensors cells.pts --bifacial -o fixed.csv
run -D angle=20 --sensors sides.pts --efficacy none -o sides.csv
cmp -s <(column front fixed.csv; column rear fixed.csv) <(column annual_lux_hours sides.csv) || fail "both sides: $(cat fixed.csv sides.csv)"
awk -F, 'NR > 1 { x = 100 * $6 / $4; d = $8 - x; e = $9 - 100 * ($7 + $6 / $4 * $5) / $4; exit !(d * d < 1e-12 * x && e * e < 1e-12 && $6 > 0) }' fixed.csv || fail "gains"

# A tracker: its rotations, whose modules and sensors turn, in the hours of each. Right-handed about the north: east in the morning.
run --sensors cells.pts --tracker 0,0,60,.4,15 --rotation angle --pivot 0,0,1.5 --series hours.csv -o tracker.csv
awk -F, 'NR > 1 && $5 != "" { if ($4 < 12 && $5 < 0 || $4 > 13 && $5 > 0) exit 1; ++n } END { exit !(n > 20) }' hours.csv || fail "rotations"
awk -F, 'NR > 1 { front[$1] += $6; rear[$1] += $8 } END { for (i = 0; i < 2; ++i) printf "%.6e\n%.6e\n", front[i], rear[i] }' hours.csv >sums
cmp -s sums <(paste -d'\n' <(column front tracker.csv) <(column rear tracker.csv)) || fail "sums of hours: $(cat sums tracker.csv)"
rotation=$(awk -F, '$1 == 0 && $3 == 1 && $4 == 10 { print $5 }' hours.csv)
awk -v t="$rotation" 'BEGIN { t *= 3.14159265358979323846 / 180; c = cos(t); s = sin(t)
  for (k = 1; k >= -1; k -= 2) for (i = 0; i < 2; ++i)
    printf "%.17g %d %.17g %.17g 0 %.17g\n", .5 * i * c, 2 * i, 1.5 - .5 * i * s, k * s, k * c }' >turned.pts
run -D angle="$rotation" --sensors turned.pts --efficacy none --series turned.csv -o sides.csv
here() { awk -F, -v "$1" '$2 == 1 && $3 == 1 && $4 == 10 { '"$2"' }' "$3"; }
[ "$rotation" != 0 ] || fail "no rotation"
paste <(here x=6 'print $x, $(x + 1)' hours.csv; here x=8 'print $x, $(x + 1)' hours.csv) <(here x=5 'print $x, $(x + 1)' turned.csv) |
  awk '{ d = $1 - $3; n += d * d <= 1e-8 * $3 * $3 && $3 > 0 } END { exit n != 4 }' || fail "an hour: $(here x=0 'print' hours.csv; here x=0 'print' turned.csv)"
# The same normals by a table, in a scene that does not turn; JSON has the same numbers.
awk -F, 'NR > 1 && $1 == 0 { t = $5 * 3.14159265358979323846 / 180; print $5 == "" ? "0 0 0" : sprintf("%.17g,0,%.17g # %s", sin(t), cos(t), $5) }' hours.csv >normals.csv
run -D angle=0 --sensors cells.pts --pivot 0,0,1.5 --tracker normals.csv -o table.csv
run -D angle=0 --sensors cells.pts --pivot 0,0,1.5 --tracker 0,0,60,.4,15 -o table2.csv
cmp -s <(column front table.csv) <(column front table2.csv) || fail "a table: $(cat table.csv table2.csv)"
cmp -s <(column front table.csv) <(column front tracker.csv) && fail "modules do not turn"
run -D angle=20 --sensors cells.pts --bifacial --json -o fixed.json
python3 - <<'PY' || fail "JSON"
import csv, json
rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(open("fixed.csv"))]
assert rows == json.load(open("fixed.json"))
PY
# Rear sensors are lifted to their own side, where the module hides the sky straight above.
run -D angle=0 --sensors cells.pts --bifacial --lift .01 -o lifted.csv
awk -F, 'NR == 2 { exit !($6 > 0 && $6 < .4 * $4) }' lifted.csv || fail "lift: $(cat lifted.csv)"

# A year without light has no gain.
awk -F, -v OFS=, 'NR > 8 { $14 = $15 = $16 = 0 } { print }' days.epw >dark.epw
"$aureole" irradiance site.rad -D angle=0 --weather dark.epw -n 16 --sensors cells.pts --bifacial -o dark.csv 2>said && grep -q "no light on its front over the whole year" said || fail "a dark year: $(cat said)"
[ "$(sed -n 2p dark.csv | cut -d, -f4-)" = 0,0,0,0,nan,nan ] || fail "a dark year: $(cat dark.csv)"

args="site.rad --weather days.epw --sensors cells.pts -n 16"
refused '$angle is not defined' $args --bifacial
refused "--rotation needs --tracker" $args --rotation angle
refused "--bifacial needs --weather" site.rad --sensors cells.pts --bifacial
refused "--threshold cannot be used with --bifacial" $args --bifacial --threshold 100
refused "write csv or json, not npy" $args --bifacial --to npy
refused "the scene has no \$turn" $args -D angle=0 --tracker 0,0,60,.4 --rotation turn
refused "a limit above 0 and up to 90" $args -D angle=0 --tracker 0,0,100,.4
refused "a tilt from 0 to 90" $args -D angle=0 --tracker 95,0,60,.4
refused "not 'normals.csv'" $args --tracker normals.csv --rotation angle
head -20 normals.csv >short.csv
refused "short.csv: 20 hours, and the weather has 72" $args -D angle=0 --tracker short.csv
sed 's/^0 0 0/x/' normals.csv >bad.csv
refused "bad.csv:1: a normal of three numbers expected" $args -D angle=0 --tracker bad.csv
sed 's/.*/0 0 -1/' normals.csv >under.csv
refused "opposite to that of sensor 0" $args -D angle=0 --tracker under.csv
sed 's/.*/0 0 0/' normals.csv >none.csv
refused "no hour has a normal" $args -D angle=0 --tracker none.csv
refused "a .csv file expected" $args -D angle=0 --bifacial --series hours.npy
refused "a point like 0,0,1.5 expected" $args --tracker 0,0,60,.4 --pivot 1,2
finish

#!/usr/bin/env bash
# aureole irradiance --weather: years with known sums, an hour by coefficients beside the same hour traced by itself, the same
# bits on any number of threads, and what is refused or reported.
. "$2/tests/lighting/checks.sh.inc"
weather=$2/scripts/weather.sh
command=irradiance
# cell COLUMN LINE FILE
cell() {
  awk -F, -v name="$1" -v line="$2" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i }
    NR == line { print $column }' "$3"
}
near() {
  awk -v value="$2" -v truth="$3" -v tolerance="$4" 'BEGIN { d = value - truth; exit !(d <= tolerance && -d <= tolerance) }' ||
    fail "$1 is $2, not $3 to $4"
}

# Three days of each month are as the script has them, the others dark: lit hours are what takes time.
some_days() { awk -F, -v OFS=, 'NF > 30 && $3 % 10 != 0 { $14 = $15 = $16 = 0 } { print }'; }
bash "$weather" 48 11 1 | some_days >mixed.epw
bash "$weather" 48 11 1 3 | some_days >overcast.epw
printf '0 0 .01 0 0 1\n' >up.pts
printf '<scene version="3.0.0"><shape type="rectangle"><transform name="to_world"><scale value="1000"/></transform>
<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape></scene>' >plane.xml

# A plane under only the sky: the factor is 100 %, and each overcast hour what the file says, by any patches.
for patches in tregenza reinhart:2; do
  "$aureole" irradiance -q plane.xml --sensors up.pts --weather overcast.epw --up 0,0,1 --efficacy 179 --patches $patches \
    --series hours.csv -o plane.csv || fail "a plane"
  error=$(cell daylight_factor_error 2 plane.csv)
  near "the daylight factor" "$(cell daylight_factor 2 plane.csv)" 100 "$(awk "BEGIN { print 5 * $error + 1e-4 }")"
  tail -8760 overcast.epw | cut -d, -f16 | paste -d, - <(tail -8760 hours.csv | cut -d, -f5,6) |
    awk -F, '{ d = $2 - 179 * $1; if (d < 0) d = -d; worst = d > 5 * $3 + 1e-6 * $2 ? 1 : worst } END { exit worst || NR != 8760 }' ||
    fail "overcast hours by $patches"
done
[ "$(cell autonomy 2 plane.csv)" != "" ] || fail "columns: $(head -1 plane.csv)"
# The annual sum is that of the hours.
near "the annual sum" "$(cell annual_lux_hours 2 plane.csv)" \
  "$(awk -F, 'NR > 1 { sum += $5 } END { printf "%.3f", sum }' hours.csv)" 10

# Behind a black mask that lets half through, all over the sky, each of them is half, sun and all, but for the ground that the
# mask hides.
sed 's|</scene>|<shape type="rectangle"><transform name="to_world"><scale value="90000"/><translate z="1"/></transform>\
<bsdf type="mask"><float name="opacity" value=".5"/><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf>\
</shape></scene>|' plane.xml >mask.xml
for scene in plane mask; do
  "$aureole" irradiance -q $scene.xml --sensors up.pts --weather mixed.epw --up 0,0,1 -n 2048 -o $scene.csv || fail "a year of $scene"
done
[ "$(cell sun_hours 2 plane.csv)" != 0 ] || fail "no hour of sun"
for column in daylight_factor annual_lux_hours; do
  near "half the $column" "$(cell $column 2 mask.csv)" "$(awk "BEGIN { print $(cell $column 2 plane.csv) / 2 }")" \
    "$(awk "BEGIN { print 5 * sqrt($(cell ${column}_error 2 mask.csv) ^ 2 + $(cell ${column}_error 2 plane.csv) ^ 2) }")"
done

# An hour beside a wall and on a floor that reflect, clear or overcast: by coefficients, and by the sky and the sun of the
# same hour traced by themselves. Patches have the sky's mean radiance: 1.5 % is what 10 degrees leave of a clear sky here,
# and .3 % of an overcast one. So with the daylight factor: lux from a sky of 100.
room='<shape type="cube"><transform name="to_world"><scale x="3" y=".1" z="2"/><translate y="1.5" z="1"/></transform>
<bsdf type="diffuse"><rgb name="reflectance" value=".6"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="20"/></transform><bsdf type="diffuse"/></shape>'
keys='<string name="date" value="2001-06-10"/><string name="time" value="TIME"/><float name="latitude" value="48"/>
<float name="longitude" value="11"/><float name="timezone" value="1"/><vector name="up" value="0 0 1"/>'
printf '0 0 .5 0 0 1\n1 .8 .7 0 -1 0\n-2 1 1 .5 .5 .7\n' >yard.pts
bed='<scene version="3.0.0">'$room
echo "$bed</scene>" >yard.xml
# compare TOLERANCE: of the three sensors, numbers in now.txt (value and error a line) beside those that were traced, hour.csv.
compare() {
  for sensor in 0 1 2; do
    read -r lux error <<<"$(sed -n $((sensor + 1))p now.txt)"
    truth=$(cell lux $((sensor + 2)) hour.csv)
    own=$(cell lux_error $((sensor + 2)) hour.csv)
    near "sensor $sensor of $1" "$lux" "$truth" "$(awk "BEGIN { print $2 * $truth + 4 * sqrt($error ^ 2 + $own ^ 2) }")"
  done
}
for row in 'mixed 0.015' 'overcast 0.003'; do
  read -r file tolerance <<<"$row"
  "$aureole" irradiance -q yard.xml --sensors yard.pts --weather $file.epw -n 16384 --efficacy 179 --ground-albedo 0 \
    --up 0,0,1 --series hours.csv -o yard.csv || fail "a yard"
  line=$(grep -n "^2001,6,10,13," $file.epw | cut -d: -f1)
  read -r direct diffuse <<<"$(awk -F, -v line="$line" 'NR == line { print $15, $16 }' $file.epw)"
  timed=${keys/TIME/12:30}
  cat >hour.xml <<XML
$bed<emitter type="sky"><string name="model" value="perez"/><float name="direct_normal" value="$direct"/>
<float name="diffuse_horizontal" value="$diffuse"/>$timed</emitter>
<emitter type="sun"><rgb name="irradiance" value="$direct"/>$timed</emitter></scene>
XML
  "$aureole" irradiance -q hour.xml --sensors yard.pts -n 16384 --illuminance rec709 -o hour.csv || fail "an hour"
  grep '^[012],6,10,13,' hours.csv | cut -d, -f5,6 --output-delimiter=' ' >now.txt
  compare "a $file hour" "$tolerance"
done
echo "$bed<emitter type='sky'><float name='illuminance' value='100'/><vector name='up' value='0 0 1'/></emitter></scene>" >hour.xml
"$aureole" irradiance -q hour.xml --sensors yard.pts -n 16384 --illuminance rec709 -o hour.csv || fail "an overcast sky"
for sensor in 2 3 4; do echo "$(cell daylight_factor $sensor yard.csv) $(cell daylight_factor_error $sensor yard.csv)"; done >now.txt
compare "daylight factors" 0.003

# The same bits on any number of threads, and beside any other sensors.
"$aureole" irradiance -q hour.xml --sensors yard.pts --weather mixed.epw -n 1024 --threads 1 -o one.csv || fail "one thread"
"$aureole" irradiance -q hour.xml --sensors yard.pts --weather mixed.epw -n 1024 --threads 3 -o three.csv || fail "three threads"
cmp one.csv three.csv || fail "threads change results"
tail -1 yard.pts >last.pts
"$aureole" irradiance -q hour.xml --sensors last.pts --weather mixed.epw -n 1024 -o last.csv || fail "one sensor"
[ "$(tail -1 last.csv)" = "$(tail -1 one.csv)" ] || fail "a sensor depends on the others"

# Formats, and the summary.
for format in json npy ply; do
  "$aureole" irradiance -q hour.xml --sensors last.pts --weather mixed.epw -n 64 -o "last.$format" || fail "$format"
done
"$aureole" irradiance -q hour.xml --sensors last.pts --weather mixed.epw -n 64 --series hours.npy -o last.csv || fail "NPY"
[ "$(stat -c %s hours.npy)" = $((128 + 2 * 8760 * 8)) ] || fail "the series is $(stat -c %s hours.npy) bytes"
"$aureole" irradiance hour.xml --sensors last.pts --weather mixed.epw -n 64 -o last.csv 2>&1 |
  grep -qF 'aureole: 3650 occupied hours; ' || fail "no summary"

# What the summary says of all sensors is what its table says of each, by intervals of 95 % of 16 randomisations (a quantile of
# Student's t of 2.13145). A row of sensors goes from under a roof into the open.
echo '<scene version="3.0.0"><shape type="rectangle"><transform name="to_world"><scale x="2" y="9" z="1"/><translate z="1"/></transform>
<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf></shape></scene>' >roof.xml
bash "$weather" 48 11 1 >whole.epw
for x in $(seq 0 .1 2 | tr , .) $(seq 2 .02 3 | tr , .); do echo "$x 0 0 0 0 1"; done >row.pts
"$aureole" irradiance roof.xml --sensors row.pts --weather whole.epw --up 0,0,1 -n 64 --threshold 9500 --schedule 10-14 --metrics metrics.csv -o row.csv 2>said || fail "a row"
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
  { ++n; value = $column["autonomy"]; half = 2.13145 * $column["autonomy_error"]; enough += value >= 50; least += value - half >= 50
    most += value + half >= 50; sunny += $column["sun_hours"] > 250 }
  END { printf "aureole: 1460 occupied hours; %.4g %% of the sensors reach the threshold in half of them or more (%.4g to %.4g %% by their intervals), %.4g %% have more than 250 hours of direct sun\n",
          100 * enough / n, 100 * least / n, 100 * most / n, 100 * sunny / n
        printf "annual sunlight exposure,%.17g,", 100 * sunny / n >"exposure"
        exit !(least < enough && enough < most && sunny > 0 && sunny < n) }' row.csv >expected || fail "all sensors are alike: $(cat expected)"
grep -qFf exposure metrics.csv || fail "$(grep annual metrics.csv), not $(cat exposure)"
grep -qxFf expected said || fail "the summary: $(cat said), not $(cat expected)"

# The errors of a series are standard errors: values of 8 seeds spread as they say. The ratio of both variances is F with 7 and 8 * 15
# degrees of freedom, at most 4.9 and at least .072 but in 1 of 10,000 cases each, were hours alike; the root mean square is over 50 hours.
for seed in 0 1 2 3 4 5 6 7; do
  sed -n 45p row.pts >one.pts
  "$aureole" irradiance -q roof.xml --sensors one.pts --weather whole.epw --up 0,0,1 -n 128 --seed $seed --series hours.csv -o /dev/null || fail "a series"
  awk -F, 'NR > 1 && $4 == 12 && $2 != before { before = $2; hour = 0 } NR > 1 && $4 == 12 && ++hour <= 4 { print $2 "-" $3, $5, $6 }' hours.csv
done >spread
awk '{ ++n[$1]; sum[$1] += $2; squares[$1] += $2 * $2; errors += $3 * $3 / 8 }
  END { for (h in n) variance += (squares[h] - sum[h] ^ 2 / 8) / 7
        print variance / errors; exit !(length(n) == 48 && variance < 4.9 * errors && variance > .072 * errors) }' spread >ratio ||
  fail "hours spread $(cat ratio) times as their errors say"

# Bad weather, by line.
# edited NAME LINE SUBSTITUTION: `direct` is the beginning of a record to the field before the sun's irradiance.
direct='^(([^,]*,){14})[^,]*'
edited() { sed -E "$2$3" mixed.epw >"$1"; }
edited begin.epw 1 's/LOCATION/PLACE/'
edited latitude.epw 1 's/48.0000/98/'
edited periods.epw 8 's/1,1,Data/1,7,Data/'
edited negative.epw 21 "s/$direct/\1-50/"
edited sunny.epw 21 "s/$direct/\13000/"
edited words.epw 21 "s/$direct/\1none/"
edited short.epw 21 's/,999999.*//;21s/,[0-9]*$//'
edited lost.epw 30 d
: >empty.epw
printf 'LOCATION,a\0b' >zero.epw
yard="plane.xml --sensors up.pts -n 64 --weather"
refused "begin.epw:1: an EPW file begins with LOCATION,CITY" $yard begin.epw
refused "latitude.epw:1: the latitude (field 7) must be a number from -90 to 90, not '98'" $yard latitude.epw
refused "periods.epw:8: the number of records an hour (field 3) must divide 60, not 7" $yard periods.epw
refused "negative.epw:21: the direct normal irradiance (field 15) must be from 0 to 2000 W/m^2" $yard negative.epw
refused "sunny.epw:21: the direct normal irradiance (field 15) must be from 0 to 2000 W/m^2, or 9999" $yard sunny.epw
refused "words.epw:21: the direct normal irradiance (field 15) must be a number" $yard words.epw
refused "short.epw:21: the line ends before the diffuse horizontal irradiance, its field 16" $yard short.epw
refused "lost.epw:30: hours must follow each other: 1-1, hour 23 does not follow 1-1, hour 21" $yard lost.epw
head -5005 mixed.epw >half.epw
refused "half.epw:5005: a file must have whole days of 24 hours; this one ends after 4997 hours" $yard half.epw
refused "empty.epw: an EPW file begins with" $yard empty.epw
refused "zero.epw:1: a zero byte" $yard zero.epw
refused "no.epw" $yard no.epw
sed 's/,Sunday,/,Someday,/' mixed.epw >day.epw
refused "does not state on which day of the week" $yard day.epw --weekdays
edited unknown.epw 21 "s/$direct,[^,]*/\19999,9999/"
"$aureole" irradiance $yard unknown.epw --up 0,0,1 -o unknown.csv 2>&1 |
  grep -qF 'unknown.epw:21: 1 hours of daylight are missing' || fail "an hour that is not known"

# The same weather written otherwise is the same year, and how it was written is said.
head -8 whole.epw >head.epw
tail -8760 whole.epw >hours.epw
year() { # year FILE: what is said goes to `said`
  "$aureole" irradiance $yard "$1" --up 0,0,1 --north 0,1,0 -o "${1%.epw}.csv" 2>said || fail "$1: $(cat said)"
}
same() { # same FILE WORDS
  year "$1"
  cmp -s "${1%.epw}.csv" whole.csv || fail "$1 is another year than whole.epw"
  if [ -n "${2:-}" ]; then grep -qF -- "$2" said || fail "$1: '$2' is not in: $(cat said)"; else ! grep warning said || fail "$1"; fi
}
year whole.epw
! grep warning said || fail "whole.epw: $(cat said)"
sed '1s/Nowhere/"Nowhere, ""Upper"""/' whole.epw >quoted.epw
same quoted.epw
sed 's/,/ , /g; 1s/ , /,/' whole.epw >blanks.epw
same blanks.epw
sed 's/$/\r/' whole.epw >lines.epw
same lines.epw
awk -F, -v OFS=, 'NR > 8 && $14 + $15 + $16 == 0 { $14 = -1; $15 = "-0.5"; $16 = -1 } { print }' whole.epw >nights.epw
same nights.epw "irradiances below 0 are read as 0"
grep -q "nights.epw:9: [0-9]* irradiances" said || fail "the first night: $(cat said)"
awk -F, -v OFS=, 'NR > 8 { $4 -= 1 } { print }' whole.epw >zero.epw
same zero.epw "hours are counted from 0 to 23"
# Quarters of hours whose mean is the hour, by minutes of the hour or of the day.
sed 's/^DATA PERIODS,1,1/DATA PERIODS,1,4/' head.epw >quarters.epw
awk -F, -v OFS=, '{ s = $15; d = $16; g = $14; for (k = 1; k <= 4; ++k) { f = k % 2 ? 1.5 : .5; $5 = 15 * k; $14 = g * f; $15 = s * f; $16 = d * f; print } }' \
  hours.epw >>quarters.epw
same quarters.epw "4 records per hour are averaged"
sed '8s/,1,4,/,1,1,/' quarters.epw >unsaid.epw
refused "unsaid.epw:10: hours must follow each other, with as many records as the line DATA PERIODS gives" $yard unsaid.epw
sed 40d quarters.epw >gap.epw
refused "gap.epw:40: 1-1, hour 8 has 3 records" $yard gap.epw
# A year from July on has the same hours; half a year is half of it.
{ cat head.epw; tail -4416 hours.epw; head -4344 hours.epw; } >july.epw
year july.epw
! grep warning said || fail "july.epw: $(cat said)"
for column in annual_lux_hours autonomy sun_hours; do
  near "july's $column" "$(cell $column 2 july.csv)" "$(cell $column 2 whole.csv)" "$(awk "BEGIN { print 1e-6 * $(cell $column 2 whole.csv) }")"
done
{ cat head.epw; tail -4416 hours.epw; } >late.epw
{ cat head.epw; head -4344 hours.epw; } >early.epw
for half in late early; do
  year $half.epw
  grep -q "of a year's 8760 hours" said || fail "$half: $(cat said)"
done
near "both halves" "$(awk "BEGIN { printf \"%.9g\", $(cell annual_lux_hours 2 late.csv) + $(cell annual_lux_hours 2 early.csv) }")" \
  "$(cell annual_lux_hours 2 whole.csv)" "$(awk "BEGIN { print 1e-6 * $(cell annual_lux_hours 2 whole.csv) }")"
{ cat whole.epw; head -48 hours.epw; } >long.epw
refused "more than a year" $yard long.epw
# An empty field is not known, and of three irradiances two tell the third.
awk -F, -v OFS=, 'NR > 8 { $14 = "" } { print }' whole.epw >empty-fields.epw
same empty-fields.epw "8760 empty fields are read as missing"

# What a file says twice and not the same is warned of, with the first line; each edit leaves a valid file.
warned() { # warned FILE WORDS
  year "$1"
  grep -qF -- "$2" said || fail "$1: '$2' is not in: $(cat said)"
}
year whole.epw
! grep warning said || fail "whole.epw: $(cat said)"
balance="global irradiance is not direct irradiance times the sine of the sun's height plus diffuse"
sed '1s/,1.0,100/,-7.0,100/' whole.epw >zone.epw
warned zone.epw "zone.epw:1: the time zone -7 differs by 7.7 hours from that of the longitude 11"
warned zone.epw "there is light with the sun below the horizon"
sed '1s/,48.0000,/,-48.0000,/' whole.epw >south.epw
warned south.epw "$balance"
sed '1s/,11.0000,/,-11.0000,/' whole.epw >west.epw
warned west.epw "$balance"
sed '1s/,1.0,100/,2.0,100/' whole.epw >summer.epw
warned summer.epw "$balance"
awk -F, -v OFS=, 'NR > 8 { $15 = $14 } { print }' whole.epw >swapped.epw # global in the place of direct
warned swapped.epw "$balance"
{ head -8 whole.epw; awk -F, -v OFS=, '{ line[NR] = $0 } END { for (i = 1; i <= NR; ++i) { split(line[(i + 11) % NR + 1], v, ","); split(line[i], w, ",")
  $0 = line[i]; $14 = v[14]; $15 = v[15]; $16 = v[16]; print } }' <(tail -8760 whole.epw); } >noon.epw # 12 hours off
warned noon.epw "it is dark with the sun high"

# Light in the first hour of 27 days of January is light at night, of all hours that are lit.
awk -F, -v OFS=, 'NR > 8 && $2 == 1 && $3 >= 5 && $4 == 1 { $14 = 100; $16 = 100 } { print }' whole.epw >night.epw
warned night.epw "night.epw:105: there is light with the sun below the horizon in 27 of $(awk -F, 'NR > 8 && ($14 > 20 || $16 > 20)' night.epw | wc -l) hours"

# Bad options.
refused "--threshold needs --weather FILE" plane.xml --sensors up.pts --threshold 500
refused "--parts cannot be used with --weather" $yard mixed.epw --parts
refused "must be tregenza or reinhart:M with M from 1 to 6, not 'reinhart:7'" $yard mixed.epw --patches reinhart:7
# Hours over midnight are those that are not between, and a file says the same hour by hour.
for hours in 8-18 18-8; do
  "$aureole" irradiance $yard mixed.epw --up 0,0,1 -n 64 --schedule $hours -q -o "at-$hours.csv" || fail "--schedule $hours"
done
awk 'BEGIN { print "# hours"; for (i = 0; i < 8760; ++i) print (i % 24 < 8 || i % 24 >= 18 ? ".5,night" : "0,day") }' >nights.csv
"$aureole" irradiance $yard mixed.epw --up 0,0,1 -n 64 --schedule nights.csv -q -o by-file.csv || fail "--schedule FILE"
cmp -s at-18-8.csv by-file.csv && ! cmp -s at-8-18.csv by-file.csv || fail "a schedule by file"
# A schedule without daylight, and a model without a camera, which no sensor needs.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
"$aureole" irradiance one.obj --sensors up.pts --up 0,0,1 -n 16 --weather mixed.epw --schedule 0-3 -o night.csv 2>said || fail "nights"
grep -q "mixed.epw: no occupied hour has daylight" said && ! grep -q camera said || fail "nights: $(cat said)"
"$aureole" irradiance one.obj --sensors up.pts --up 0,0,1 -n 16 --weather mixed.epw --schedule 0-9 -o night.csv 2>&1 | grep "no occupied hour" && fail "a morning"
refused "hours like 8-18 or 22-6, daylight, or a file expected" $yard mixed.epw --schedule 8-8
for option in "--weather mixed.epw" "--sky uniform" "--parts" "--to csv" "--error 1%"; do
  refused "cannot be used with --coefficients" plane.xml --sensors up.pts --coefficients $option
done
refused "--threshold needs --weather" plane.xml --sensors up.pts --coefficients --threshold 100
mkfifo hours.pipe
refused "it is a pipe" $yard mixed.epw --schedule hours.pipe
head -100 nights.csv >short.csv
refused "short.csv: 99 hours, and the weather has 8760" $yard mixed.epw --schedule short.csv
{ cat nights.csv; echo 1; } >long.csv
refused "long.csv:8762: more hours than the weather has" $yard mixed.epw --schedule long.csv
refused "nights.epw:1: a number expected" $yard mixed.epw --schedule nights.epw
refused "must be two illuminances like 100,3000, not '3000,100'" $yard mixed.epw --useful 3000,100
refused "must be a direction like 0,0,1, not '0,0,0'" $yard mixed.epw --up 0,0,0
refused "nor along 'up'" $yard mixed.epw --up 0,0,1 --north 0,0,1
refused "ends in .npy or .csv, not to 'hours.txt'" $yard mixed.epw --series hours.txt

finish

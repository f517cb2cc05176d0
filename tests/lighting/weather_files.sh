#!/usr/bin/env bash
# The same days as EPW, Radiance's .wea and TMY3: the same bytes come out; and damage of the two, each with its line.
. "$2/tests/lighting/checks.sh.inc"
command="irradiance open.rad --sensors points.pts --weather"
printf 'void plastic black 0 0 5 0 0 0 0 0\nblack sphere far 0 0 4 0 0 -900 1\n' >open.rad
printf '0 0 0 0 0 1\n0 0 0 0 -1 0\n' >points.pts
awk 'function sky(h) { s = sin(3.14159265 * (h - 6.5) / 12); return s > 0 ? s : 0 }
  BEGIN { print "LOCATION,Here,-,-,-,0,37.5,-122.25,-8,10" >"days.epw"; for (i = 2; i < 8; ++i) print "COMMENT," i >"days.epw"
    print "DATA PERIODS,1,1,Data,Sunday,2/27,3/1" >"days.epw"
    printf "place Here\nlatitude 37.5\nlongitude 122.25\ntime_zone 120\nsite_elevation 10\nweather_data_file_units 1\n" >"days.wea"
    print "123456,\"Here\",CA,-8.0,37.5,-122.25,10" >"days.csv"; print "Date (MM/DD/YYYY),Time (HH:MM),ETR" >"days.csv"
    split("2/27 2/28 3/1", days, " ")
    for (d = 1; d <= 3; ++d) for (h = 1; h <= 24; ++h) { split(days[d], md, "/"); n = int(700 * sky(h)); f = int(150 * sky(h)); g = int(n * sky(h) + f)
      printf "2001,%d,%d,%d,60,x,10,10,50,1,0,0,0,%d,%d,%d\n", md[1], md[2], h, g, n, f >"days.epw"
      printf "%d %d %.3f %d %d\n", md[1], md[2], h - .5, n, f >"days.wea"
      printf "%02d/%02d/2001,%02d:00,0,0,%d,1,1,%d,1,1,%d", md[1], md[2], h, g, n, f >"days.csv"
      for (i = 11; i < 34; ++i) printf ",0" >"days.csv"; print ",10" >"days.csv" } }'
for file in epw wea csv; do
  "$aureole" irradiance -q open.rad --sensors points.pts --weather days.$file --efficacy 179 -n 512 -o $file.out || fail "days.$file"
  cmp epw.out $file.out || fail "days.$file"
done
awk -F, 'NR == 2 && !($(NF - 1) > 100) { exit 1 }' epw.out || fail "no light in the days"

# Watts are lux over 179.
"$aureole" irradiance -q open.rad --sensors points.pts --weather days.epw --efficacy none -n 512 -o watts.out || fail "W/m2"
paste -d, epw.out watts.out | awk -F, 'NR > 1 { n = NF / 2; r = $(n - 1) / $(2 * n - 1) / 179 - 1; if (r > 1e-9 || r < -1e-9) { print r; exit 1 } }' || fail "lux are not 179 times W/m2"

# Metrics are the columns of the sensors, with intervals; standards are judged where the options are theirs.
metrics() {
  "$aureole" irradiance -q open.rad --sensors points.pts --weather days.epw -n 512 --metrics m.csv -o sensors.csv "$@" || fail "--metrics $*"
}
value() { awk -F, -v name="$1" '{ gsub(/"/, "") } index($0, name ",") == 1 { sub(/.*, [0-9] points?/, ""); n = split($0, f, ","); print f[n - 4] }' m.csv; }
metrics
[ "$(value 'spatial daylight autonomy')" = 100 ] || fail "spatial autonomy: $(cat m.csv)"
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "autonomy") c = i } NR > 1 { s += $c / 2 } END { printf "%.9g\n", s }' sensors.csv >mean
[ "$(awk -v x="$(value 'mean daylight autonomy')" 'BEGIN { printf "%.9g", x }')" = "$(cat mean)" ] || fail "mean autonomy"
[ "$(grep -c 'LEED.*,yes' m.csv)" = 3 ] && ! grep -q EN m.csv || fail "LEED: $(cat m.csv)"
metrics --schedule 9-17
grep -q 'LEED\|EN 17037' m.csv && fail "LEED counts from 8 to 18"
# EN 17037 counts half of the daylight hours, which are the half of all hours with the most diffuse light: an oracle by sort.
metrics --schedule daylight --threshold 300
grep -q 'EN 17037, target illuminance of the level minimum.*,50,' m.csv && grep -q 'minimum illuminance of the level medium.*,95,' m.csv || fail "EN 17037: $(cat m.csv)"
cp sensors.csv daylight.csv
hours=$(($(wc -l <days.epw) - 8))
tail -n "$hours" days.epw | awk -F, '{ print $16 "," NR }' | sort -t, -k1,1gr -k2,2n | awk -F, -v half=$((hours / 2)) '{ print $2 "," (NR <= half) }' |
  sort -n | cut -d, -f2 >daylight_hours.csv
metrics --schedule daylight_hours.csv --threshold 300
cmp -s sensors.csv daylight.csv || fail "--schedule daylight is not the half of the hours with the most diffuse light"
metrics --schedule 0-24 --threshold 300
grep -q 'EN 17037' m.csv && fail "EN 17037 does not count nights"
metrics --threshold 1e6 && [ "$(value 'spatial daylight autonomy')" = 0 ] || fail "nothing reaches 10^6 lux"
"$aureole" irradiance -q open.rad --sensors points.pts --weather days.epw -n 512 --metrics m.json -o sensors.csv && grep -q '"metric": "annual sunlight exposure", "value": 0' m.json || fail "JSON"
"$aureole" irradiance -q open.rad --sensors points.pts --metrics m.json 2>/dev/null && fail "--metrics without weather"

sed 4d days.wea >bad.wea && refused "bad.wea:4: a .wea file has a line 'time_zone NUMBER' here" bad.wea
sed '6s/1/2/' days.wea >bad.wea && refused "bad.wea:6: weather_data_file_units (field 2) must be a number from 1 to 1" bad.wea
sed '2s/37.5/137/' days.wea >bad.wea && refused "bad.wea:2: latitude (field 2) must be a number from -90 to 90" bad.wea
sed '9s/ [0-9]*$//' days.wea >bad.wea && refused "bad.wea:9: the line ends before the diffuse horizontal" bad.wea
sed '9s/^2 27 2.5/2 27 x/' days.wea >bad.wea && refused "bad.wea:9: the hour" bad.wea
sed 9d days.wea >bad.wea && refused "bad.wea:9: hours must follow" bad.wea
head -20 days.wea >bad.wea && refused "whole days of 24 hours" bad.wea
head -3 days.wea >bad.wea && refused "bad.wea:3: a .wea file has a line 'time_zone" bad.wea
sed '3s/02.27.2001/27 Feb 01/' days.csv >bad.csv && refused "bad.csv:3: a record must begin with a date" bad.csv
sed 2d days.csv >bad.csv && refused "bad.csv:2: the second line of a TMY3 file" bad.csv
sed '1s/37.5/x/' days.csv >bad.csv && refused "bad.csv:1: the latitude" bad.csv
sed '9s/,0,10$/,0,warm/' days.csv >bad.csv && refused "bad.csv:9: the dew point" bad.csv
sed '9s/^\(.*,1,1,\)[0-9]*,1,1/\15000,1,1/' days.csv >bad.csv && refused "bad.csv:9: the direct normal" bad.csv
printf 'a,b\n' >bad.csv && refused "an EPW file begins with LOCATION" bad.csv
: >empty.wea && refused "an EPW file begins with LOCATION" empty.wea
finish

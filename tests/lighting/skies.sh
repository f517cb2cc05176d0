#!/usr/bin/env bash
# Skies by option and those that gensky and gendaylit write, beside closed forms and sums by midpoints.
. "$2/tests/lighting/checks.sh.inc"
# near FILE COLUMN VALUE... : the column of each sensor is within four standard errors and 1e-4 of the value; in daylight-factor
# files the last two columns are value and error.
near() {
  local file=$1 column=$2 error=$3
  shift 3
  awk -F, -v c="$column" -v e="$error" -v all="$*" 'BEGIN { n = split(all, v, " ") }
    NR > 1 { d = $c - v[NR - 1]; if (d < 0) d = -d; if (!(d <= 4 * $e + 1e-4 * v[NR - 1])) { print FILENAME ": " $c ", not " v[NR - 1] " +- " $e; bad = 1 } }
    END { exit bad || NR != n + 1 }' "$file" || fail "$file"
}

printf 'void plastic w 0 0 5 .1 .1 .1 0 0\nvoid light l 0 0 3 5 5 5\nw sphere far 0 0 4 0 0 -900 1\n' >open.rad
printf 'l sphere lamp 0 0 4 0 0 -400 1\n' >lamp.rad
printf '0 0 0 0 0 1\n0 0 0 1 0 0\n0 0 0 0 0 -1\n' >points.pts
head -1 points.pts >up.pts
run() { "$aureole" irradiance -q "$@" -n 4096 || fail "$*"; }

# The overcast sky on a vertical plane: (pi / 6 + 4 / 9) / (7 pi / 9) of the horizontal one (Moon and Spencer 1942), with half of
# the ground's .2; lamps do not count.
run open.rad lamp.rad --sensors points.pts --sky cie-overcast --daylight-factor -o df.csv
head -1 df.csv | grep -q daylight_factor || fail "the column's name: $(head -1 df.csv)"
columns=$(head -1 df.csv | awk -F, '{ for (i = 1; i <= NF; ++i) if ($i == "daylight_factor") v = i; print v, NF }')
vertical=$(awk 'BEGIN { pi = atan2(0, -1); print 100 * ((pi / 6 + 4 / 9) / (7 * pi / 9) + .1) }')
near df.csv $columns 100 $vertical 20
run open.rad --sensors points.pts --sky uniform --ground-albedo 0 --sky-lux 5000 --illuminance radiance -o uniform.csv
near uniform.csv $columns 5000 2500 0
# Above the tropic at noon of midsummer the sun is in the zenith: direct and diffuse add up.
run open.rad --sensors points.pts --sky perez:800,100 --date 2026-06-21T12:02 --location 23.43,0,0 -o perez.csv
near perez.csv 4 7 900 $(sed -n 3p perez.csv | cut -d, -f4) 180
# Its W/m2 are of all solar radiation, which lumens per visible watt do not convert.
noon='--sensors up.pts --date 2026-06-21T12:02 --location 23.43,0,0 -n 64 -o lux.csv'
"$aureole" irradiance open.rad --sky perez:800,100 $noon --illuminance radiance 2>&1 | grep -q "lux of --sky perez" || fail "no warning of lux"
"$aureole" irradiance open.rad --sky perez:800,100 $noon 2>&1 | grep "lux" && fail "a warning of lux that are not reported"
"$aureole" irradiance open.rad --sky cie-clear $noon --illuminance radiance 2>&1 | grep "lux" && fail "a warning of the lux of --sky-lux"
for sky in cie-clear cie:1 cie:12 cie:15; do
  run open.rad --sensors up.pts --sky $sky --date 2026-03-21T10:00 --location 48.1,11.6,1 --illuminance radiance -o $sky.csv
  near $sky.csv $columns 10000
done
cmp -s cie-clear.csv cie:12.csv || fail "the clear sky is type 12"

# What gensky and gendaylit write, by sums over heights; a sun in the zenith makes clear skies round.
blended() { # RADIANCE BY z IN AWK, GROUND
  awk -v g="$2" 'function f(z) { return '"$1"' } BEGIN { pi = atan2(0, -1); n = 200000
    for (i = 0; i < n; ++i) { z = -1 + 2 * (i + .5) / n; a = (z + 1.01) ^ 20; l = (a * f(z > 0 ? z : 0) + g) / (1 + a); s = 2 / n
      up += z > 0 ? 2 * pi * z * l * s : 0; side += 2 * sqrt(1 - z * z) * l * s; down += z < 0 ? -2 * pi * z * l * s : 0 }
    printf "%.8g %.8g %.8g", up, side, down }'
}
sky() { printf 'void brightfunc skyfunc 2 %s 0 %s\nskyfunc glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 180\ng source ground 0 0 4 0 0 -1 180\n' "$1" "$2"; }
sky 'skybr skybright.cal' '3 3 20 4' >uniform.sky
sky 'skybr skybright.cal' '7 1 30 5 2 0 0 1' >clear.sky
sky 'skybright perezlum.cal' '10 2 3 -.9 -.2 8 -3 .3 0 0 1' >perez.sky
for file in uniform clear perez; do
  case $file in
  uniform) values=$(blended 20 4) ;;
  clear) values=$(blended '15 * (z > .01 ? 1 - exp(-.32 / z) : 1) * (.91 + 10 * exp(-3 * atan2(sqrt(1 - z * z), z)) + .45 * z * z)' 5) ;;
  perez) values=$(blended '2 * (1 - .9 * exp(-.2 / (z + 1e-12))) * (1 + 8 * exp(-3 * atan2(sqrt(1 - z * z), z)) + .3 * z * z)' 3) ;;
  esac
  run $file.sky open.rad --sensors points.pts -o $file.csv
  near $file.csv 4 7 $values
done
# Overcast: the gradation goes on below the horizon.
sky 'skybr skybright.cal' '3 2 30 4' >overcast.sky
run overcast.sky open.rad --sensors points.pts -o overcast.csv
near overcast.csv 4 7 $(blended '10 * (1 + 2 * z)' 4 | sed 's/ .*//') $(awk 'BEGIN { n = 200000
  for (i = 0; i < n; ++i) { z = -1 + 2 * (i + .5) / n; a = (z + 1.01) ^ 20; f = 10 * (1 + 2 * z); l = (a * (f > 0 ? f : 0) + 4) / (1 + a)
    side += 4 / n * sqrt(1 - z * z) * l; down += z < 0 ? -4 / n * atan2(0, -1) * z * l : 0 } print side, down }')
# One that xform turns on its side lights from there.
printf '!xform -ry 90 uniform.sky\n' >turned.rad
run turned.rad open.rad --sensors points.pts -o turned.csv
near turned.csv 4 7 $(blended 20 4 | awk '{ print $2, $1, $2 }')

refused "unknown sky 'cloudy'" irradiance open.rad --sensors points.pts --sky cloudy
refused "unknown sky 'cie:16'" irradiance open.rad --sensors points.pts --sky cie:16
refused "unknown sky 'perez:100'" irradiance open.rad --sensors points.pts --sky perez:100
refused "needs a date like" irradiance open.rad --sensors points.pts --sky cie-clear
refused "needs a date like" irradiance open.rad --sensors points.pts --sky cie-clear --date 2026-06-21T12:00
refused "expected a location" irradiance open.rad --sensors points.pts --sky cie-clear --date 2026-06-21T12:00 --location 1,2
for sky in uniform cie-overcast cie-clear perez:500,100; do
  for date in 2026-13-21T12:00 2026-00-21T12:00 2026-06-31T12:00 2027-02-29T12:00 2026-06-21T25:00 2026-06-21T12:60 2026-06-21 1949-06-21T12:00 noon; do
    refused "expected a date and time" irradiance open.rad --sensors points.pts --sky $sky --date $date --location 1,2,0
  done
  for place in 91,0,0 0,181,0 0,0,15 1,2 x; do
    refused "expected a location" irradiance open.rad --sensors points.pts --sky $sky --date 2028-02-29T12:00 --location $place
  done
done
refused "below" irradiance open.rad --sensors points.pts --sky cie-clear --date 2026-06-21T00:00 --location 48,11,1
refused "--date needs --sky MODEL" irradiance open.rad --sensors points.pts --date 2026-06-21T12:00
refused "cannot be used with --weather" irradiance open.rad --sensors points.pts --sky uniform --weather no.epw
refused "needs a sky without sun" irradiance open.rad --sensors points.pts --sky perez:1,1 --daylight-factor
refused "as bright as its DHI" irradiance open.rad --sensors points.pts --sky perez:1,1 --sky-lux 5
refused "a second environment" irradiance uniform.sky open.rad --sensors points.pts --sky uniform
sky 'skybr skybright.cal' '7 4 30 5 2 0 0 1' >bad.sky
refused "bad.sky:3: skybright.cal: an intermediate sky" irradiance bad.sky open.rad --sensors points.pts
sky 'skybr skybright.cal' '2 1 30' >bad.sky
refused "bad.sky:1: brightfunc: skybr takes 7 numbers, not 2" irradiance bad.sky open.rad --sensors points.pts
sky 'skybr other.cal' '3 2 30 5' >bad.sky
refused "bad.sky:2: glow" irradiance bad.sky open.rad --sensors points.pts
# Places whose time zone is not theirs: a sign, or degrees east before degrees north.
zone() { # LOCATION WORDS
  "$aureole" irradiance zone.rad --sensors zone.pts --sky cie-clear --date 2026-06-21T12:00 --location $1 -n 16 2>&1 | grep -q "the time zone .* hours from that of"
}
printf 'void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey polygon p 0 0 9 0 0 -1 1 0 -1 0 1 -1\n' >zone.rad
echo 0 0 0 0 0 1 >zone.pts
zone 40,105,-7 || zone 48,-75,1 || fail "a longitude with the wrong sign"
zone 48,-75,1 || fail "a longitude to the west with a zone to the east"
for place in 48,11,1 48,11,2 40,-105,-7 -36,174.8,13 52,-179,12 51,0,0; do zone $place && fail "$place is warned of"; done
# gendaylit and gensky as commands: the irradiances that they state, on planes that face up, down and the sun, which -s takes away.
printf '0 0 0 0 0 1\n0 0 0 0 0 -1\n0 0 0 -.26200263 -.71984632 .64278761\n' >planes.pts
sources='skyfunc glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 180\nskyfunc glow h 0 0 4 1 1 1 0\nh source ground 0 0 4 0 0 -1 180\n'
planes() { # COMMAND: red of the three planes
  printf "$1\n$sources" >command.rad
  "$aureole" irradiance -q command.rad --sensors planes.pts -n 16384 --no-errors -o planes.csv && awk -F, 'NR > 1 { print $4 }' planes.csv | paste -sd' '
}
# The sky and the ground mix about the horizon, which is some .6 % of the ground.
close() { # WANTED FOUND, within 1 %
  awk -v a="$1" -v b="$2" 'BEGIN { n = split(a, x, " "); if (split(b, y, " ") < n) exit 1; for (i = 1; i <= n; ++i) { d = y[i] - x[i]; if (d < 0) d = -d; if (d > .01 * x[i]) exit 1 } }' || fail "$3: $2, not $1"
}
all=$(awk 'BEGIN { print 100 + 700 * .64278761 }') ground=$(awk 'BEGIN { print .3 * (100 + 700 * .64278761) }')
found=$(planes '!gendaylit -ang 40 20 -W 700 100 -g .3 -O 1')
close "$all $ground" "$found" gendaylit
shaded=$(planes '!gendaylit -ang 40 20 -W 700 100 -g .3 -O 1 -s')
close "100 $ground" "$shaded" "gendaylit -s"
close 700 "$(awk -v a="$found" -v b="$shaded" 'BEGIN { split(a, x, " "); split(b, y, " "); print x[3] - y[3] }')" "the sun of gendaylit"
close "$found" "$(planes '!gendaylit -ang 40 20 -G 449.95133 100 -g .3 -O 1')" "gendaylit -G"
close "100 20" "$(planes '!gensky -ang 40 20 -c -B 100')" "gensky -c"
close "100 40 $(awk 'BEGIN { c = .64278761; print 100 * (1 + c) / 2 + 40 * (1 - c) / 2 }')" "$(planes '!gensky -u -B 100 -g .4 -ang 40 20')" "gensky -u"
for bad in 'gendaylit 6 21 12 -W 700 100 -O 1' 'gendaylit -ang 40 20 -W 700 100' 'gendaylit -ang 40 20 -O 1' 'gensky 6 21 12 +s' 'gensky -ang 40 20 -c'; do
  printf '!%s\n' "$bad" >bad.rad
  refused "bad.rad:1: ${bad%% *}: " irradiance bad.rad --sensors planes.pts
done
printf '!gensky -c -B 100 | xform -rz 90\n' >bad.rad
refused "'xform' is not supported after a sky" irradiance bad.rad --sensors planes.pts
printf '!gendaylit -ang -4 20 -W 0 10 -O 1\n' >bad.rad
refused "a sun above the horizon expected" irradiance bad.rad --sensors planes.pts
finish

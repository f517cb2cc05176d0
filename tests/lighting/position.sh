#!/usr/bin/env bash
# Irradiance at sensors in a street of black walls under an even sky has a closed form, wherever the street stands: that of an element
# at the foot of a rectangle (Siegel and Howell, Thermal Radiation Heat Transfer, factor 1). Means of 32 seeds differ from it by less
# than 5.5 standard errors (20 tests of t with 31 degrees of freedom: a chance of 1e-4 in all), and of the 640 intervals of 95 % no
# more than 60 miss it (expected 32; a chance below 1e-3, were the four sensors of one run one only).
. "$2/tests/lighting/checks.sh.inc"
seeds=32
[ -n "${AUREOLE_SHORT_TESTS:-}" ] && seeds=2

# street X Y Z: walls 6 m high, 6 m apart and 20 m long, the ground between them, and four sensors on it.
street() {
  awk -v x="$1" -v y="$2" -v z="$3" 'BEGIN {
    n = split("2 -10 0 2 10 0 2 10 6 2 -10 6 -4 -10 0 -4 10 0 -4 10 6 -4 -10 6", at, " ")
    for (i = 1; i <= n; i += 3) printf "v %.6f %.6f %.6f\n", x + at[i], y + at[i + 1], z + at[i + 2]
    print "f 1 4 3 2\nf 5 6 7 8\nf 5 1 2 6" }' >street.obj
  awk -v x="$1" -v y="$2" -v z="$3" 'BEGIN {
    print "x,y,z,nx,ny,nz"
    n = split("0 0 1 3 -3 -2 1.9 0", at, " ")
    for (i = 1; i <= n; i += 2) printf "%.6f,%.6f,%.6f,0,0,1\n", x + at[i], y + at[i + 1], z }' >sensors.csv
}

cat >street.xml <<'XML'
<scene version="3.0.0"><shape type="obj"><string name="filename" value="street.obj"/>
  <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf></shape><emitter type="constant"/></scene>
XML
>found
for place in "0 0 0" "1e5 1e5 0" "2600000.3 1200000.7 408.2" "500000.3 5400000.7 113" "1e7 -1e7 1e7"; do
  street $place
  for seed in $(seq $seeds); do
    "$aureole" irradiance street.xml --sensors sensors.csv -n 256 --to csv --intervals --seed $seed 2>said |
      awk -F, -v place="$place" 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
        NR > 1 { print NR - 1, $column["r"], $column["r_half_width"], place }' >>found
    grep -q "4 of 4 sensors lie on surfaces" said || fail "at $place: $(cat said)"
  done
done
[ $seeds = 2 ] || awk '
  function part(b, c) { return (atan2(b, c) - c / sqrt(36 + c * c) * atan2(b, sqrt(36 + c * c))) / (2 * 3.14159265358979) }
  function beside(y, c) { return part(10 - y, c) + part(10 + y, c) }
  BEGIN { n = split("0 0 1 3 -3 -2 1.9 0", at, " ")
    for (i = 1; i <= n; i += 2)
      truth[(i + 1) / 2] = 3.14159265358979 * (1 - beside(at[i + 1], 2 - at[i]) - beside(at[i + 1], at[i] + 4)) }
  { off = $2 - truth[$1]; missed += (off > $3 || off < -$3)
    place = $1 " at " $4 " " $5 " " $6; ++count[place]; sum[place] += off; squares[place] += off * off }
  END { for (place in sum) { n = count[place]; mean = sum[place] / n
          t = mean / sqrt((squares[place] - n * mean * mean) / (n - 1) / n)
          printf "sensor %s: off by %.5f, t = %.2f\n", place, mean, t
          bad += n != 32 || t > 5.5 || t < -5.5; ++places }
        printf "%d of %d intervals miss\n", missed, NR
        exit bad > 0 || places != 20 || missed > 60 }' found || fail "the street"

# A closed room: direct light has a closed form, which is the same to the rounding of floats, and the whole is within 5 errors.
for place in "0 0" "530000 180000" "2600000 1200000"; do
  read -r x y <<<"$place"
  awk -v x=$x -v y=$y 'function wall(name, list, n, at, i) {
      n = split(list, at, " "); printf "%s polygon p 0 0 12", name
      for (i = 1; i <= n; i += 3) printf " %.3f %.3f %.3f", x + at[i], y + at[i + 1], at[i + 2]; print "" }
    BEGIN { print "void plastic m 0 0 5 .5 .5 .5 0 0\nvoid light l 0 0 3 10 10 10"
      wall("m", "0 0 0 4 0 0 4 5 0 0 5 0"); wall("m", "0 0 3 0 5 3 4 5 3 4 0 3"); wall("m", "0 0 0 0 5 0 0 5 3 0 0 3")
      wall("m", "4 0 0 4 0 3 4 5 3 4 5 0"); wall("m", "0 0 0 0 0 3 4 0 3 4 0 0"); wall("m", "0 5 0 4 5 0 4 5 3 0 5 3")
      wall("l", "1.5 2 2.9 1.5 3 2.9 2.5 3 2.9 2.5 2 2.9")
      printf "%.3f %.3f .8 0 0 1\n%.3f %.3f .8 0 0 1\n", x + 2, y + 2.5, x + 3, y + 4 >"room.pts" }' >room.rad
  "$aureole" irradiance room.rad --sensors room.pts -n 4096 --parts --to csv | tail -n 2
done >rooms
awk -F, '{ k = NR % 2 } NR <= 2 { total[k] = $4; error[k] = $7; direct[k] = $10 }
  { off = ($4 - total[k]) / sqrt(error[k] ^ 2 + $7 ^ 2); part = $10 / direct[k] - 1
    bad += off > 5 || off < -5 || part > 1e-6 || part < -1e-6 }
  END { exit bad > 0 || NR != 6 }' rooms || fail "rooms: $(cat rooms)"
finish

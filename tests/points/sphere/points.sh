#!/usr/bin/env bash
# Every set on every domain in every format, from the program's own list; and bad input, which gives one line on
# standard error, exit status 2 and no file.
set -u
aureole=$1
status=0
fail() { echo "$*"; status=1; }
rm -f ./*.out ./*.csv ./*.txt

# What the sets need beyond their names: matrices a file, file: a path.
printf '1 0\n0 1\n\n1 1\n0 1\n' > matrices.txt
"$aureole" points halton -n 16 -o own.csv || fail "cannot write own.csv"
count=16
text_of() {
  case $1 in
    matrices) echo "matrices:file=matrices.txt" ;;
    file) echo "file:own.csv" ;;
    *) echo "$1" ;;
  esac
}

"$aureole" sets --format csv > sets.csv || fail "sets failed"
[ "$(wc -l < sets.csv)" -gt 15 ] || fail "too few sets are listed"
seen=0
while IFS= read -r line; do
  set=${line%%,*}
  [ "$set" = set ] && continue
  one='(square|cube|disk|hemisphere|sphere|axes|rotations)'
  domains=$(grep -oE "[,\"]$one(, $one)*[,\"]" <<<"$line" | head -1 | grep -oE "[a-z]+" | grep -vx cube)
  [ -n "$domains" ] || domains=own
  n=$count
  [ "$set" = matrices ] && n=4
  [ "$set" = healpix ] && n=12
  [ "$set" = t-design ] && n=8
  [ "$set" = lebedev ] && n=14
  [ "$set" = gauss ] && n=8
  [ "$set" = icosahedral ] && n=12
  for domain in $domains; do
    where=(--domain "$domain")
    [ "$domain" = own ] && where=()
    formats=(csv json npy ply svg png)
    [ -z "${AUREOLE_SHORT_TESTS:-}" ] || formats=(csv "${formats[1 + seen % 5]}") # each set has some of them
    for format in "${formats[@]}"; do
      [ "$domain" = rotations ] && [ $format = ply ] && continue # has three coordinates
      out=$set-$domain.$format.out
      message=$("$aureole" points "$(text_of "$set")" -n $n -q "${where[@]}" --format $format -o "$out" 2>&1) ||
        fail "$set on $domain as $format: $message"
      [ -s "$out" ] || fail "$set on $domain as $format wrote nothing"
      seen=$((seen + 1))
    done
    rows=$(($(wc -l < "$set-$domain.csv.out") - 1))
    [ "$rows" = $n ] || fail "$set on $domain: $rows rows, not $n"
    grep -q nan "$set-$domain.csv.out" && fail "$set on $domain: NaN"
  done
done < sets.csv
[ $seen -gt $((${#formats[@]} * 70)) ] || fail "only $seen combinations were run"

# Directions of a GGX lobe below the horizon are counted; other lobes have none.
"$aureole" points sobol -n 1024 --lobe ggx:0.4:30 -o glossy.csv 2>glossy.txt || fail "ggx: $(cat glossy.txt)"
below=$(awk -F, 'NR > 1 && $3 < 0' glossy.csv | wc -l)
{ [ "$below" -gt 100 ] && grep -q "warning: $below of 1024 points lie below the horizon" glossy.txt; } || fail "$below below: $(cat glossy.txt)"
"$aureole" points sobol -n 1024 --lobe cosine -o glossy.csv 2>glossy.txt || fail "cosine"
[ -s glossy.txt ] && fail "cosine: $(cat glossy.txt)"

# Numbers as they are wanted: no header, fewer digits, 32-bit floats, which stay below 1 on the square.
"$aureole" points sobol --size 64 --no-header --digits 3 -o bare.csv || fail "--no-header --digits"
[ "$(sed -n 4p bare.csv)" = 0.75,0.25 ] && [ "$(wc -l <bare.csv)" = 64 ] && grep -q '^0.0156,' bare.csv || fail "bare.csv: $(head -4 bare.csv)"
printf 'u,v\n0.99999999999999989,0.3\n' >edge.csv
for format in npy ply; do
  "$aureole" points file:edge.csv --single -o edge.$format || fail "--single to $format"
done
# The largest float below 1, and 0.3 cut to 24 binary digits: 0x3f7fffff and 0x3e999999 (0.3 is 1.0011..b 2^-2 for ever).
[ "$(tail -c 8 edge.npy | od -An -tx4 | tr -d ' \n')" = 3f7fffff3e999999 ] || fail "--single: $(tail -c 8 edge.npy | od -An -tx4)"
[ "$(tail -c 12 edge.ply | od -An -tx4 | tr -d ' \n')" = 3f7fffff3e99999900000000 ] || fail "--single: ply"
"$aureole" measure edge.npy --metric centered -q >edge.txt && grep -q square edge.txt || fail "edge.npy is not read: $(cat edge.txt)"
"$aureole" points sobol -n 4 -o upper.NPY && "$aureole" measure upper.NPY --metric centered >/dev/null || fail "upper.NPY is no NPY"
"$aureole" points sobol -n 4 -o other.txt 2>wrong.txt || grep -q "must end in .csv" wrong.txt || fail "other.txt: $(cat wrong.txt)"
[ ! -e other.txt ] || fail "other.txt was written, in an unknown format"
for wrong in "--digits 3 --format npy" "--no-header --format json" "--single --format csv" "--digits 18"; do
  # shellcheck disable=SC2086
  ! "$aureole" points sobol -n 4 $wrong -o wrong.out 2>wrong.txt && [ "$(wc -l <wrong.txt)" = 1 ] && [ ! -e wrong.out ] ||
    fail "$wrong is not refused: $(cat wrong.txt)"
done

# What is written is read again, and parts are parts of the whole.
"$aureole" points spherical-fibonacci -n 100 -o whole.csv || fail "whole"
"$aureole" points spherical-fibonacci -n 100 --first 40 --count 10 -o part.csv || fail "part"
[ "$(sed 1d part.csv)" = "$(sed -n 42,51p whole.csv)" ] || fail "a part differs from the whole"
for format in csv npy; do
  "$aureole" points spherical-fibonacci -n 100 --format $format -o again.$format.out || fail "writing $format"
  "$aureole" points "file:again.$format.out" -o again.csv || fail "reading $format"
  cmp -s again.csv whole.csv || fail "$format does not come back as it went"
done
"$aureole" points sobol -n 20 --domain disk --map polar -o disk.csv || fail "a disk"
"$aureole" points file:disk.csv | cmp -s - disk.csv || fail "a disk does not come back as it went"
"$aureole" points halton -n 20 --dim 4 -o cube.csv || fail "a cube"
"$aureole" points file:cube.csv | cmp -s - cube.csv || fail "a cube does not come back as it went"
"$aureole" points spherical-fibonacci -n 20 --domain hemisphere -o dome.csv || fail "a hemisphere"
"$aureole" points file:dome.csv --domain disk -o flat.csv || fail "a hemisphere on the disk"
[ "$(wc -l < flat.csv)" = 21 ] || fail "a hemisphere on the disk"
"$aureole" points super-fibonacci -n 20 -o turns.csv || fail "rotations"
"$aureole" points file:turns.csv | cmp -s - turns.csv || fail "rotations do not come back as they went"
head -1 turns.csv | grep -qx 'w,x,y,z' || fail "the header of rotations"
"$aureole" points sobol -n 8 --domain rotations --scramble owen --matrices | awk -F, '
  NR > 1 { d = $1*($5*$9-$6*$8) - $2*($4*$9-$6*$7) + $3*($4*$8-$5*$7); if (d < 1 - 1e-12 || d > 1 + 1e-12) bad = 1 }
  END { exit bad || NR != 9 }' || fail "matrices of rotations"
[ "$("$aureole" points super-fibonacci -n 4800 --symmetry 432 | wc -l)" -gt 190 ] || fail "a fundamental zone"
head -1 whole.csv | grep -qx 'x,y,z' || fail "the header of directions"
"$aureole" points sobol -n 4 --lobe phong:20 --density optimal | head -1 | grep -qx 'x,y,z,w# domain: hemisphere' || fail "weights"
"$aureole" points sobol -n 8 --dim 3 | head -1 | grep -qx 'u1,u2,u3' || fail "the cube"
"$aureole" points sobol -n 6 2>&1 > /dev/null | grep -q 'power of 2' || fail "no warning at n = 6"
"$aureole" points sobol -n 64 --format svg | grep -c '<circle' | grep -qx 64 || fail "the picture of 64 points"
[ "$("$aureole" points esfg:base=16 -n 64 --format svg | grep -c '<circle cx')" = 130 ] || fail "two views of 64, each with its rim"
"$aureole" points sobol -n 64 --format png -o ramp.png || fail "png"
"$aureole" points hammersley -n 64 --warp ramp.png -o warped.csv || fail "warp"
[ "$(wc -l < warped.csv)" = 65 ] || fail "warped points"
"$aureole" points spherical-fibonacci -n 50 --cap 20 | awk -F, 'NR > 1 && $3 < 0.9396 { bad = 1 } END { exit bad }' ||
  fail "a cap of 20 degrees"

# The same seed gives the same points, another seed others.
for scramble in digit owen shift rotate rotate3d; do
  one=$("$aureole" points sobol -n 8 --domain sphere --scramble $scramble --seed 1)
  [ "$one" = "$("$aureole" points sobol -n 8 --domain sphere --scramble $scramble --seed 1)" ] || fail "$scramble differs"
  [ "$one" != "$("$aureole" points sobol -n 8 --domain sphere --scramble $scramble --seed 2)" ] || fail "$scramble: seed"
done

refuse() {
  rm -f refused.csv
  "$aureole" points "$@" -o refused.csv > stdout.txt 2> stderr.txt
  local code=$?
  [ $code = 2 ] || fail "points $*: exit status $code, not 2"
  [ "$(wc -l < stderr.txt)" = 1 ] || fail "points $*: not one line on standard error: $(cat stderr.txt)"
  grep -q '^aureole: ' stderr.txt || fail "points $*: $(cat stderr.txt)"
  [ -s stdout.txt ] && fail "points $*: wrote on standard output"
  compgen -G 'refused.csv*' > /dev/null && fail "points $*: left a file"
}
refuse
refuse sobol
refuse sobol -n 0
refuse sobol -n -1
refuse sobol -n 1e3
refuse sobol -n 99999999999999999999
refuse sobol -n 99999999999999999
refuse sobol halton -n 4
refuse sobl -n 4
refuse healpix -n 16
refuse t-design -n 9
refuse lebedev -n 100
refuse lebedev -n 14 --domain axes
refuse healpix -n 12 --domain hemisphere
refuse healpix -n 12 --cap 30
refuse sobol -n 4 --symmetry 432
refuse sobol -n 4 --domain sphere --matrices
refuse super-fibonacci -n 4 --symmetry 532
refuse super-fibonacci -n 4 --domain sphere
refuse super-fibonacci -n 4 --cap 30
refuse super-fibonacci -n 4 --lobe cosine
refuse fibonacci-lattice -n 4 --domain rotations
refuse sobl -n 4 --domain sphere
refuse sobol:x=1 -n 4
refuse sobol -n 4 --dim 0
refuse sobol -n 4 --dim 3 --domain sphere
refuse larcher-pillichshammer -n 4 --dim 3
refuse sobol -n 4 --domain torus
refuse sobol -n 4 --map lambert
refuse sobol -n 4 --domain sphere --map mercator
refuse sobol -n 4 --lobe phong:-1
refuse sobol -n 4 --lobe phong:nan
refuse sobol -n 4 --lobe phong:inf
refuse sobol -n 4 --lobe cosine --domain sphere
refuse sobol -n 4 --lobe cosine --density best
refuse sobol -n 4 --lobe cosine --density optimal --smoothness 6
refuse sobol -n 4 --lobe cosine --density optimal --smoothness nan
refuse sobol -n 4 --lobe ggx:0.5 --density optimal
refuse sobol -n 4 --scramble sobol
refuse sobol -n 4 --scramble rotate3d
refuse sobol -n 4 --domain hemisphere --scramble rotate3d
refuse sobol -n 4 --seed x
refuse sobol -n 4 --cap 20
refuse sobol -n 4 --cap nan --domain sphere
refuse sobol -n 4 --cap 100 --domain hemisphere
refuse sobol -n 4 --format obj
refuse sobol -n 4 --dim 5 --format ply
refuse sobol -n 4 --first 5
refuse sobol -n 4 --first 4
refuse sobol -n 4 --first 2 --count 3
refuse sobol -n 4 --count 0
refuse sobol -n 4 --frist 1
refuse sobol -n 4 --warp nothing.png
refuse sobol -n 4 --warp ramp.png --domain sphere
refuse sobol -n 4 --warp own.csv
printf 'PF\n1 1\n-1\n\0\0\200?\0\0\200?\0\0\200?' > white.pfm
"$aureole" convert white.pfm --channels R,G two.exr || fail "two channels"
refuse sobol -n 4 --warp two.exr
grep -q 'two.exr must have one channel' stderr.txt || fail "what two channels lack: $(cat stderr.txt)"
refuse spherical-fibonacci -n 4 --domain square
refuse spherical-fibonacci -n 4 --scramble owen
refuse spherical-fibonacci:offset=nan -n 4
refuse spherical-fibonacci:region=octant -n 4 --cap 20
refuse esfg:base=64,levels=1 -n 300
refuse file:nothing.csv
refuse file:own.csv -n 17
refuse file:disk.csv --domain sphere
refuse file:disk.csv --scramble rotate
refuse file:whole.csv --domain square
printf 'x,y,z\n0,0,1\n0,0\n' > ragged.csv
printf 'x,y,z\n0,0,1\n0,0,nan\n' > nan.csv
printf 'x,y,z\n0,0,1\n0,0,2\n' > off.csv
printf 'u,v\n0,0.5\n0,1.5\n' > off-square.csv
for file in ragged nan off off-square; do
  refuse file:$file.csv
  grep -q "$file.csv:3" stderr.txt || fail "$file.csv: the line is not named: $(cat stderr.txt)"
done
"$aureole" points sobol -n 4 -o nowhere/points.csv 2> /dev/null
[ $? = 3 ] || fail "a folder that is not there is a failure of the system"
exit $status

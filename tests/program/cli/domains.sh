#!/usr/bin/env bash
# Points keep their domain in files; where nothing gives it, that is said; weights of files are used or refused.
set -u
aureole=$1
status=0
fail() {
  echo "FAIL: $*"
  status=1
}
says() { # says STATUS WORDS ARGUMENT...: the exit status, and what is said besides the result; no WORDS: nothing
  local wanted=$1 text=$2
  shift 2
  "$aureole" "$@" >output 2>words
  [ $? = "$wanted" ] || fail "aureole $*: exit status is not $wanted: $(cat words)"
  if [ -n "$text" ]; then
    tr -s ' \n' ' ' <words | grep -qF -- "$text" || fail "aureole $*: no '$text' in: $(cat words)"
  else
    [ ! -s words ] || fail "aureole $*: says $(cat words)"
  fi
}
domain_of() { "$aureole" info "$1" --format csv 2>words | sed -n '2s/,.*//p'; }

# Each domain comes back from each format that is read, with weights and without, and nothing has to be said.
rows=(
  "square sobol -n 8" "cube halton -n 8 --domain cube --dim 3" "cube halton -n 8 --domain cube --dim 4" "disk sobol -n 8 --domain disk"
  "disk sobol -n 8 --domain disk --map polar" "hemisphere spherical-fibonacci -n 8 --domain hemisphere"
  "hemisphere sobol -n 8 --domain hemisphere --lobe phong:5 --density optimal" "sphere spherical-fibonacci -n 8 --domain sphere"
  "sphere spherical-fibonacci -n 8 --domain sphere --cap 40" "sphere lebedev -n 6 --domain sphere"
  "axes electrostatic -n 8 --domain axes" "axes random -n 1 --domain axes" "rotations super-fibonacci -n 8"
  "rotations super-fibonacci -n 8 --symmetry 1"
)
for row in "${rows[@]}"; do
  read -r domain rest <<<"$row"
  for format in csv npy; do
    "$aureole" points $rest -q -o file.$format || fail "points $rest"
    [ "$(domain_of file.$format)" = "$domain" ] || fail "points $rest: $format is of the $(domain_of file.$format)"
    [ ! -s words ] || fail "points $rest: $format: $(cat words)"
  done
  "$aureole" points $rest -q --format json | grep -q "\"domain\": \"$domain\"" || fail "points $rest: no domain in JSON"
done
"$aureole" points electrostatic -n 8 --domain axes -o file.ply && grep -aq '^comment domain axes' file.ply || fail "no domain in PLY"
# So do weights that were computed.
"$aureole" points electrostatic -n 60 --domain axes -o axes.csv
for method in exact voronoi; do
  says 0 "" weights axes.csv --method $method -o weighted.csv
  [ "$(domain_of weighted.csv)" = axes ] || fail "weights of axes by $method are of the $(domain_of weighted.csv)"
done

# Those of rotations have a name that no coordinate has; files with a second w are read too.
says 0 "" weights super-fibonacci -n 20 --domain rotations -o turns.csv
[ "$(head -1 turns.csv)" = w,x,y,z,weight ] || fail "weights of rotations have the header $(head -1 turns.csv)"
sed '1s/weight/w/' turns.csv >older.csv
for file in turns.csv older.csv; do
  [ "$("$aureole" info $file --format csv | cut -d, -f1,3 | tr '\n' ' ')" = "domain,coordinate rotations,w rotations,x rotations,y rotations,z rotations,weight " ] ||
    fail "$file: $("$aureole" info $file --format csv)"
  "$aureole" measure $file --metric energy --format csv | tail -n +2 | cut -d, -f2- >"$file.energy" || fail "measure $file"
done
cmp turns.csv.energy older.csv.energy || fail "a second column w is read as something else"
says 0 "" weights super-fibonacci -n 20 --domain rotations --levels 10,20 -o turns.csv
[ "$(head -1 turns.csv)" = w,x,y,z,weight,weight2 ] || fail "levels of rotations have the header $(head -1 turns.csv)"

# A rule for axes: exact for even polynomials, where the means over the sphere are known.
says 0 "" weights axes.csv --method exact -o exact.csv
tail -n +2 exact.csv | awk -F, '
  function off(sum, truth) { return sum - truth > 1e-14 || truth - sum > 1e-14 }
  { one += $4; z2 += $4 * $3 ^ 2; xy += $4 * $1 * $2; z4 += $4 * $3 ^ 4; x2y2 += $4 * $1 ^ 2 * $2 ^ 2; z6 += $4 * $3 ^ 6; x2y2z2 += $4 * ($1 * $2 * $3) ^ 2; z8 += $4 * $3 ^ 8 }
  END { exit off(one, 1) || off(z2, 1 / 3) || off(xy, 0) || off(z4, 1 / 5) || off(x2y2, 1 / 15) || off(z6, 1 / 7) || off(x2y2z2, 1 / 105) || off(z8, 1 / 9) }' ||
  fail "exact weights of axes are not"
# Areas of cells are those that `voronoi` has.
"$aureole" weights axes.csv --method voronoi | tail -n +2 | awk -F, '{ printf "%.5g\n", 60 * $4 }' >areas
"$aureole" voronoi axes.csv --format csv | tail -n +2 | awk -F, '{ printf "%.5g\n", $5 }' | cmp - areas || fail "weights by cells of axes"
says 2 "use --method exact or voronoi" weights axes.csv
says 2 "--domain hemisphere takes its points for that" weights axes.csv --lobe cosine --method exact
says 0 "" weights axes.csv --domain hemisphere --method exact --report # who says so

# Without the comment it is said that the numbers decided; --domain decides without a word.
sed '1s/#.*//' axes.csv >open.csv
"$aureole" points file:axes.csv -o closed.npy
awk -F, '{ print $1 " " $2 " " $3 }' <(tail -n +2 axes.csv) >bare.txt
for file in open.csv bare.txt; do
  says 0 "assuming the hemisphere" measure $file -m energy
  says 0 "assuming the hemisphere" weights $file --method exact --report
  says 0 "assuming the hemisphere" voronoi $file
  says 0 "assuming the hemisphere" info $file
  says 0 "assuming the hemisphere" points file:$file
  for domain in axes hemisphere sphere; do
    says 0 "" measure $file -m energy --domain $domain
  done
done
says 0 "" nearest axes.csv axes.csv
"$aureole" nearest axes.csv open.csv 2>/dev/null | cmp - output || fail "queries that could be axes are not"
# Points of the cube of unit length, in an array without names: said, too.
printf '\x93NUMPY\x01\x00\x46\x00%-69s\n' "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 3), }" >unit.npy
printf '\x33\x33\x33\x33\x33\x33\xe3\x3f\x9a\x99\x99\x99\x99\x99\xe9\x3f\x00\x00\x00\x00\x00\x00\x00\x00' >>unit.npy # .6 .8 0
says 0 "assuming the hemisphere" info unit.npy
says 0 "" measure unit.npy -m star-bound --domain cube

# Comments that are not ours say nothing, and ours do not contradict the columns.
{ echo "# domain: Berlin"; echo "# domain names"; cat axes.csv; } >comments.csv
[ "$(domain_of comments.csv)" = axes ] || fail "other comments"
{ echo "# domain: axes"; tail -n +2 axes.csv; } >above.csv
[ "$(domain_of above.csv)" = axes ] || fail "a comment on a line of its own"
{ echo "x,y,z# domain: cube"; tail -n +2 axes.csv; } >false.csv
says 2 "says that the points are of the domain 'cube'" measure false.csv -m energy
{ echo "x,y,z# domain: hemisphere"; echo "0,0,-1"; } >below.csv
says 2 "below.csv:2: point 1 has z = -1, below the hemisphere" info below.csv

# A part of a file's points is no set of that size.
says 0 "only the first 12 of the file's 60 points" points file:axes.csv -n 12
says 2 "has 60 points, not 61" points file:axes.csv -n 61
for verb in voronoi "nearest" weights; do
  says 2 "has 60 points, not 12: omit -n" $verb axes.csv $([ $verb = nearest ] && echo axes.csv) -n 12
done
"$aureole" points sobol -n 16 -o square.csv
says 0 "only the first 8 of the file's 16 points" measure file:square.csv -n 8 -m star
says 0 "" measure file:square.csv -n 16 -m star

# Weights of a file that becomes a pattern: refused where they would be lost, but for equal ones, which say nothing.
scene() {
  echo '<scene version="3.0.0"><emitter type="constant"/><shape type="sphere"/><sensor type="perspective"><film type="hdrfilm">
<integer name="width" value="4"/><integer name="height" value="4"/></film></sensor></scene>'
}
scene >scene.xml
echo "0 0 2 0 0 1" >sensors.pts
tail -n +2 square.csv | awk -F, 'BEGIN { print "u,v,w" } { print $0 "," NR / 136 }' >weighted-square.csv
tail -n +2 square.csv | awk 'BEGIN { print "u,v,w" } { print $0 ",.0625" }' >equal-square.csv
"$aureole" points spherical-fibonacci -n 16 --domain hemisphere -o directions.csv
tail -n +2 directions.csv | awk -F, 'BEGIN { print "x,y,z,w# domain: hemisphere" } { print $0 "," NR / 136 }' >weighted-directions.csv
tail -n +2 directions.csv | awk 'BEGIN { print "x,y,z,w# domain: hemisphere" } { print $0 ",.0625" }' >equal-directions.csv
for command in "measure file:%-square.csv -m star --format csv" "render scene.xml -q --spp 16 -o - --sampler file:%-square.csv" \
  "render scene.xml -q --spp 1 -o - --integrator finalgather:pattern=(file:%-square.csv),diffuse_samples=16,glossy_samples=16,photons=100" \
  "render scene.xml -q --spp 1 -o - --integrator ao:pattern=(file:%-directions.csv),scramble=rotate,samples=16" \
  "irradiance scene.xml --sensors sensors.pts -n 256 --set file:%-directions.csv"; do
  says 2 "weights" ${command/\%/weighted}
  plain=${command/\%-/} equal=${command/\%/equal}
  "$aureole" $equal >equal.out 2>words || fail "$equal: $(cat words)"
  "$aureole" $plain >plain.out 2>words || fail "$plain: $(cat words)"
  sed -i 's/equal-//g' equal.out
  cmp equal.out plain.out || fail "$equal is not $plain"
done
# The polar map makes weights, which patterns do not use.
for integrator in "ao:pattern=sobol,map=polar" "ao:pattern=sobol,map=polar,scramble=rotate" "finalgather-lab:pattern=sobol,map=polar"; do
  says 2 "weights" render scene.xml --spp 1 --integrator "$integrator"
done

# FSL's bvecs have a direction a column; a row of zeros is no direction.
awk '{ for (i = 1; i <= 3; ++i) row[i] = row[i] (NR > 1 ? " " : "") $i } END { for (i = 1; i <= 3; ++i) print row[i] }' bare.txt >bvecs
says 2 "a direction in each column, as FSL's bvecs" measure bvecs -m energy
sed 's/^/0 /' bvecs >bvecs0 # of an image without a gradient
says 2 "a direction in each column, as FSL's bvecs" points file:bvecs0
printf '0.6 0\n0.8 0\n0 1\n' >bvecs2
says 2 "a direction in each column, as FSL's bvecs" info bvecs2
{ echo "0 0 0"; cat bare.txt; } >rows
says 2 "rows:1: 0 0 0 is not a direction" measure rows -m energy --domain axes
exit $status

#!/usr/bin/env bash
# View factors for heat and cities: emittances and temperatures, script F, View3D's input, uDALES's files, and a target error.
. "$2/tests/lighting/checks.sh.inc"
command=viewfactors
near() { # WHAT VALUE EXPECTED TOLERANCE
  awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; exit !(a != "" && d <= t && -d <= t) }' || fail "$1: $2, not $3"
}

# --- a cube whose floor (1) sees only the rest (2): F12 = 1, A1 / A2 = 1 / 5
{
  printf 'v %s\n' '0 0 0' '1 0 0' '0 1 0' '1 1 0' '0 0 1' '1 0 1' '0 1 1' '1 1 1'
  printf 'g floor\nf 1 2 4 3\ng rest of it\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n'
} >room.obj
printf '# kelvin\nname, emittance, temperature\n*, .4, 300\nfloor, .7, 350\n' >warm.csv
script=$(awk 'BEGIN { printf "%.15g", 1 / (.3 / .7 + 1 + .6 / (5 * .4)) }')
flux=$(awk -v f="$script" 'BEGIN { printf "%.12g", 5.670374419e-8 * (350 ^ 4 - 300 ^ 4) * f }')
"$aureole" viewfactors room.obj --group --surfaces warm.csv -q -o warm.out || fail "temperatures"
near "the floor's net flux" "$(awk -F, 'NR == 2 { print $7 }' warm.out)" "$flux" 1e-4
near "the rest's net flux" "$(awk -F, 'NR == 3 { printf "%.12g", 5 * $7 }' warm.out)" "-$flux" 1e-4
printf 'name, emittance, temperature\nfloor, .7, 350\n*, .4, 300\n' >after.csv
"$aureole" viewfactors room.obj --group --surfaces after.csv -q | cmp - warm.out || fail "'*' takes a row that another line names"
"$aureole" viewfactors room.obj --group --surfaces warm.csv --matrix-free --rays 16384 -q -o free.out || fail "without a matrix"
awk -F, -v q="$flux" 'NR == 2 { d = $7 - q; exit !($8 > 0 && d < 3 * $8 && d > -3 * $8) }' free.out || fail "the floor's net flux, matrix-free: $(cat free.out)"
"$aureole" viewfactors room.obj --group --script-f --surfaces warm.csv -q -o script.csv || fail "script F"
near "script F" "$(awk -F, '$1 == 0 && $2 == 1 { print $3 }' script.csv)" "$script" 1e-6
awk -F, 'NR > 1 { sum[$1] += $3 } END { exit !(sum[0] > .7 - 1e-9 && sum[0] < .7 + 1e-9 && sum[1] > .4 - 1e-9 && sum[1] < .4 + 1e-9) }' script.csv ||
  fail "rows of script F do not add up to the emittance: $(cat script.csv)"
# Reflectances and emissions say the same as one number for all.
printf 'row,reflectance,emission\n*,.5,2\n' >same.csv
"$aureole" viewfactors room.obj --surfaces same.csv -q | cut -d, -f1-5 >a.csv
"$aureole" viewfactors room.obj --radiosity .5 --emission 2 -q | cmp - a.csv || fail "a table of equal rows"
# A black plate under the sun: all of it arrives, nothing leaves.
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng plate\nf 1 2 3 4\n' >plate.obj
printf 'name,reflectance\nplate,0\n' >black.csv
"$aureole" viewfactors plate.obj --group --surfaces black.csv --sun 0,3,4 --sky 2 -q >plate.csv || fail "a black plate"
near "what arrives on a plate" "$(awk -F, 'NR == 2 { print $6 }' plate.csv)" 6 1e-9
near "what leaves a black plate" "$(awk -F, 'NR == 2 { print $4 }' plate.csv)" 0 0
for bad in 'nome,reflectance\na,1' 'name,reflectance,emittance\n*,1,1' 'name,reflectance,temperature\n*,1,1' 'row,name,reflectance\n1,a,1'; do
  printf "$bad\n" >bad.csv
  refused "bad.csv:1: " room.obj --group --surfaces bad.csv
done
for bad in '*,1.5,0' '*,x,0' '*,.5,-1' 'none,.5,1' '*,.5' ; do
  printf "name,emittance,temperature\n$bad\n" >bad.csv
  refused "bad.csv:2: " room.obj --group --surfaces bad.csv
done
printf 'name,reflectance\nfloor,.5\n*,.1\nfloor,.6\n' >bad.csv
refused "bad.csv:4: a second line of this name (floor)" room.obj --group --surfaces bad.csv
refused "bad.csv:2: the rows of a mesh have names with --group only (floor)" room.obj --surfaces bad.csv
printf 'name,reflectance\nfloor,.5\n' >bad.csv
refused "row 1, rest of it has no line" room.obj --group --surfaces bad.csv
refused "none.csv: cannot read: No such file" room.obj --surfaces none.csv
mkfifo pipe
refused "it is a pipe" room.obj --surfaces pipe
refused "--script-f needs emittances" room.obj --script-f
refused "--radiosity cannot be used" room.obj --surfaces same.csv --radiosity .5

# --- View3D's input: what is written is read again; combined surfaces, and one on another
"$aureole" viewfactors room.obj --group -q -o room.csv && "$aureole" viewfactors room.obj --group -o room.vs3 && "$aureole" viewfactors room.vs3 -q -o again.csv || fail "vs3"
paste -d, room.csv again.csv | awk -F, 'NR > 1 { d = $3 - $7; if (!($1 == $5 && $2 == $6 && d < 1e-9 && d > -1e-9)) bad = 1 } END { exit bad }' ||
  fail "a .vs3 of our own: $(cat again.csv)"
cat >two.vs3 <<'VS3'
T two plates, 1 apart; a window of .25 in the lower one ! a comment
C encl=0 out=1
F 3
V 1 0 0 0
V 2 1 0 0
V 3 1 1 0
V 4 0 1 0
V 5 0 0 1
V 6 1, 0, 1
V 7 1 1 1
V 8 0 1 1
V 9 .25 .25 0
V 10 .75 .25 0
V 11 .75 .75 0
V 12 .25 .75 0
S 1 1 2 3 4 0 0 .5 lower
S 2 5 8 7 0 0 0 .8 upper
S 3 9 10 11 12 1 0 .9 window ! cut out of 1
S 4 5 7 6 0 0 2 .8 other-half
End of data
S 5 nothing is read here
VS3
"$aureole" viewfactors two.vs3 --radiosity 0 --sky 1 -q -o areas.csv 2>/dev/null || fail "areas of a .vs3"
[ "$(cut -d, -f2 areas.csv | tr '\n' ' ')" = "area 0.75 1 0.25 " ] || fail "surfaces of a .vs3: $(cat areas.csv)"
"$aureole" viewfactors two.vs3 -q -o two.csv || fail "factors of a .vs3"
near "opposed squares (C-11)" "$(awk -F, '$1 == 1 && $2 >= 0 { sum += $3 } END { print sum }' two.csv)" .199824895698 1e-6
"$aureole" viewfactors two.vs3 --script-f -q --to csv | awk -F, 'NR > 1 { sum[$1] += $3 } END { d = sum[2] - .9; exit !(d < 1e-9 && d > -1e-9) }' || fail "emittances of a .vs3"
bad() { # TEXT LINE
  { sed -n '1,15p' two.vs3; echo "$2"; } >bad.vs3
  refused "$1" bad.vs3
}
bad "bad.vs3:16: S: numbers of vertices above" "S 1 1 2 99 4 0 0 1 x"
bad "bad.vs3:16: S: numbers of vertices above" "S 1 1 2 0 4 0 0 1 x"
bad "bad.vs3:16: S: surfaces must be numbered" "S 2 1 2 3 4 0 0 1 x"
bad "bad.vs3:16: S: base and combined" "S 1 1 2 3 4 7 0 1 x"
bad "bad.vs3:16: S: an emittance" "S 1 1 2 3 4 0 0 1.5 x"
bad "bad.vs3:16: V: vertices must be numbered" "V 15 1 2 3"
bad "bad.vs3:16: V: a number and three" "V 13 1 2"
bad "bad.vs3:16: V: a number and three" "V 13 1 2 nan"
bad "bad.vs3:16: O: an obstruction" "O 1 1 2 3 4"
bad "bad.vs3:16: F: only" "F 3a"
bad "no surface" "! nothing"

# --- uDALES: numbers from 1, and with the sky they add up to 1
"$aureole" viewfactors plate.obj two.vs3 -o x.csv 2>/dev/null && fail "a mesh goes on in no other file"
{ cat room.obj; printf 'v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nv -9 -9 2\nv 9 -9 2\ng ground\nf 9 10 11 12\ng wall\nf 9 13 14 10\n'; } >open.obj
"$aureole" viewfactors open.obj -q -o vfsparse.inp.042 2>/dev/null || fail "uDALES"
[ "$(head -1 svf.inp.042)" = "# sky view factors" ] && [ "$(grep -c . facetarea.inp.042)" = 17 ] || fail "uDALES's files: $(head svf.inp.042)"
{ awk '{ print $1, $3 }' vfsparse.inp.042; grep -v '#' svf.inp.042 | awk '{ print NR, $1 }'; } |
  awk '$1 >= 13 { sum[$1] += $2 } END { for (i in sum) { ++n; if (sum[i] > 1.000001 || sum[i] < .9) bad = 1 } exit bad || n != 4 }' || fail "uDALES's rows"
# Types of facets: what these absorb is what arrives times 1 - albedo. The ground has the sun, 500, and the room is closed.
mkdir case
awk 'BEGIN { print "# type, normal"; for (i = 0; i < 16; ++i) print (i < 12 ? 1 : -101), 0, 0, 1 }' >case/facets.inp.042
printf '# wallid lGR z0 z0h al em d1\n -101 0 .1 .1 .2 .9 1\n 1 0 .1 .1 .6 .9 1\n' >case/factypes.inp.042
"$aureole" viewfactors open.obj --surfaces case/facets.inp.042 --sun 0,0,500 -q -o case/netsw.inp.042 2>/dev/null || fail "net short-wave"
[ "$(head -1 case/netsw.inp.042 | cut -c1-25)" = "# net shortwave on facets" ] && [ "$(grep -c . case/netsw.inp.042)" = 17 ] || fail "netsw.inp: $(cat case/netsw.inp.042)"
"$aureole" viewfactors open.obj --surfaces case/facets.inp.042 --sun 0,0,500 -q -o rows.csv 2>/dev/null
paste -d, <(tail -n +2 rows.csv) <(tail -n +2 case/netsw.inp.042) | awk -F, '{ a = $1 < 12 ? .6 : .2; d = $9 - (1 - a) * $6; if (!(d < 6e-5 && d > -6e-5)) bad = 1; sum += $9 } END { exit bad || !(sum > 2 * .8 * 500 && sum < 900) }' || fail "what facets absorb"
sed -i '2d' case/facets.inp.042
refused "case/facets.inp.042: 15 facets, and the mesh has 16 rows" open.obj --surfaces case/facets.inp.042 --sun 0,0,500
sed -i '2s/^1 /7 /' case/facets.inp.042
refused "case/facets.inp.042:2: a line for each facet" open.obj --surfaces case/facets.inp.042 --sun 0,0,500
refused "vfsparse.inp.NNN expected" open.obj --to udales -o other.txt

# --- a target error
"$aureole" viewfactors open.obj -q --rays 64 --error .004 -o precise.csv 2>/dev/null || fail "--error"
awk -F, 'NR > 1 && $4 > .004 { bad = 1 } END { exit bad }' precise.csv || fail "half widths beyond --error"
"$aureole" viewfactors open.obj -q --rays 64 -o rough.csv 2>/dev/null
awk -F, 'NR > 1 && $4 > .004 { rough = 1 } END { exit !rough }' rough.csv || fail "64 rays reach the error already"
refused "--error" room.obj --error 0
refused "--error cannot be used" room.obj --radiosity .5 --matrix-free --error .1

finish

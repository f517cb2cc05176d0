#!/usr/bin/env bash
# aureole viewfactors: its files, what it reports of odd meshes, and what it refuses.
. "$2/tests/lighting/checks.sh.inc"
command=viewfactors

corners='v 0 0 0
v 1 0 0
v 0 1 0
v 1 1 0
v 0 0 1
v 1 0 1
v 0 1 1
v 1 1 1'
{
  echo "$corners"
  printf 'g floor\nf 1 2 4 3\ng ceiling of glass\nf 5 7 8 6\ng walls\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n'
} >room.obj

# --- formats
"$aureole" viewfactors room.obj --group -o room.csv || fail "csv"
awk -F, '$1 == 0 && $2 == 1 { found = ($3 > .199824894 && $3 < .199824898) } END { exit !found }' room.csv ||
  fail "the cube's opposite sides: $(cat room.csv)"
[ "$(grep -c ',-1,0,0$' room.csv)" = 3 ] || fail "a closed room sees sky: $(cat room.csv)"
"$aureole" viewfactors room.obj --to view3d >room.vf || fail "view3d"
[ "$(sed -n 1p room.vf | wc -c)" = 31 ] || fail "the first line of View3D's output has 30 characters"
[ "$(sed -n 3p room.vf | wc -w)" = 12 ] || fail "a row of View3D's output has all columns"
[ "$(wc -l <room.vf)" = 15 ] || fail "View3D's output has a line for each row and three more"
"$aureole" viewfactors room.obj --group -o room.vs3 || fail "vs3"
[ "$(grep -c '^V ' room.vs3)" = 8 ] && [ "$(grep -c '^S ' room.vs3)" = 12 ] || fail "vs3: $(cat room.vs3)"
grep -q '^S 4 .* 0 0 3 1.0 ceiling_of_glass$' room.vs3 || fail "vs3 combines the surfaces of a group: $(cat room.vs3)"
"$aureole" viewfactors room.obj --group -o room.npz || fail "npz"
if command -v python3 >/dev/null; then
  python3 - room.npz <<'PYTHON' || fail "the archive is not what NumPy reads"
import struct, sys, zipfile
with zipfile.ZipFile(sys.argv[1]) as archive:
    assert archive.testzip() is None
    def read(name):
        raw = archive.read(name + ".npy")
        assert raw[:8] == b"\x93NUMPY\x01\x00"
        end = 10 + struct.unpack("<H", raw[8:10])[0]
        assert end % 64 == 0
        return eval(raw[10:end]), raw[end:]
    head, data = read("data")
    count = head["shape"][0]
    values = struct.unpack(f"<{count}d", data)
    starts = struct.unpack("<4q", read("indptr")[1])
    assert read("format")[1] == b"csr" and struct.unpack("<2q", read("shape")[1]) == (3, 3)
    assert starts[0] == 0 and starts[3] == count == len(read("indices")[1]) // 4
    for i in range(3):
        assert abs(sum(values[starts[i]:starts[i + 1]]) - 1) < 1e-12
    assert read("names")[1].split(b"\0")[0].startswith(b"floor")
PYTHON
fi
"$aureole" viewfactors room.obj --format csv | grep -q '^12,120,24576,60,0,1,' || fail "the summary"

# --- a scene's shapes by their ids, and radiosities
cat >scene.xml <<'XML'
<scene version="3.0.0"><sensor type="perspective"/>
<shape type="rectangle" id="ground"/>
<shape type="cube" id="house"><transform name="to_world"><scale value="0.3"/><translate z="0.31"/></transform></shape>
</scene>
XML
"$aureole" viewfactors scene.xml --group --to npz 2>/dev/null | grep -qa 'ground.*house' || fail "names of shapes"
"$aureole" viewfactors scene.xml --radiosity 0.5 -q >matrix.csv || fail "radiosity"
"$aureole" viewfactors scene.xml --radiosity 0.5 --matrix-free -q >free.csv || fail "matrix-free"
paste -d, matrix.csv free.csv | awk -F, 'NR > 1 && ($4 - $9) ^ 2 > .0004 { bad = 1 } END { exit bad || NR != 15 }' ||
  fail "radiosities with and without the matrix: $(paste -d, matrix.csv free.csv)"
refused "no light: no row sees the sky" room.obj --radiosity 0.5
# The sun alone, in the zenith: the house shades .36 of the ground's 4, and gives a little of its light back.
"$aureole" viewfactors scene.xml --group --radiosity 0.5 --sun 0,0,4 --matrix-free -q >sun.csv || fail "sun"
awk -F, 'NR == 2 && $4 > 4 * .5 * (4 - .36) / 4 - .05 && $4 < 4 * .5 * (4 - .36) / 4 + .15 && $5 > 0 && $5 < .02 { good = 1 }
  END { exit !(good && NR == 3) }' sun.csv || fail "the sun on the ground: $(cat sun.csv)"
refused "expected a direction X,Y,Z" scene.xml --radiosity 0.5 --sun 1,2
refused "expected a direction X,Y,Z" scene.xml --radiosity 0.5 --sun 0,0,0
refused "need --radiosity" scene.xml --sky 2
refused "no light: give sky" scene.xml --radiosity 0.5 --sky 0

# --- odd meshes: counted warnings
{
  cat room.obj
  printf 'f 1 2 4\nf 4 2 1\nf 1 1 2\n'
} >odd.obj
said=$("$aureole" viewfactors odd.obj 2>&1 >/dev/null)
grep -q 'odd.obj:20: 1 facets have no area' <<<"$said" || fail "a facet without area: $said"
grep -q 'odd.obj:18: 1 facets lie in the plane of others that come first in the file' <<<"$said" || fail "a doubled facet: $said"
grep -q '1 facets lie back to back with others' <<<"$said" || fail "a sheet: $said"
{
  echo "$corners"
  printf 'f 1 2 4 3\nf 1 2 6 5\n'
} >open.obj
said=$("$aureole" viewfactors open.obj 2>&1 >/dev/null)
grep -q 'open.obj:9: 6 edges belong to one facet only' <<<"$said" || fail "an open mesh: $said"
grep -q '1 edges join facets that face inwards' <<<"$said" || fail "an inconsistent mesh: $said"
grep -q 'rows see backs of facets' <<<"$said" || fail "backs that are seen: $said"
# Facets that are narrower than rays in floats resolve: the four sides of a slab, before the work begins.
for height in 1e-9 1e-4; do
  awk -v h=$height 'BEGIN { for (i = 0; i < 8; ++i) {
      x = i % 2; y = int(i / 2) % 2; z = int(i / 4) * h + .3
      printf "v %.17g %.17g %.17g\n", x * .8 - z * .6, y, x * .6 + z * .8 }
    print "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6" }' >slab.obj
  said=$("$aureole" viewfactors slab.obj 2>&1 >/dev/null)
  case $height in
    1e-9) grep -q 'slab.obj:11: 8 facets are narrower than rays in floats resolve' <<<"$said" || fail "a slab 1e-9 high: $said" ;;
    *) ! grep -q narrower <<<"$said" || fail "a slab 1e-4 high: $said" ;;
  esac
done
# The largest share of what leaves a row is said, not the last one: a plate that sees the back of its twin a side above it, .1998 of it.
cat >twins.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
g below
f 1 2 3 4
g above
f 5 6 7 8
OBJ
said=$("$aureole" viewfactors twins.obj --group --rays 65536 2>&1 >/dev/null)
grep -qE '1 rows see backs of facets, up to 0\.(199|2) of' <<<"$said" || fail "the largest share of backs: $said"
[ -z "$("$aureole" viewfactors open.obj --both-sides --group -q --to csv | grep -e ',-2,')" ] || fail "backs are rows"

# Half widths: none of a closed form, and of rays one that the error of what leaves the lower plate for the sky does not exceed
# by far (its other side is Howell's C-11), nor falls far below.
awk -F, '$1 == 0 && $2 == 1 { found = $4 == 0 } END { exit !found }' room.csv || fail "a closed form has an interval: $(cat room.csv)"
"$aureole" viewfactors twins.obj --group -q --to csv --rays-only --rays 4096 >rays.csv
[ "$(head -1 rays.csv)" = row,column,factor,half_width ] || fail "columns: $(head -1 rays.csv)"
awk -F, '$1 == 0 && $2 == -1 { off = ($3 - .80017510430161) / $4; width = $4 } END { exit !(width > 1e-4 && width < .01 && off < 3 && off > -3) }' rays.csv ||
  fail "half widths: $(cat rays.csv)"

# Two rays per facet of a tetrahedron: by some seeds three facets see only the fourth, which has less area than
# they have together, so that no symmetric exchanges add up. The warning counts the rows that do not.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n' >tetrahedron.obj
warned=0
for seed in 0 1 2 3 4 5; do
  said=$("$aureole" viewfactors tetrahedron.obj --rays 2 --randomizations 2 --rays-only --seed $seed -o rows.csv 2>&1)
  lacking=$(awk -F, 'NR > 1 { sum[$1] += $3 } END { for (i in sum) n += (sum[i] - 1) ^ 2 > 1e-18; print n + 0 }' rows.csv)
  told=$(sed -n 's/.*: \([0-9]*\) rows cannot be made to add up to 1 with symmetric exchanges.*/\1/p' <<<"$said")
  [ "${told:-0}" = "$lacking" ] || fail "seed $seed: $lacking rows do not add up to 1: $said"
  warned=$((warned + (lacking > 0)))
done
[ $warned -gt 0 ] && [ $warned -lt 6 ] || fail "$warned of 6 seeds leave rows that do not add up"

# --- bad input
refused "missing.obj" missing.obj
printf 'v 0 0 0\nf 1 2 3\n' >bad.obj
refused "bad.obj:2" bad.obj
printf 'v 0 0 nan\n' >nan.obj
refused "nan.obj:1" nan.obj
: >empty.obj
refused "no face" empty.obj
refused "unknown kind of file" "$0"
printf '<scene version="3.0.0"><sensor type="perspective"/>\n<shape type="sphere"/></scene>\n' >round.xml
refused "round.xml:2" round.xml
refused "unknown format of" room.obj -o room.what
refused "--matrix-free needs --radiosity" room.obj --matrix-free
refused "randomisations" room.obj --rays 4
refused "a mesh is one file" room.obj room.obj
refused "no-such-set" room.obj --set no-such-set
mkdir -p 'a & <b> $c'
cp room.obj 'a & <b> $c/"room".obj'
"$aureole" viewfactors 'a & <b> $c/"room".obj' >/dev/null || fail "a path with characters that XML escapes"

finish

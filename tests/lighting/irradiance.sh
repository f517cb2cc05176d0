#!/usr/bin/env bash
# aureole irradiance: known irradiances, the same bits on any number of threads and beside any other sensors, and what it
# refuses or reports.
. "$2/tests/lighting/checks.sh.inc"
command=irradiance
# warned TEXT ARGUMENTS...: the command ends well and says the text.
warned() {
  local text=$1 said
  shift
  said=$("$aureole" irradiance "$@" 2>&1 >/dev/null) || fail "$*: $said"
  grep -qF -- "$text" <<<"$said" || fail "$*: '$text' is not in: $said"
}
# near COLUMN VALUE FILE: that column of each sensor is within five standard errors (three columns on) of the value.
near() {
  awk -F, -v c="$1" -v value="$2" 'NR > 1 { d = $c - value; if (d < 0) d = -d; if (!(d <= 5 * $(c + 3) + 1e-5 * value)) bad = 1 }
    END { exit bad || NR < 2 }' "$3" || fail "column $1 of $3 is not $2: $(cat "$3")"
}

printf '0 0 0 0 0 1\n.9 .3 .2 1 1 0\n# on the floor\n0 0 -1 0 0 1\n' >room.pts

# A closed room whose walls all emit 1 and reflect half of what they get: the radiance is everywhere 1 / (1 - .5).
cat >room.xml <<'XML'
<scene version="3.0.0">
  <shape type="cube">
    <boolean name="flip_normals" value="true"/>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="1, 2, 3"/></emitter>
  </shape>
</scene>
XML
"$aureole" irradiance -q room.xml -n 1024 --sensors room.pts --parts -o room.csv || fail "a room"
head -1 room.csv | grep -q '^x,y,z,r,g,b,r_error,g_error,b_error,direct_r,' || fail "columns: $(head -1 room.csv)"
near 4 6.283185307 room.csv
near 6 18.849555922 room.csv
near 10 3.141592654 room.csv
near 23 6.283185307 room.csv
"$aureole" irradiance -q room.xml -n 1024 --sensors room.pts --max-depth 1 -o direct.csv || fail "direct light"
near 4 3.141592654 direct.csv

# A uniform sky, which one sensor sees wholly and the one that looks at the horizon by half.
printf '<scene version="3.0.0"><emitter type="constant"><rgb name="radiance" value="2"/></emitter>
<shape type="rectangle"><transform name="to_world"><scale value="1000"/></transform>
<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape></scene>' >sky.xml
printf 'x,y,z,nx,ny,nz\n0,0,.01,0,0,1\n' >up.csv
printf '0 0 0 5 0 0\n' >aside.pts
"$aureole" irradiance -q sky.xml -n 1024 --sensors up.csv -o up_out.csv || fail "sky"
near 4 6.283185307 up_out.csv
"$aureole" irradiance -q sky.xml -n 1024 --sensors - <aside.pts >aside.csv || fail "half of the sky"
near 4 3.141592654 aside.csv

# A rectangle of radiance 1 in a plane 2 above, of 2 by 2, seen wholly: a closed form (Lambert 1760),
# exactly; and by half behind a black screen, within its errors.
lamp='<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="2"/></transform>
<emitter type="area"/></shape>'
printf '<scene version="3.0.0">%s</scene>' "$lamp" >lamp.xml
printf '<scene version="3.0.0">%s<shape type="rectangle"><transform name="to_world"><translate x="-1"/><scale x="9" y="9"/>
<translate z="1"/></transform><bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf></shape>
</scene>' "$lamp" >screen.xml
printf '0 0 0 0 0 1\n0 0 0 .3 .4 0\n' >below.pts
"$aureole" irradiance lamp.xml -n 1024 --sensors below.pts -o lamp.csv || fail "a lamp"
awk -F, 'NR == 2 { a = 1 / sqrt(5); e = 4 * a * atan2(a, 1); d = $4 - e; exit !(d < 1e-7 && d > -1e-7 && $7 < 1e-12) }' lamp.csv ||
  fail "a lamp seen wholly: $(cat lamp.csv)"
"$aureole" irradiance screen.xml -n 1024 --sensors below.pts -o screen.csv || fail "a screen"
head -2 screen.csv >screen_up.csv
near 4 0.376137 screen_up.csv
awk -F, 'NR == 2 { exit !($7 > 0 && $7 < .01) }' screen.csv || fail "half of a lamp: $(cat screen.csv)"

# Beside a wall the lamp's light is as exact, and what the wall reflects errs: so does the whole, by as much.
sed 's|</scene>|<shape type="rectangle"><transform name="to_world"><scale value="3"/><rotate y="1" angle="90"/><translate x="-2"/></transform></shape></scene>|' lamp.xml >wall.xml
"$aureole" irradiance wall.xml -n 1024 --sensors below.pts --parts -o wall.csv || fail "a wall"
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
  NR == 2 { direct = $column["direct_r_error"]; whole = $column["r_error"]; reflected = $column["reflected_r_error"]
    exit !(direct < 1e-9 && reflected > 1e-6 && (whole / reflected - 1) ^ 2 < 1e-8) }' wall.csv || fail "errors of parts: $(cat wall.csv)"

# A point light: intensity / distance^2, to the rounding of floats, and in lux.
printf '<scene version="3.0.0"><emitter type="point"><point name="position" x="0" y="0" z="2"/>
<rgb name="intensity" value="8"/></emitter></scene>' >point.xml
"$aureole" irradiance -q point.xml -n 1024 --sensors room.pts -o point.csv || fail "point light"
awk -F, 'NR == 2 { exit !($4 > 1.99999 && $4 < 2.00001 && $7 < 1e-6) }' point.csv || fail "point light: $(cat point.csv)"
"$aureole" irradiance -q point.xml -n 1024 --sensors room.pts --illuminance radiance -o lux.csv || fail "lux"
awk -F, 'NR == 1 { bad = $4 != "lux" } NR == 2 { bad = bad || !($4 > 357.99 && $4 < 358.01) } END { exit bad }' lux.csv ||
  fail "lux: $(cat lux.csv)"

# Threads, and other sensors in the file.
"$aureole" irradiance -q room.xml -n 1024 --sensors room.pts --parts --threads 3 | cmp -s - room.csv || fail "three threads"
"$aureole" irradiance -q room.xml -n 1024 --sensors room.pts --parts --threads 1 | cmp -s - room.csv || fail "one thread"
sed -n 2p room.pts >second.pts
"$aureole" irradiance -q room.xml -n 1024 --sensors second.pts --parts | sed -n 2p | cmp -s - <(sed -n 3p room.csv) ||
  fail "a sensor alone differs from the same one among others"
"$aureole" irradiance -q room.xml -n 1024 --sensors room.pts --parts --seed 1 | cmp -s - room.csv && fail "another seed"

# To an error.
"$aureole" irradiance -q room.xml --sensors room.pts --error 0.5% --counts --intervals -o error.csv || fail "to an error"
awk -F, 'NR > 1 && !($10 <= .005 * $4 * 1.001 && $13 > 256) { exit 1 }' error.csv || fail "to an error: $(cat error.csv)"
near 4 6.283185307 error.csv
warned "did not reach the error with 256 directions" room.xml --sensors room.pts --error 0.01% -n 256
# Which sensors those are, and the worst of them, stands in the table.
printf '3 0 0 0 0 1\n0 0 0 0 0 1\n.5 0 0 1 1 0\n.4 0 0 0 -.3 1\n.2 0 0 0 0 1\n' >near.pts
"$aureole" irradiance screen.xml --sensors near.pts --error 1% -n 512 --illuminance rec709 --intervals -o unreached.csv 2>said || fail "unreached"
awk -F, 'NR > 1 { ratio = $6 / $4; if (ratio > .01) { if (n++ == 0) first = NR - 2; if (ratio > worst) worst = ratio } ; if (least == 0 || ratio < least) least = ratio }
  END { printf "near.pts:%d: %d of 5 sensors did not reach the error with 512 directions (the first is sensor %d); the worst reached %.3g\n",
          first + 1, n, first, worst; exit !(n > 1 && n < 5 && first > 0) }' unreached.csv >expected || fail "unreached: $(cat expected unreached.csv)"
grep -qFf expected said || fail "unreached: $(cat said), not $(cat expected)"

# Formats: the same numbers in all of them.
for format in json npy ply; do
  "$aureole" irradiance -q room.xml -n 1024 --sensors room.pts -o "room.$format" || fail "$format"
done
"$aureole" irradiance -q room.xml -n 1024 --sensors room.pts --to json | cmp -s - room.json || fail "--to json"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 9\nv 1 1 0\nf 1 2 3\nf 2 5 3\n' >desk.obj
"$aureole" irradiance -q lamp.xml -n 1024 --sensors desk.obj -o desk.csv || fail "faces"
"$aureole" irradiance -q lamp.xml -n 1024 --sensors desk.obj --at vertices --lift 0.5 -o vertices.csv || fail "vertices"
"$aureole" irradiance -q lamp.xml -n 1024 --sensors desk.obj --at vertices -o vertices.ply || fail "vertices"
"$aureole" irradiance -q lamp.xml -n 1024 --sensors desk.obj -o faces.ply || fail "faces"
[ "$(wc -l <desk.csv)" = 3 ] || fail "a sensor a face: $(cat desk.csv)"
[ "$(wc -l <vertices.csv)" = 5 ] || fail "a sensor a vertex that is used: $(cat vertices.csv)"
sed -n 2p vertices.csv | grep -q '^0,0,.5,\|^0,0,0.5,' || fail "lifted sensors: $(cat vertices.csv)"
if command -v python3 >/dev/null; then
  python3 - <<'PYTHON' || fail "formats differ"
import csv, json, struct
rows = [[float(x) for x in row] for row in list(csv.reader(open("room.csv")))[1:]]
same = [row[:9] for row in rows]
objects = json.load(open("room.json"))
assert list(objects[0]) == ["x", "y", "z", "r", "g", "b", "r_error", "g_error", "b_error"]
for row, item in zip(same, objects):
    assert row[:6] == list(item.values())[:6], (row, item)
raw = open("room.npy", "rb").read()
assert b"(3, 9)" in raw[:128]
for i, row in enumerate(same):
    assert list(struct.unpack_from("<6d", raw, 128 + 72 * i)) == row[:6]
def ply(name, vertices, faces):
    raw = open(name, "rb").read()
    head, body = raw.split(b"end_header\n", 1)
    assert b"element vertex %d\n" % vertices in head and (b"element face %d\n" % faces in head or faces == 0), head
    assert len(body) == vertices * (9 * 8 + 3) + faces * 13, len(body)
    return body
ply("room.ply", 3, 0)
ply("vertices.ply", 4, 2)
assert struct.unpack_from("<3d", ply("faces.ply", 6, 2), 75) == (1, 0, 0)
PYTHON
fi

# Bad input.
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >thin.obj
refused "thin.obj: no facet has an area" lamp.xml --sensors thin.obj
printf '0 0 0 0 0 1\n1 2 3 0 0 0\n' >zero.pts
printf '0 0 0 0 0 1\n1 nan 3 0 0 1\n' >nan.pts
printf '0 0 0 0 0 1\n0 -1e19 0 0 0 1\n' >far.pts
printf '0 0 0 0 1\n' >five.pts
printf '# nothing\n' >empty.pts
printf 'x,y,z,u,v,w\n0,0,0,0,0,1\n' >header.csv
refused "zero.pts:2: the normal of sensor 1 has length 0" room.xml --sensors zero.pts
refused "nan.pts:2: column 2: 'nan' is not a finite number" room.xml --sensors nan.pts
refused "far.pts:2: sensor 1 is too far away: a coordinate is beyond 1e+18" room.xml --sensors far.pts
refused "five.pts:1: a sensor is six numbers, x y z nx ny nz, not 5" room.xml --sensors five.pts
refused "empty.pts: there are no sensors in it" room.xml --sensors empty.pts
for empty in csv npy; do
  : >"empty.$empty"
  refused "empty.$empty: there are no sensors in it" room.xml --sensors "empty.$empty"
done
: >empty.obj
refused "empty.obj: no face" room.xml --sensors empty.obj
printf 'x,y,z,nx,ny,nz\n0,0,0,0,0,1\n0,0,0,,0,1\n' >gap.csv
refused "gap.csv:3: column 4: '' is not a finite number" room.xml --sensors gap.csv
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n' >sheet.obj
warned "sheet.obj:5: 1 facets lie back to back with others" room.xml --sensors sheet.obj
refused "the columns of sensors are x,y,z,nx,ny,nz" room.xml --sensors header.csv
refused "no sensors given: expected --sensors POINTS" room.xml
refused "must be an error like 1% or 0.01" room.xml --sensors room.pts --error 100%
refused "unknown set 'spiral'" room.xml --sensors room.pts --set spiral
printf '<scene version="3.0.0"><shape type="cube"/></scene>' >unlit.xml
refused "the scene has no light" unlit.xml --sensors room.pts
# A solid cube in the light of a sky: its inside sees black backs.
printf '<scene version="3.0.0"><emitter type="constant"/><shape type="cube"/></scene>' >solid.xml
warned "3 of 3 sensors see mostly the black backs of surfaces" solid.xml --sensors room.pts
printf '0 0 3 0 0 1\n0 3 0 0 1 0\n' | cat - room.pts >mixed.pts
warned "mixed.pts:3: 3 of 5 sensors see mostly the black backs of surfaces (the first is sensor 2)" solid.xml --sensors mixed.pts
warned "room.pts:4: 1 of 3 sensors lie on surfaces (the first is sensor 2)" room.xml --sensors room.pts
# A sensor sealed in a box that is grey on both sides of its walls, and one that stands on it.
printf 'void plastic grey 0 0 5 .5 .5 .5 0 0\nvoid light lamp 0 0 3 1 1 1\nlamp source sky 0 0 4 0 0 1 180\n' >box.rad
printf 'grey polygon %s 0 0 12 %s\n' a '0 0 0 1 0 0 1 1 0 0 1 0' b '0 0 1 1 0 1 1 1 1 0 1 1' c '0 0 0 1 0 0 1 0 1 0 0 1' \
  d '0 1 0 1 1 0 1 1 1 0 1 1' e '0 0 0 0 1 0 0 1 1 0 0 1' f '1 0 0 1 1 0 1 1 1 1 0 1' >>box.rad
printf '.5 .5 1 0 0 1\n.5 .5 .5 0 0 1\n' >sealed.pts
warned "sealed.pts:2: 1 of 2 sensors see no light at all (the first is sensor 1)" box.rad --sensors sealed.pts
# In the corner of three walls, looking along one of them.
printf '%s\n' '-1 -1 -1 1 0 0' '-1 -1 -1 1 1 1' '-1 -1 0 0 1 0' >corner.pts
"$aureole" irradiance -q room.xml --sensors corner.pts -q -o corner.csv || fail "corners"
near 4 6.283185307 corner.csv
# A lamp that looks the other way.
printf '<scene version="3.0.0"><shape type="rectangle"><transform name="to_world"><translate z="1"/></transform>
<emitter type="area"/></shape></scene>' >away.xml
printf '0 0 2 0 0 1\n0 0 0 0 0 -1\n' >behind.pts
warned "2 of 2 sensors see no light at all" away.xml --sensors behind.pts

# Panes. A sun through one of Radiance's glass, two bounces of each polarisation, at 30 degrees: 1e5 * solid angle * cosine *
# what the pane lets through, which awk computes; nothing of it is left to chance. The same beyond two panes, and of half a
# million directions of a uniform sky through a pane that covers all of it, by quadrature over the cosine.
passed='function passed(c, t,   i, a, b, d) { i = sqrt(1 - (1 - c * c) / (1.52 * 1.52)); d = t ^ (1 / i)
  a = ((c - 1.52 * i) / (c + 1.52 * i)) ^ 2; b = ((1.52 * c - i) / (1.52 * c + i)) ^ 2
  return ((1 - a) ^ 2 / (1 - (a * d) ^ 2) + (1 - b) ^ 2 / (1 - (b * d) ^ 2)) * d / 2 }'
printf '0 0 0 0 0 1\n' >below.pts
printf 'void glass g 0 0 3 .9 .8 .7\ng polygon p 0 0 12 -9e4 -9e4 1 9e4 -9e4 1 9e4 9e4 1 -9e4 9e4 1\n' >pane.rad
printf 'void light s 0 0 3 1e5 1e5 1e5\ns source sun 0 0 4 0 .5 .866025403784 .533\n' | cat pane.rad - >sun.rad
"$aureole" irradiance -q sun.rad --sensors below.pts -n 1024 --parts -o sun.csv || fail "a sun behind a pane"
near 4 "$(awk "$passed BEGIN { a = .2665 * atan2(0, -1) / 180; c = .866025403784; print 1e5 * atan2(0, -1) * sin(a) ^ 2 * c * passed(c, .9) }")" sun.csv
near 22 0 sun.csv
near 28 "$(tail -1 sun.csv | cut -d, -f4)" sun.csv
near 16 0 sun.csv
head -1 sun.csv | grep -q ',sun_r,sun_g,sun_b,sun_r_error,' || fail "columns: $(head -1 sun.csv)"
printf 'g polygon q 0 0 12 -9e4 -9e4 2 9e4 -9e4 2 9e4 9e4 2 -9e4 9e4 2\n' | cat sun.rad - >two.rad
"$aureole" irradiance -q two.rad --sensors below.pts -n 1024 --max-depth 3 -o two.csv || fail "a sun behind two panes"
near 4 "$(awk "$passed BEGIN { a = .2665 * atan2(0, -1) / 180; c = .866025403784; print 1e5 * atan2(0, -1) * sin(a) ^ 2 * c * passed(c, .9) ^ 2 }")" two.csv
# Two edges are too few for two panes.
"$aureole" irradiance -q two.rad --sensors below.pts -n 1024 --max-depth 2 -o two.csv || fail "an edge too few"
near 4 0 two.csv
printf 'void glow k 0 0 4 1 1 1 0\nk source sky 0 0 4 0 0 1 180\n' | cat pane.rad - >glazed.rad
for depth in 2 9; do
  "$aureole" irradiance -q glazed.rad --sensors below.pts -n 524288 --max-depth $depth -o glazed.csv || fail "a sky behind a pane"
  near 4 "$(awk "$passed BEGIN { for (i = 0; i < 20000; ++i) { c = (i + .5) / 20000; sum += c * passed(c, .9) / 20000 }
    print 2 * atan2(0, -1) * sum }")" glazed.csv
done
# A lamp whose light has a closed form, half of it behind a pane: what is seen straight is half of it, and the other half
# 81 % of it, because this pane lets pass what it does at any angle.
printf '<scene version="3.0.0"><shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="2"/>
</transform><emitter type="area"/></shape>%s</scene>' '<shape type="rectangle"><transform name="to_world"><translate x="1" z="1"/>
</transform><bsdf type="mask"><float name="opacity" value=".19"/><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
</bsdf></shape>' >lamp.xml
sed 's/value=".19"/value="0"/' lamp.xml >bare.xml
"$aureole" irradiance -q lamp.xml --sensors below.pts -n 65536 -o lamp.csv || fail "a lamp behind a mask"
"$aureole" irradiance -q bare.xml --sensors below.pts -n 65536 -o bare.csv || fail "a lamp"
near 4 "$(awk -F, 'NR == 2 { print .905 * $4 }' bare.csv)" lamp.csv
# Sunlight from a floor below a pane without surfaces: the floor sends back half of what reaches it.
printf '<scene version="3.0.0"><emitter type="sun"><rgb name="irradiance" value="100"/><vector name="sun_direction" value="0 .6 .8"/>
</emitter><shape type="rectangle"><transform name="to_world"><scale value="900"/></transform></shape>
<shape type="rectangle"><transform name="to_world"><scale value="9000"/><translate z="2"/></transform>
<bsdf type="glass"><float name="int_ior" value="1.0000001"/><rgb name="transmissivity" value=".5"/></bsdf></shape></scene>' >floor.xml
printf '0 0 1 0 0 -1\n' >down.pts
"$aureole" irradiance -q floor.xml --sensors down.pts -n 16384 -o floor.csv || fail "a floor below a pane"
near 4 "$(awk 'BEGIN { print .5 * 100 * .8 * .5 ^ (1 / .8) }')" floor.csv

# A scene without a camera is no image.
"$aureole" render room.xml -o room.exr 2>&1 | grep -q 'room.xml:1:.*the scene has no <sensor>' || fail "rendered without a camera"

finish

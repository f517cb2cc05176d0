#!/usr/bin/env bash
# What options set around a scene: cameras that show all of it, environments, ground, background, models side by side.
set -u
aureole=$1
fail() { echo "$1"; exit 1; }
/usr/bin/python3 -c '' 2>/dev/null || { echo "skipped: there is no Python to look at images with"; exit 77; }

cat >look.py <<'PYTHON'
import struct, sys
def read(path):
    with open(path, "rb") as file:
        kind, size, scale = file.readline().strip(), file.readline().split(), float(file.readline())
        width, height, channels = int(size[0]), int(size[1]), 3 if kind == b"PF" else 1
        values = struct.unpack("<" if scale < 0 else ">", b"") or struct.unpack(
            f"{'<' if scale < 0 else '>'}{width * height * channels}f", file.read())
    return width, height, channels, values
def part(path):
    """How much of the width and height is filled, and by how much it is off the middle, in pixels."""
    width, height, channels, values = read(path)
    there = [i for i in range(width * height) if values[i * channels] > 0]
    x, y = [i % width for i in there], [i // width for i in there]
    return ((max(x) - min(x) + 1) / width, (max(y) - min(y) + 1) / height, abs(max(x) + min(x) + 1 - width) / 2,
            abs(max(y) + min(y) + 1 - height) / 2)
command = sys.argv[1]
if command == "filled":  # the model fills .9 of one side of the image, no more of the other, and lies in the middle
    width, height = read(sys.argv[2])[:2]
    x, y, off_x, off_y = part(sys.argv[2])
    sys.exit(abs(max(x, y) - .9) > 2 / min(width, height) or off_x > 1.5 or off_y > 1.5)
if command == "near":  # all pixels of two images are equal within a share of the larger one
    a, b, most = read(sys.argv[2])[3], read(sys.argv[3])[3], float(sys.argv[4])
    sys.exit(len(a) != len(b) or any(abs(p - q) > most * max(abs(p), abs(q)) for p, q in zip(a, b)))
if command == "corner":  # the mean of the corner of 4 x 4 pixels, each channel
    width, height, channels, values = read(sys.argv[2])
    for c in range(3):
        print("%.4g" % (sum(values[((y * width) + x) * channels + c] for y in range(4) for x in range(4)) / 16))
PYTHON

# wedge NAME SCALE X Y Z: a body without symmetry
wedge() {
  awk -v s="$2" -v x="$3" -v y="$4" -v z="$5" 'BEGIN {
    split("0 0 0 3 0 0 3 0 1 0 0 1 0 2 0 0 1.5 1", p, " ")
    for (i = 0; i < 6; ++i) printf "v %.17g %.17g %.17g\n", p[3 * i + 1] * s + x, p[3 * i + 2] * s + y, p[3 * i + 3] * s + z
    print "f 1 2 3 4\nf 1 5 2\nf 4 3 6\nf 2 5 6 3\nf 1 4 6 5" }' >"$1.obj"
}
wedge one 1 0 0 0
wedge small 0.0009765625 0 0 0
wedge large 1048576 0 0 0
wedge away 1 4194304 -2097152 1048576
depth="-q --integrator depth --spp 1 --filter box --ground none"

# --- views that show all of the scene: by any unit, wherever it is
for view in front back left right top bottom corner iso 200,-35; do
  "$aureole" render one.obj $depth --width 96 --height 64 --camera $view -o $view.pfm || fail "no view $view"
  /usr/bin/python3 look.py filled $view.pfm || fail "the view $view does not fill the image"
done
printf '<scene version="3.0.0"><include filename="one.obj"/></scene>' >bare.xml
"$aureole" render bare.xml $depth --width 96 --height 64 --camera iso -o bare.pfm && /usr/bin/python3 look.py filled bare.pfm || fail "a scene without a sensor has no view by --camera"
"$aureole" render bare.xml $depth -o bare.pfm 2>said && fail "a scene without a sensor is rendered"
grep -q 'bare.xml:1:.*the scene has no <sensor>: add one, or choose a view (--camera)' said || fail "no sensor: $(cat said)"
"$aureole" render one.obj $depth --width 96 --height 64 -o default.pfm && cmp default.pfm corner.pfm || fail "a model is not seen from the corner"
"$aureole" render one.obj $depth --width 40 --height 96 --camera iso -o high.pfm && /usr/bin/python3 look.py filled high.pfm || fail "a narrow image is not filled"
for model in small large away; do
  "$aureole" render $model.obj $depth --width 96 --height 64 --camera iso -o $model.pfm || fail "$model.obj is not rendered"
  /usr/bin/python3 look.py filled $model.pfm || fail "$model.obj does not fill the image"
done
"$aureole" render away.obj -q --spp 64 --width 24 --height 16 -o away.pfm && "$aureole" render one.obj -q --spp 64 --width 24 --height 16 -o near.pfm &&
  /usr/bin/python3 look.py near away.pfm near.pfm 0.05 || fail "a model far from the origin looks different"

# --- an .stl has z upwards, others by --up: the same corners are seen alike
awk '/^v/ { v[++n] = $2 " " $3 " " $4 } /^f/ { for (i = 4; i <= NF; ++i) {
  print "facet normal 0 0 0\nouter loop\nvertex " v[$2] "\nvertex " v[$(i - 1)] "\nvertex " v[$i] "\nendloop\nendfacet" } }' one.obj >facets
{ echo "solid wedge"; cat facets; echo "endsolid wedge"; } >one.stl
for view in front iso; do
  "$aureole" render one.stl $depth --width 48 --height 32 --camera $view -o stl.pfm && "$aureole" render one.obj $depth --up z --width 48 --height 32 --camera $view -o up.pfm &&
    /usr/bin/python3 look.py near stl.pfm up.pfm 1e-5 || fail "--up z is not the .stl seen from $view"
  "$aureole" render one.stl $depth --up y --width 48 --height 32 --camera $view -o stl.pfm && "$aureole" render one.obj $depth --width 48 --height 32 --camera $view -o up.pfm &&
    /usr/bin/python3 look.py near stl.pfm up.pfm 1e-5 || fail "--up y is not the .obj seen from $view"
done

# --- a place and a target are a <lookat>
scene() { # NAME [ELEMENT...]
  echo '<scene version="3.0.0"><integrator type="path"/><shape type="obj"><string name="filename" value="one.obj"/></shape>' >"$1.xml"
  echo "${@:2}</scene>" >>"$1.xml"
}
film='<film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/></film><sampler type="multijitter"/>'
light='<emitter type="constant"/>'
scene by-element "$light<sensor type=\"perspective\"><string name=\"fov_axis\" value=\"y\"/><float name=\"fov\" value=\"40\"/><float name=\"near_clip\" value=\"0\"/>
<float name=\"far_clip\" value=\"1e30\"/><transform name=\"to_world\"><lookat origin=\"5, 4, 7\" target=\"1, .5, .5\" up=\"0, 1, 0\"/></transform>$film</sensor>"
scene by-option "$light<sensor type=\"perspective\">$film</sensor>"
"$aureole" render by-element.xml -q -o element.pfm && "$aureole" render by-option.xml --camera 5,4,7,1,.5,.5,40 -q -o option.pfm &&
  cmp element.pfm option.pfm || fail "--camera X,Y,Z,X,Y,Z,FOV is not the <lookat>"

# --- a background is seen by the camera alone, also through holes, and by every estimator that has one
printf 'Pf\n2 2\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0' >hole.pfm
hole='<shape type="rectangle"><transform name="to_world"><scale value="100"/><translate z="-5"/></transform><bsdf type="mask">
<texture type="bitmap" name="opacity"><string name="filename" value="hole.pfm"/></texture><bsdf type="diffuse"/></bsdf></shape>'
scene holes "$light$hole<sensor type=\"perspective\">$film</sensor>"
for integrator in path path:packets=false volpath; do
  "$aureole" render holes.xml --camera 20,20 --integrator $integrator --background 0.25,0.5,2 -q --spp 16 -o hole-seen.pfm || fail "no background by $integrator"
  [ "$(/usr/bin/python3 look.py corner hole-seen.pfm | xargs)" = "0.25 0.5 2" ] || fail "$integrator: the background is $(/usr/bin/python3 look.py corner hole-seen.pfm | xargs)"
done
"$aureole" render by-option.xml --camera corner --background '#ff8000' -q --spp 16 --filter box --integrator direct -o color.pfm
[ "$(/usr/bin/python3 look.py corner color.pfm | xargs)" = "1 0.2159 0" ] || fail "#ff8000 is $(/usr/bin/python3 look.py corner color.pfm | xargs)"
for color in 0,0,0 1,1,1; do
  "$aureole" render by-option.xml --camera top --background $color -q --spp 16 --filter box --crop 10,14,6,10 -o back-$color.pfm
done
cmp back-0,0,0.pfm back-1,1,1.pfm || fail "a background lights the scene"

# --- the floor of the studio has the colour of its background; what stands on it darkens it
"$aureole" render one.obj -q --camera 1,30,1,1,0,1,20 --width 32 --height 24 --spp 1024 -o floor.pfm || fail "no studio"
/usr/bin/python3 look.py corner floor.pfm | awk '!($1 > .615 && $1 < .625) { bad = 1 } END { exit bad }' || fail "the floor is no background: $(/usr/bin/python3 look.py corner floor.pfm | xargs)"
# The ground takes no samples from lamps of a model: in a box with a lamp one finds the same error with it and without it.
printf 'newmtl wall\nKd .5 .5 .5\nnewmtl lamp\nKe 100 100 100\n' >box.mtl
{ echo 'mtllib box.mtl'
  printf 'v %s\n' '0 0 0' '1 0 0' '1 1 0' '0 1 0' '0 0 1' '1 0 1' '1 1 1' '0 1 1' '.4 .95 .4' '.6 .95 .4' '.6 .95 .6' '.4 .95 .6'
  printf 'usemtl wall\nf 1 2 3 4\nf 1 2 6 5\nf 1 4 8 5\nf 2 3 7 6\nf 3 4 8 7\nusemtl lamp\nf 9 10 11 12\n'; } >box.obj
for ground in none shadow; do
  for samples in 16 1024; do
    "$aureole" render box.obj -q --environment studio --ground $ground --camera .5,.4,.9,.5,.3,0,60 --width 16 --height 12 --filter box --samples $samples -o box-$samples.pfm || fail "no box"
  done
  "$aureole" compare box-1024.pfm box-16.pfm --metric relative-rmse --format csv >error-$ground
done
paste -d, <(sed -n 2p error-none) <(sed -n 2p error-shadow) | awk -F, '!($(NF / 2 + 2) < 1.5 * $2) { bad = 1 } END { exit bad || NR != 1 }' ||
  fail "the ground makes a lamp noisy: $(cat error-none error-shadow)"
for pair in "studio auto" "studio none" "sky auto" "sky:6 none" "none auto"; do
  read -r environment ground <<<"$pair"
  "$aureole" render one.obj -q --environment $environment --ground $ground --width 48 --height 16 --spp 4 --camera 0,50 --integrator depth -o ground.pfm || fail "no $pair"
  read -r corner _ <<<"$(/usr/bin/python3 look.py corner ground.pfm | xargs)"
  case $pair in
    "sky auto") [ "$corner" != 0 ] || fail "there is no ground below the sky" ;;
    *none*) [ "$corner" = 0 ] || fail "there is a ground for $pair" ;;
  esac
done

# --- an image of radiance is the emitter `envmap`
printf 'PF\n2 2\n-1.0\n' >sky.pfm
/usr/bin/python3 -c 'import struct, sys; sys.stdout.buffer.write(struct.pack("<12f", *range(1, 13)))' >>sky.pfm
scene mapped "<emitter type=\"envmap\"><string name=\"filename\" value=\"sky.pfm\"/></emitter><sensor type=\"perspective\">$film</sensor>"
"$aureole" render mapped.xml --camera iso -q -o mapped.pfm && "$aureole" render by-option.xml --camera iso --environment sky.pfm -q -o given.pfm &&
  cmp mapped.pfm given.pfm || fail "--environment FILE is not the emitter envmap, or the scene's own stays"

# --- models side by side: the order does not matter, a place is a transform
wedge two 1 7 0 2
"$aureole" render one.obj two.obj $depth --width 48 --height 32 -o ab.pfm && "$aureole" render two.obj one.obj $depth --width 48 --height 32 -o ba.pfm &&
  cmp ab.pfm ba.pfm || fail "the order of models matters"
"$aureole" render one.obj one.obj@7,0,2 $depth --width 48 --height 32 -o placed.pfm && cmp ab.pfm placed.pfm || fail "a shift is no other place"
scene turned '<shape type="obj"><string name="filename" value="one.obj"/><transform name="to_world"><scale value="0.5"/><rotate y="1" angle="30"/>
<translate x="1" y="2" z="3"/></transform></shape>' "$light<sensor type=\"perspective\">$film</sensor>"
"$aureole" render turned.xml --camera iso -q --integrator depth -o turned.pfm &&
  "$aureole" render by-option.xml one.obj@1,2,3,30,0.5 --camera iso -q --integrator depth -o at.pfm &&
  /usr/bin/python3 look.py near turned.pfm at.pfm 1e-5 || fail "FILE@X,Y,Z,TURN,SCALE is no transform"

# --- the image as displayed
"$aureole" render by-option.xml --camera iso --background 0.72,0.72,0.72 --environment none -q --filter box --spp 1 --exposure auto -o auto.png || fail "no automatic exposure"
"$aureole" render by-option.xml --camera iso --background 0.72,0.72,0.72 --environment none -q --filter box --spp 1 --exposure -2 -o dark.png && cmp auto.png dark.png ||
  fail "an image of .72 is not exposed by -2 stops"
"$aureole" render by-option.xml --camera iso -q --samples 4 -o four.pfm && "$aureole" render by-option.xml --camera iso -q --spp 4 -o spp.pfm && cmp four.pfm spp.pfm ||
  fail "--samples is not --spp"

# refused WORDS OPTION...
refused() {
  "$aureole" render by-option.xml -q --spp 1 -o no.pfm "${@:2}" >said 2>&1
  [ $? = 2 ] && grep -q -e "$1" said || fail "not refused with '$1': $(cat said)"
}
refused "unknown camera 'fornt'" --camera fornt
refused "unknown camera '1,2,3'" --camera 1,2,3
refused 'a point other than its position' --camera 1,2,3,1,2,3
refused 'sky:TURBIDITY' --environment sky:20
refused "unknown environment 'skyy'; did you mean 'sky'" --environment skyy
refused "there are: studio, sky, sky:TURBIDITY, none" --environment park
refused "cannot find 'nothing.exr'" --environment nothing.exr
refused 'R,G,B' --background 1,2
refused 'FILE@X,Y,Z' one.obj@1,2
refused "need a .png or .jpg output" --exposure 1
# Triangles of a model in one plane have no line to name.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\nf 1 4 5\n' >overlap.obj
"$aureole" render overlap.obj --integrator depth --spp 1 --width 8 -o overlap.pfm 2>said
grep -q 'overlap.obj: 1 triangles lie in the plane of others .* and are cut where those cover them$' said || fail "overlaps of a model: $(cat said)"
exit 0

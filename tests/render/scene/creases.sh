#!/usr/bin/env bash
# Files without normals: with a crease angle sharp edges stay sharp, smooth surfaces smooth, and models have one.
# usage: creases.sh PROGRAM SOURCE_TREE
set -u
aureole=$1
status=0
fail() { echo "FAILED: $*"; status=1; }
python3 - <<'PY'
import math
def write(name, points, faces):
    with open(name, "w") as f:
        f.writelines("v %.17g %.17g %.17g\n" % p for p in points)
        f.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)
corner = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
write("cube.obj", corner, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
n, m = 48, 24 # a sphere, whose triangles meet at 8 degrees
points = [(0, 1, 0), (0, -1, 0)] + [(math.sin(math.pi * i / m) * math.cos(2 * math.pi * j / n), math.cos(math.pi * i / m),
          math.sin(math.pi * i / m) * math.sin(2 * math.pi * j / n)) for i in range(1, m) for j in range(n)]
at = lambda i, j: 0 if i == 0 else 1 if i == m else 2 + (i - 1) * n + j % n
faces = [face for i in range(m) for j in range(n) for face in [tuple(dict.fromkeys((at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j))))]]
write("ball.obj", points, faces)
k = 64 # a cylinder: round about, with flat ends
rim = [(math.cos(2 * math.pi * j / k), y, math.sin(2 * math.pi * j / k)) for y in (-1, 1) for j in range(k)]
write("drum.obj", rim, [tuple(range(k)), tuple(range(2 * k - 1, k - 1, -1))] + [(j, k + j, k + (j + 1) % k, (j + 1) % k) for j in range(k)])
PY
image() { # image NAME FILE KEYS: shading normals
  echo "<scene version='3.0.0'><integrator type='aov'><string name='aovs' value='n:sh_normal'/></integrator>
<sensor type='perspective'><transform name='to_world'><lookat origin='3,4,5' target='0,0,0' up='0,1,0'/></transform>
<film type='hdrfilm'><integer name='width' value='64'/><integer name='height' value='64'/><rfilter type='box'/></film></sensor>
<shape type='obj'><string name='filename' value='$2'/>$3</shape></scene>" >"$1.xml"
  "$aureole" render "$1.xml" -q --spp 1 -o "$1.exr" || fail "$1"
}
crease="<float name='crease_angle' value='30'/>"
image sharp cube.obj "$crease"
image flat cube.obj "<boolean name='face_normals' value='true'/>"
cmp sharp.exr flat.exr || fail "a cube with creases is not flat"
image soft ball.obj "$crease"
image round ball.obj ""
cmp soft.exr round.exr || fail "creases change a smooth sphere"
image drum drum.obj "$crease"
image none drum.obj ""
cmp -s drum.exr none.exr && fail "a crease angle has no effect on a drum"
"$aureole" convert drum.exr drum.pfm --channels n.X,n.Y,n.Z || fail "no normals"
python3 - <<'PY' || status=1
import struct
data = open("drum.pfm", "rb").read().split(b"\n", 3)[3]
values = struct.unpack("<%df" % (len(data) // 4), data)
normals = [values[i:i + 3] for i in range(0, len(values), 3) if any(values[i:i + 3])]
lids = [n for n in normals if n[1] > .5]
sides = {n for n in normals if n[1] <= .5}
assert lids and all(n == (0, 1, 0) for n in lids), "the lid is not flat"
assert len(sides) > 100 and all(abs(n[1]) < 1e-6 for n in sides), "the side is not round"
PY
# Models without normals have an angle by default.
"$aureole" render cube.obj -q --spp 1 --width 32 --camera iso --filter box --integrator aov:aovs=n:sh_normal -o cube.exr || fail "a model's normals"
"$aureole" convert cube.exr cube.pfm --channels n.X,n.Y,n.Z || fail "no normals of a model"
python3 - <<'PY' || { echo "FAILED: a cube as a model is not flat"; status=1; }
import struct
data = open("cube.pfm", "rb").read().split(b"\n", 3)[3]
values = struct.unpack("<%df" % (len(data) // 4), data)
assert all(sorted(map(abs, values[i:i + 3]))[:2] == [0, 0] or not any(values[i:i + 3]) for i in range(0, len(values), 3))
PY
exit $status

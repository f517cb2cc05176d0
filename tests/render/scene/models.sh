#!/usr/bin/env bash
# Models that are no XML: a glTF with images, lights, a camera, instances, a mask and a light of its own is the same image,
# bit by bit, as the same scene written as XML; as .gltf with a file of numbers beside it and as .glb; OBJ; what a model lacks
# is added and said; broken ones are refused with words.
set -u
aureole=$1
fail() { echo "$1"; exit 1; }
/usr/bin/python3 -c '' 2>/dev/null || { echo "skipped: there is no Python to write models with"; exit 77; }
[ -e "$(dirname "$aureole")/aureole-import" ] || {
  : >none.fbx
  "$aureole" info none.fbx >said 2>&1
  [ $? = 2 ] && grep -q 'libassimp-dev' said || fail "without assimp a model is not refused with words: $(cat said)"
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >none.obj
  "$aureole" info none.obj >said 2>&1 || fail "an OBJ is not read without assimp: $(cat said)"
  echo "skipped: this build has no assimp"
  exit 77
}

/usr/bin/python3 - <<'PYTHON' || fail "the models cannot be written"
import base64, json, struct, zlib

def png(width, height, texels):
    """texels: rows of (r, g, b, a) bytes"""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(v for texel in texels[y * width:(y + 1) * width] for v in texel) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))

color = png(4, 4, [(40 + 50 * (i % 4), 250 - 60 * (i // 4), 90, 255 if (i + i // 4) % 2 else 30) for i in range(16)])
rough = png(2, 2, [(0, 80, 0, 255), (0, 160, 255, 255), (0, 220, 128, 255), (0, 120, 0, 255)])
normal = png(2, 1, [(160, 128, 220, 255), (96, 140, 230, 255)])
for name, data in (("color", color), ("rough", rough), ("normal", normal)):
    open(name + ".png", "wb").write(data)

# One quad with normals and texture coordinates, and a triangle without.
positions = [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]
normals = [0, 0, 1] * 4
uvs = [0, 1, 1, 1, 1, 0, 0, 0]  # v from above, as glTF has it
indices = [0, 1, 2, 0, 2, 3]
triangle = [0, 0, 0, 1, 0, 0.5, 0, 1, 0.25]
parts = [struct.pack("<12f", *positions), struct.pack("<12f", *normals), struct.pack("<8f", *uvs),
         struct.pack("<6I", *indices), struct.pack("<9f", *triangle), struct.pack("<3I", 0, 1, 2)]
buffer = b"".join(parts)
views, at = [], 0
for part in parts:
    views.append({"buffer": 0, "byteOffset": at, "byteLength": len(part)})
    at += len(part)
FLOAT, UINT = 5126, 5125
accessors = [
    {"bufferView": 0, "componentType": FLOAT, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": FLOAT, "count": 4, "type": "VEC3"},
    {"bufferView": 2, "componentType": FLOAT, "count": 4, "type": "VEC2"},
    {"bufferView": 3, "componentType": UINT, "count": 6, "type": "SCALAR"},
    {"bufferView": 4, "componentType": FLOAT, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0.5]},
    {"bufferView": 5, "componentType": UINT, "count": 3, "type": "SCALAR"}]
quad = {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}
turned = {"KHR_texture_transform": {"offset": [0.25, 0.125], "scale": [2, 0.5], "rotation": 0.5}}
gltf = {
    "asset": {"version": "2.0"}, "scene": 0,
    "extensionsUsed": ["KHR_lights_punctual", "KHR_texture_transform"],
    "buffers": [{"byteLength": len(buffer), "uri": "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()}],
    "bufferViews": views, "accessors": accessors,
    "images": [{"uri": "data:image/png;base64," + base64.b64encode(color).decode()}, {"uri": "rough.png"}, {"uri": "nor%6Dal.png"}],
    "samplers": [{"wrapS": 10497, "wrapT": 33648}, {"magFilter": 9728, "wrapS": 33071, "wrapT": 33071}],
    "textures": [{"source": 0, "sampler": 0}, {"source": 1, "sampler": 1}, {"source": 2}],
    "materials": [
        {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": turned}, "baseColorFactor": [0.8, 0.9, 1, 1],
                                  "metallicFactor": 0.25, "roughnessFactor": 0.5}, "normalTexture": {"index": 2, "scale": 0.5}},
        {"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 1}, "baseColorFactor": [0.9, 0.6, 0.3, 1],
                                  "metallicFactor": 0.75}},
        {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}, "alphaMode": "MASK", "alphaCutoff": 0.5},
        {"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0}, "emissiveFactor": [1, 0.5, 0.25]}],
    "meshes": [{"primitives": [dict(quad, material=0)]}, {"primitives": [dict(quad, material=1)]},
               {"primitives": [dict(quad, material=2)]}, {"primitives": [dict(quad, material=3)]},
               {"primitives": [{"attributes": {"POSITION": 4}, "indices": 5, "material": 1}]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 1.5, "znear": 0.1}}],
    "extensions": {"KHR_lights_punctual": {"lights": [
        {"type": "point", "color": [1, 0.8, 0.6], "intensity": 6},
        {"type": "spot", "intensity": 20, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.5}},
        {"type": "directional", "intensity": 1.5}]}},
    "nodes": [
        {"name": "floor", "mesh": 0, "scale": [3, 3, 3], "rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476],
         "translation": [0, -1, 0]},
        {"name": "wall", "mesh": 1, "translation": [0, 0.5, -2], "scale": [-2, 1, 1]},
        {"name": "mask", "mesh": 2, "translation": [-1, 0, 0], "children": [5]},
        {"name": "lamp", "mesh": 3, "translation": [1.5, 0, -0.5], "scale": [0.25, 0.5, 1]},
        {"name": "eye", "camera": 0, "translation": [0, 0.5, 5]},
        {"name": "child", "mesh": 4, "translation": [1, 0, 1]},
        {"name": "other", "mesh": 4, "translation": [0.5, 0.5, -1]},
        {"name": "bulb", "extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [1, 1.5, 1]},
        {"name": "torch", "extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [-1, 2, 2],
         "rotation": [-0.3826834323650898, 0, 0, 0.9238795325112867]},
        {"name": "sun", "extensions": {"KHR_lights_punctual": {"light": 2}}, "rotation": [-0.5, 0, 0, 0.8660254037844386]}],
    "scenes": [{"nodes": [0, 1, 2, 3, 4, 6, 7, 8, 9]}]}
open("model.gltf", "w").write(json.dumps(gltf))

# The same with all bytes in one file, and with the numbers in a file beside it.
def glb(tree, data):
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    body = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<III", 0x46546C67, 2, 12 + len(body)) + body
beside = dict(gltf, buffers=[{"byteLength": len(buffer), "uri": "numbers.bin"}])
open("beside.gltf", "w").write(json.dumps(beside))
open("numbers.bin", "wb").write(buffer)
data = buffer + b"\0" * (-len(buffer) % 4)
packed = dict(gltf, buffers=[{"byteLength": len(data) + len(color)}], bufferViews=views + [
    {"buffer": 0, "byteOffset": len(data), "byteLength": len(color)}])
packed["images"] = [{"bufferView": len(views), "mimeType": "image/png"}] + gltf["images"][1:]
open("model.glb", "wb").write(glb(packed, data + color))
open("short.glb", "wb").write(open("model.glb", "rb").read()[:700])
lacking = dict(beside, buffers=[{"byteLength": len(buffer), "uri": "lacking.bin"}])
open("lacking.gltf", "w").write(json.dumps(lacking))
no_picture = dict(gltf, images=[{"uri": "lacking.png"}] + gltf["images"][1:])
open("no-picture.gltf", "w").write(json.dumps(no_picture))
# What is missing is left out: the same as a model that has not named it. Names in other letter case, of Windows, and of a
# folder of another machine are found.
bare = json.loads(json.dumps(gltf))
for material in bare["materials"]:
    if material["pbrMetallicRoughness"].get("baseColorTexture", {}).get("index") == 0:
        del material["pbrMetallicRoughness"]["baseColorTexture"]
open("bare.gltf", "w").write(json.dumps(bare))
open("UPPER.PNG", "wb").write(color)
open("broken.ktx", "wb").write(b"\xabKTX 11\xbb\r\n")
for name, uri in (("letters", "upper.Png"), ("elsewhere", "C:%5Cartist%5CTextures%5Cupper.png"), ("format", "broken.ktx")):
    open(name + ".gltf", "w").write(json.dumps(dict(gltf, images=[{"uri": uri}] + gltf["images"][1:])))
open("held.glb", "wb").write(glb(dict(packed, bufferViews=packed["bufferViews"][:-1] + [
    {"buffer": 0, "byteOffset": len(data) + 1, "byteLength": len(color) - 1}]), data + color))
strong = json.loads(json.dumps(gltf))
strong["materials"][3]["emissiveFactor"] = [0.25, 0.125, 0.0625]
strong["materials"][3]["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}
open("strong.gltf", "w").write(json.dumps(strong))
open("flat.gltf", "w").write(json.dumps(dict(gltf, cameras=[
    {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0.1, "zfar": 100}}])))
dark = dict(gltf, nodes=[{"mesh": 0}], scenes=[{"nodes": [0]}])
open("dark.gltf", "w").write(json.dumps(dark))

# As XML.
def ply(name, positions, normals, uvs, faces):
    count = len(positions) // 3
    lines = ["ply", "format ascii 1.0", f"element vertex {count}"] + [f"property float {c}" for c in "xyz"]
    if normals:
        lines += [f"property float {c}" for c in ("nx", "ny", "nz", "u", "v")]
    lines += [f"element face {len(faces) // 3}", "property list uchar int vertex_indices", "end_header"]
    for i in range(count):
        values = positions[3 * i:3 * i + 3] + (normals[3 * i:3 * i + 3] + uvs[2 * i:2 * i + 2] if normals else [])
        lines.append(" ".join(map(str, values)))
    lines += ["3 " + " ".join(map(str, faces[i:i + 3])) for i in range(0, len(faces), 3)]
    open(name, "w").write("\n".join(lines) + "\n")
ply("quad.ply", positions, normals, uvs, indices)
ply("triangle.ply", triangle, None, None, [0, 1, 2])
from math import cos, sin, atan, tan, degrees
c, s = cos(0.5), sin(0.5)
def bitmap(name, file, more):
    return f'<texture type="bitmap" name="{name}"><string name="filename" value="{file}"/>{more}</texture>'
mirrored = '<string name="wrap_mode_v" value="mirror"/>'
base = bitmap("base_color", "color.png", '<vector name="factor" value="0.8 0.9 1"/>'
              f'<transform name="to_uv"><matrix value="{2 * c} {0.5 * s} 0 0.25 {-2 * s} {0.5 * c} 0 0.125 0 0 1 0 0 0 0 1"/></transform>'
              '<string name="wrap_mode" value="repeat"/>' + mirrored)
nearest = '<string name="filter_type" value="nearest"/><string name="wrap_mode" value="clamp"/><boolean name="raw" value="true"/>'
def principled(id, *inside, outside=("", "")):
    return f'{outside[0]}<bsdf type="twosided" {"" if outside[0] else f"""id="{id}" """}>{"".join(inside)}</bsdf>{outside[1]}'
def number(name, value):
    return f'<float name="{name}" value="{value}"/>'
materials = [
    principled("a", '<bsdf type="normalmap">', bitmap("normalmap", "normal.png", '<boolean name="raw" value="true"/>') + '<float name="scale" value="0.5"/>',
               '<bsdf type="principled">', base, number("roughness", 0.5), number("metallic", 0.25), '</bsdf></bsdf>'),
    principled("b", '<bsdf type="principled"><rgb name="base_color" value="0.9 0.6 0.3"/>',
               bitmap("roughness", "rough.png", nearest + '<string name="channel" value="green"/>'),
               bitmap("metallic", "rough.png", nearest + '<string name="channel" value="blue"/>'
                      '<vector name="factor" value="0.75 0.75 0.75"/>'), '</bsdf>'),
    principled("c", '<bsdf type="principled">', bitmap("base_color", "color.png", mirrored), number("roughness", 1),
               number("metallic", 0), '</bsdf>',
               outside=('<bsdf type="mask" id="c">' + bitmap("opacity", "color.png", mirrored + '<string name="channel" value="alpha"/>'
                                                            '<float name="cutoff" value="0.5"/>'), '</bsdf>')),
    principled("d", '<bsdf type="principled"><rgb name="base_color" value="0"/>', number("roughness", 1), number("metallic", 0), '</bsdf>')]
def shape(file, material, to_world, more=""):
    return (f'<shape type="ply"><string name="filename" value="{file}"/>{more}'
            f'<transform name="to_world">{to_world}</transform><ref id="{material}"/></shape>')
flat = '<boolean name="face_normals" value="true"/>'
def instance(to_world):
    return f'<shape type="instance"><ref id="group"/><transform name="to_world">{to_world}</transform></shape>'
hfov = degrees(2 * atan(1.5 * tan(0.4)))
open("model.xml", "w").write(f'''<scene version="3.0.0"><default name="spp" value="64"/>
<default name="resx" value="960"/><default name="resy" value="640"/>
{"".join(materials)}
<shape type="shapegroup" id="group"><shape type="ply"><string name="filename" value="triangle.ply"/>{flat}<ref id="b"/></shape></shape>
{shape("quad.ply", "a", '<scale value="3"/><rotate x="1" angle="-90"/><translate x="0" y="-1" z="0"/>')}
{shape("quad.ply", "b", '<scale x="-2" y="1" z="1"/><translate x="0" y="0.5" z="-2"/>')}
{shape("quad.ply", "c", '<translate x="-1" y="0" z="0"/>')}
{instance('<translate x="0" y="0" z="1"/>')}
{shape("quad.ply", "d", '<scale x="0.25" y="0.5" z="1"/><translate x="1.5" y="0" z="-0.5"/>',
       '<emitter type="area"><rgb name="radiance" value="1 0.5 0.25"/></emitter>')}
<integrator type="path"/>
<sensor type="perspective"><string name="fov_axis" value="x"/><float name="fov" value="{hfov}"/>
<transform name="to_world"><lookat origin="0, 0.5, 5" target="0, 0.5, 4" up="0, 1, 0"/></transform>
<sampler type="multijitter"><integer name="sample_count" value="$spp"/></sampler>
<film type="hdrfilm"><integer name="width" value="$resx"/><integer name="height" value="$resy"/></film></sensor>
{instance('<translate x="0.5" y="0.5" z="-1"/>')}
<emitter type="point"><point name="position" value="1 1.5 1"/><rgb name="intensity" value="6 4.8 3.6"/></emitter>
<emitter type="spot"><float name="cutoff_angle" value="{degrees(0.5)}"/><float name="beam_width" value="{degrees(0.2)}"/>
<rgb name="intensity" value="20"/><transform name="to_world"><lookat origin="-1, 2, 2" target="-1, 1, 1" up="0, 1, 0"/></transform></emitter>
<emitter type="directional"><vector name="direction" value="0 -0.8660254037844386 -0.5"/><rgb name="irradiance" value="1.5"/></emitter>
</scene>''')
open("cube.obj", "w").write('''mtllib cube.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 -.01
v 1 0 -.01
v 1 1 -.01
v 0 1 -.01
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl paint
f 1/1 2/2 3/3 4/4
usemtl glow
f 8/4 7/3 6/2 5/1
''')
open("cube.mtl", "w").write('newmtl paint\nKd 0.5 0.25 0.125\nNs 30\nKs 0.2 0.2 0.2\nmap_Kd color.png\nnewmtl glow\nKd 0 0 0\nKe 2 1 0.5\n')
PYTHON

small="-q --width 48 --height 32 --spp 16"
"$aureole" render model.xml $small -o xml.exr || fail "the XML is not rendered"
for model in model.gltf beside.gltf model.glb; do
  "$aureole" render $model $small -o model.exr || fail "$model is not rendered"
  # Turns and angles have other last digits in the two.
  "$aureole" compare xml.exr model.exr --metric relative-rmse --tolerance 1e-4 >compared ||
    fail "$model differs from its XML: $(cat compared)"
done
"$aureole" render model.glb $small -t 3 -o three.exr && cmp -s three.exr model.exr || fail "threads change the image of a model"

# renders MODEL [WORDS]: as MODEL.exr, with a warning of these words.
renders() {
  "$aureole" render $1 --width 48 --height 32 --spp 16 -o $1.exr >said 2>&1 || fail "$1 is not rendered: $(cat said)"
  grep -q "${2:-}" said || fail "$1 does not warn of '${2:-}': $(cat said)"
}
renders model.gltf
renders bare.gltf
renders no-picture.gltf "1 texture is left out: its image cannot be found: 'lacking.png'"
renders format.gltf "1 texture is left out: its image is of an unknown format: 'broken.ktx'"
renders held.glb "1 texture is left out: its image is of an unknown format: image 1"
for model in no-picture.gltf format.gltf held.glb; do
  cmp -s bare.gltf.exr $model.exr || fail "$model is not as if the picture were not named"
done
renders letters.gltf "1 file has another spelling: 'upper.Png' as 'UPPER.PNG'"
renders elsewhere.gltf "1 file has another spelling: 'C:/artist/Textures/upper.png' as 'UPPER.PNG'"
renders strong.gltf
cp numbers.bin 'num bers.bin'
sed 's/"numbers.bin"/"num%20bers.bin"/' beside.gltf >'50%25.gltf'
renders '50%25.gltf'
cmp -s model.gltf.exr '50%25.gltf.exr' || fail "a buffer whose name has a blank is not found"
for model in letters.gltf elsewhere.gltf strong.gltf; do
  cmp -s model.gltf.exr $model.exr || fail "$model is not model.gltf"
done
sed 's|<sensor type="perspective">.*|<sensor type="orthographic">|; s|<transform name="to_world"><lookat origin="0, 0.5, 5"|<transform name="to_world"><scale x="3" y="3"/><lookat origin="0, 0.5, 5"|' \
  model.xml >flat.xml
"$aureole" render flat.xml $small -o xml.exr || fail "the XML with an orthographic sensor is not rendered"
"$aureole" render flat.gltf $small -o model.exr || fail "an orthographic camera is not rendered"
"$aureole" compare xml.exr model.exr --metric relative-rmse --tolerance 1e-4 >compared ||
  fail "an orthographic camera differs from its sensor: $(cat compared)"

"$aureole" info model.glb >said 2>&1 || fail "info of a model: $(cat said)"
grep -q '^width  *960' said || fail "info does not say the film of a model: $(cat said)"
"$aureole" render model.glb -q --width 8 --spp 1 -o model.png || fail "no PNG of a model"
"$aureole" info cube.obj >said 2>&1 || fail "info of an OBJ: $(cat said)"
grep -q 'has no camera' said || fail "the camera that is added is not said: $(cat said)"
grep -q 'has no light source but surfaces that emit' said || fail "the light that is added to what glows is not reported: $(cat said)"
"$aureole" info cube.obj --model-light none >said 2>&1 || fail "info without added light: $(cat said)"
grep -q 'has no light' said && fail "light is added in spite of --model-light none: $(cat said)"
[ "$(sed -n 's/^emitters  *//p' said)" = 1 ] || fail "a quad that glows is not one emitter: $(cat said)"
"$aureole" info model.glb --model-light always >said 2>&1 || fail "info with more light: $(cat said)"
[ "$(sed -n 's/^emitters  *//p' said)" = 5 ] || fail "no light is added to lamps by --model-light always: $(cat said)"
"$aureole" info dark.gltf >said 2>&1 && grep -q 'has no light' said || fail "the light that is added is not said: $(cat said)"

# One body by its points alone: the images from the camera that is added are the same. 3DS counts z upwards, and assimp
# turns it.
/usr/bin/python3 - <<'PYTHON' || fail "the other models cannot be written"
import struct
points = [(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1), (0, 2, 0)]
faces = [(0, 1, 2), (0, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)]
risen = [(x, -z, y) for x, y, z in points]  # z upwards
triangles = [[points[i] for i in face] for face in faces]
with open("roof.obj", "w") as file:
    for face in triangles:
        file.writelines("v %g %g %g\n" % p for p in face)
    file.writelines("f %d %d %d\n" % (3 * i + 1, 3 * i + 2, 3 * i + 3) for i in range(len(faces)))
with open("roof.off", "w") as file:
    file.write("OFF\n%d %d 0\n" % (len(points), len(faces)))
    file.writelines("%g %g %g\n" % p for p in points)
    file.writelines("3 %d %d %d\n" % face for face in faces)

def chunk(kind, data):
    return struct.pack("<HI", kind, 6 + len(data)) + data
mesh = chunk(0x4110, struct.pack("<H", len(points)) + b"".join(struct.pack("<3f", *p) for p in risen))
mesh += chunk(0x4120, struct.pack("<H", len(faces)) + b"".join(struct.pack("<4H", *face, 7) for face in faces))
with open("roof.3ds", "wb") as file:
    file.write(chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, b"roof\0" + chunk(0x4100, mesh)))))
PYTHON
for model in roof.obj roof.off roof.3ds; do
  "$aureole" render $model -q --integrator depth --width 32 --spp 4 --seed 1 -o ${model#*.}.exr 2>said || fail "$model is not rendered: $(cat said)"
done
for form in off 3ds; do
  "$aureole" compare obj.exr $form.exr --metric relative-rmse --tolerance 1e-4 >compared || fail "roof.$form is not roof.obj: $(cat compared)"
done

# In a scene, beside what else there is, and twice.
cat >both.xml <<'XML'
<scene version="3.0.0"><include filename="dark.gltf"/><include filename="cube.obj"/>
<emitter type="constant"/><sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/>
<integer name="height" value="8"/></film></sensor></scene>
XML
"$aureole" render both.xml -q --spp 1 -o both.exr || fail "models in a scene are not rendered"

# refused FILE WORDS [OPTION...]
refused() {
  "$aureole" info "$1" "${@:3}" >said 2>&1
  [ $? = 2 ] && grep -q "$2" said || fail "$1 is not refused with '$2': $(cat said)"
}
refused short.glb 'cannot be read'
refused lacking.gltf 'lacking.bin'
printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' >line.obj
refused line.obj 'has no triangle'
printf '{"asset": {"version": "2.0"}, "meshes": [}' >broken.gltf
refused broken.gltf 'cannot be read'
: >empty.glb
refused empty.glb 'cannot be read'
for name in empty.stp part.step pack.3mf scene.usda; do
  case $name in
    empty*) : >$name ;;
    part*) echo 'ISO-10303-21;' >$name ;;
    pack*) printf 'PK\003\004\000\000' >$name ;;
    *) echo '#usda 1.0' >$name ;;
  esac
  refused $name 'unknown kind of file'
  "$aureole" render $name -o o.exr >said 2>&1
  [ $? = 2 ] && grep -q "^aureole: $name: unknown kind of file" said || fail "render does not say that $name is of an unknown kind: $(cat said)"
done
mkdir -p inside && cp beside.gltf inside/ && sed -i 's/numbers.bin/..\/numbers.bin/' inside/beside.gltf
"$aureole" render inside/beside.gltf -q --spp 1 --width 8 --confine -o confined.exr 2>said
[ $? = 2 ] || fail "a model reads files outside of its folder where it is confined"

# Materials of an OBJ are those of a scene that has them as XML; every second file has other line ends and letter case.
cat >quad.obj <<'OBJ'
mtllib materials of quads.MTL
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
usemtl Painted #1
f 1/1/1 2/2/1 3/3/1 4/4/1
OBJ
cat >'Materials of Quads.mtl' <<'MTL'
newmtl Painted #2
Kd 0 0 0
newmtl Painted #1
Kd 0.5 1 0.25
map_Kd -s 1 1 1 -bm 1 .\color.PNG
map_Pr rough.png
Pr 0.5
Pm 0.25
norm normal.png
map_d rough.png
d 0.5
Ke 0.125 0.25 0.5
map_Ke color.png
MTL
cat >surroundings.xml <<'XML'
<scene version="3.0.0"><emitter type="constant"/><integrator type="path"/><sensor type="perspective"><transform name="to_world">
<lookat origin="1, 1, 4" target="0, 0, 0" up="0, 1, 0"/></transform><film type="hdrfilm"><integer name="width" value="32"/>
<integer name="height" value="24"/></film></sensor>
XML
{ cat surroundings.xml; echo '<include filename="quad.obj"/></scene>'; } >quad-model.xml
texture() { echo "<texture type=\"bitmap\" name=\"$1\"><string name=\"filename\" value=\"$2\"/>$3</texture>"; }
raw='<boolean name="raw" value="true"/><string name="channel"'
{
  cat surroundings.xml
  echo '<shape type="obj"><string name="filename" value="quad.obj"/><emitter type="area">'
  texture radiance color.png '<vector name="factor" value="0.125 0.25 0.5"/>'
  echo '</emitter><bsdf type="mask">'
  texture opacity rough.png "$raw value=\"rgb\"/><vector name=\"factor\" value=\"0.5 0.5 0.5\"/>"
  echo '<bsdf type="twosided"><bsdf type="normalmap">'
  texture normalmap normal.png '<boolean name="raw" value="true"/>'
  echo '<bsdf type="principled">'
  texture base_color color.png '<vector name="factor" value="0.5 1 0.25"/>'
  texture roughness rough.png "$raw value=\"red\"/><vector name=\"factor\" value=\"0.5 0.5 0.5\"/>"
  echo '<float name="metallic" value="0.25"/></bsdf></bsdf></bsdf></bsdf></shape></scene>'
} >quad-scene.xml
for side in scene model; do
  "$aureole" render quad-$side.xml --spp 16 -o quad-$side.exr >said 2>&1 || fail "quad-$side.xml is not rendered: $(cat said)"
done
grep -q "2 files have other spellings: 'materials of quads.MTL' as 'Materials of Quads.mtl', './color.PNG' as './color.png'" said ||
  fail "other names are not reported: $(cat said)"
"$aureole" compare quad-scene.exr quad-model.exr --metric relative-rmse --tolerance 1e-6 >compared || fail "materials of an OBJ are not those of its scene: $(cat compared)"

# Names of files are bytes: they need not be UTF-8.
cp color.png $'gr\374n.png'
for name in color $'gr\374n'; do
  printf 'newmtl Painted #1\nmap_Kd %s.png\n' "$name" >'materials of quads.MTL'
  "$aureole" render quad.obj -q --spp 1 --width 16 -o "$name.exr" || fail "a texture is not read from $name.png"
done
cmp color.exr $'gr\374n.exr' || fail "a texture depends on its file's name"

# A texture is the same from a BMP and a TGA, whose name alone tells what it is; "Tr 1" is a whole surface.
/usr/bin/python3 - <<'PYTHON' || fail "the textures cannot be written"
import struct
texels = bytes([10, 200, 90, 255, 40, 30, 60, 70, 80, 120, 0, 250])  # 2 x 2 of blue, green, red, from below
open("texels.bmp", "wb").write(struct.pack("<2sIHHIIiiHHIIiiII", b"BM", 70, 0, 0, 54, 40, 2, 2, 1, 24, 0, 16, 0, 0, 0, 0) + texels[:6] + b"\0\0" + texels[6:] + b"\0\0")
open("texels.tga", "wb").write(struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, 2, 2, 24, 0) + texels)
for name, mtl in (("bmp", "map_Kd texels.bmp"), ("tga", "map_Kd texels.tga"), ("whole", "Tr 1\nmap_Kd texels.bmp")):
    open(name + ".mtl", "w").write("newmtl paint\nKd 1 1 1\n" + mtl + "\n")
    open(name + ".obj", "w").write("mtllib " + name + ".mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3 4/4\n")
PYTHON
for name in bmp tga whole; do
  "$aureole" render $name.obj -q --spp 1 --width 16 -o $name.pfm || fail "$name.obj is not rendered"
  cmp bmp.pfm $name.pfm || fail "$name.obj is another image than bmp.obj"
done

# A Collada material of opacity 0 is opaque, as programs write either end of the range for that.
dae() { # NAME TRANSPARENCY
  cat >"$1.dae" <<XML
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert><diffuse><color>.6 .3 .1 1</color></diffuse>
<transparent><color>1 1 1 1</color></transparent><transparency><float>$2</float></transparency></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m" target="#m"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
XML
  "$aureole" render "$1.dae" -q --spp 1 --width 16 -o "$1.pfm" || fail "$1.dae is not rendered"
}
dae opaque 1
dae clear 0
dae half 0.5
cmp opaque.pfm clear.pfm || fail "a Collada material of opacity 0 is not there"
cmp -s opaque.pfm half.pfm && fail "a Collada material of opacity .5 is opaque"

# A model at map coordinates is seen as the same one near 0, in every format that holds the digits: the coordinates are sums
# of few powers of two, so that nothing is rounded in the files; what differs is the last digit of the camera's place.
/usr/bin/python3 - <<'PYTHON' || fail "the models at map coordinates cannot be written"
import base64, json, struct
points = [(-1.25, 0, -1.5), (1.75, 0.125, -1), (1, 0.25, 1), (-1, 0, 1.5), (0.375, 2.125, 0.25)]
faces = [(0, 1, 2), (0, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)]
for name, offset in (("near", (0, 0, 0)), ("far", (500000.25, 5400000.5, 412.75))):
    moved = [" ".join(repr(float(a + b)) for a, b in zip(point, offset)) for point in points]
    open(name + ".obj", "w").write("".join(f"v {p}\n" for p in moved) + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in faces))
    open(name + ".off", "w").write("OFF\n5 6 0\n" + "".join(p + "\n" for p in moved) + "".join("3 %d %d %d\n" % f for f in faces))
    open(name + ".ply", "w").write("ply\nformat ascii 1.0\nelement vertex 5\n" + "".join(f"property double {c}\n" for c in "xyz") +
                                   "element face 6\nproperty list uchar int vertex_indices\nend_header\n" +
                                   "".join(p + "\n" for p in moved) + "".join("3 %d %d %d\n" % f for f in faces))
    open(name + ".stl", "w").write("solid a\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {moved[i]}\n" for i in f) +
                                                        "endloop\nendfacet\n" for f in faces) + "endsolid a\n")
    data = struct.pack("<15f", *sum(points, ())) + struct.pack("<18H", *sum(faces, ()))
    open(name + ".gltf", "w").write(json.dumps({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "translation": offset}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3", "min": [-1.25, 0, -1.5], "max": [1.75, 2.125, 1.5]},
                      {"bufferView": 1, "componentType": 5123, "count": 18, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 60}, {"buffer": 0, "byteOffset": 60, "byteLength": 36}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}))
PYTHON
for form in obj off ply stl gltf; do
  for place in near far; do
    "$aureole" render $place.$form -q --width 32 --spp 4 -o $place.exr || fail "$place.$form is not rendered"
  done
  "$aureole" compare near.exr far.exr --metric relative-rmse --tolerance 1e-5 >compared || fail "far.$form is not near.$form: $(cat compared)"
done

# In a body that loses no light, paths end after 32 edges unless an integrator or a definition sets another limit.
printf 'newmtl white\nKd 1 1 1\nKe 1 1 1\n' >white.mtl
printf 'mtllib white.mtl\nusemtl white\n' >closed.obj
printf 'v %s\n' '-1 -1 -1' '1 -1 -1' '1 1 -1' '-1 1 -1' '-1 -1 1' '1 -1 1' '1 1 1' '-1 1 1' >>closed.obj
printf 'f %s\n' '1 2 3 4' '8 7 6 5' '1 5 6 2' '4 3 7 8' '1 4 8 5' '2 6 7 3' >>closed.obj
for depth in "" 32 33; do
  "$aureole" render closed.obj ${depth:+--integrator path:max_depth=$depth} --environment none --camera 0,0,0,0,0,-1,60 --width 8 --height 8 --samples 4 -q -o "closed$depth.exr" 2>said ||
    fail "a closed body: $(cat said)"
done
cmp -s closed.exr closed32.exr || fail "paths of models do not end after 32 edges"
cmp -s closed.exr closed33.exr && fail "no path in a closed body is longer than 32 edges"
for options in "--integrator path" "--integrator path:max_depth=33 -D max_depth=5" "--integrator path -D max_depth=33"; do
  "$aureole" render closed.obj $options --environment none --camera 0,0,0,0,0,-1,60 --width 8 --height 8 --samples 4 -q -o named.exr || fail "$options"
  case $options in *33*) cmp -s named.exr closed33.exr ;; *) cmp -s named.exr closed32.exr ;; esac || fail "another limit with $options"
done

# The models that are compared with Mitsuba are the scenes that stand for them there.
for kind in gltf obj; do
  for side in "" .ours; do
    "$aureole" render "$2/bench/peers/models/$kind$side.xml" -q --spp 4 -o "peer$side.exr" || fail "$kind$side.xml fails"
  done
  "$aureole" compare peer.exr peer.ours.exr --metric relative-rmse --tolerance 1e-6 >said || fail "arch.$kind is not its scene: $(cat said)"
done
echo "models: the same images as XML"

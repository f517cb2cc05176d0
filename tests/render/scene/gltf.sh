#!/usr/bin/env bash
# glTF beyond what assimp reads: integers as coordinates (KHR_mesh_quantization), copies (EXT_mesh_gpu_instancing), and extensions of
# materials. Each is the same image, bit by bit, as a model or a scene that says the same in plain words.
set -u
aureole=$1
fail() { echo "$1"; exit 1; }
/usr/bin/python3 -c '' 2>/dev/null || { echo "skipped: there is no Python to write models with"; exit 77; }
[ -e "$(dirname "$aureole")/aureole-import" ] || { echo "skipped: this build has no assimp"; exit 77; }

/usr/bin/python3 - <<'PYTHON' || fail "the models cannot be written"
import base64, json, struct

FLOAT, SHORT, USHORT, BYTE = 5126, 5122, 5123, 5120
CODE = {FLOAT: "f", SHORT: "h", USHORT: "H", BYTE: "b"}
points = [(0, 0, 0), (4, 0, 1), (4, 3, 0), (0, 3, 2), (2, 1, 4)]
normals = [(0, 0, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0)]
uvs = [(0, 1), (1, 1), (1, 0), (0, 0), (1, 1)]
indices = [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4]
texels = ("Qk1mAAAAAAAAADYAAAAoAAAABAAAAAQAAAABABgAAAAAADAAAAAAAAAAAAAAAAAAAAAAAAAA" + base64.b64encode(bytes(range(20, 212, 4))).decode())

class Model:
    def __init__(self):
        self.data, self.views, self.accessors = b"", [], []
    def add(self, rows, code, normalized=False, pad=0):
        """An accessor; rows have `pad` bytes more."""
        width = len(rows[0]) if isinstance(rows[0], tuple) else 1
        stride = width * struct.calcsize(CODE[code]) + pad
        self.views.append(dict({"buffer": 0, "byteOffset": len(self.data), "byteLength": stride * len(rows)},
                               **({"byteStride": stride} if pad else {})))
        for row in rows:
            self.data += struct.pack("<%d%s" % (width, CODE[code]), *(row if width > 1 else (row,))) + b"\0" * pad
        self.data += b"\0" * (-len(self.data) % 4)
        entry = {"bufferView": len(self.views) - 1, "componentType": code, "count": len(rows),
                 "type": ["SCALAR", "VEC2", "VEC3", "VEC4"][width - 1]}
        if normalized:
            entry["normalized"] = True
        self.accessors.append(entry)
        return len(self.accessors) - 1
    def bounds(self, index, rows):
        self.accessors[index].update(min=[min(c) for c in zip(*rows)], max=[max(c) for c in zip(*rows)])
        return index
    def tree(self, attributes, index, nodes, material=None, form="embedded"):
        uri = {"embedded": "data:application/octet-stream;base64," + base64.b64encode(self.data).decode(), "beside": "all%20numbers.bin"}
        tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
                "materials": [material or {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}],
                "textures": [{"source": 0}], "images": [{"uri": "data:image/bmp;base64," + texels}],
                "meshes": [{"primitives": [{"attributes": attributes, "indices": index, "material": 0}]}],
                "accessors": self.accessors, "bufferViews": self.views, "buffers": [{"byteLength": len(self.data)}]}
        tree["extensionsUsed"] = list((material or {}).get("extensions", {})) + ["KHR_mesh_quantization", "EXT_mesh_gpu_instancing"]
        if form != "glb":
            tree["buffers"][0]["uri"] = uri[form]
        return tree
    def write(self, name, tree):
        if not name.endswith(".glb"):
            open(name, "w").write(json.dumps(tree))
            return
        text = json.dumps(tree).encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(self.data), 0x004E4942) + self.data
        open(name, "wb").write(struct.pack("<III", 0x46546C67, 2, 12 + len(body)) + body)

def build(quantized):
    m = Model()
    if quantized:
        attributes = {"POSITION": m.bounds(m.add(points, SHORT, pad=2), points),
                      "NORMAL": m.add([tuple(127 * c for c in n) for n in normals], BYTE, True, pad=1),
                      "TEXCOORD_0": m.add([tuple(65535 * c for c in uv) for uv in uvs], USHORT, True)}
    else:
        attributes = {"POSITION": m.bounds(m.add(points, FLOAT), points), "NORMAL": m.add(normals, FLOAT), "TEXCOORD_0": m.add(uvs, FLOAT)}
    return m, attributes, m.add(indices, USHORT)
body = {"mesh": 0, "scale": [0.5, 0.5, 0.5]}
m, attributes, index = build(False)
m.write("float.gltf", m.tree(attributes, index, [body]))
m, attributes, index = build(True)
m.write("integer.gltf", m.tree(attributes, index, [body]))
m.write("integer.glb", m.tree(attributes, index, [body], form="glb"))
m.write("beside.gltf", m.tree(attributes, index, [body], form="beside"))
open("all numbers.bin", "wb").write(m.data)

# Copies, as an extension and as nodes, these in two orders.
shifts, turns, sizes = [(0, 0, 0), (3, 0, 1), (-2, 2, 0)], [(0, 0, 0, 1), (0, 1, 0, 0), (0, 0, 1, 0)], [(1, 1, 1), (2, 1, 1), (1, 0.5, 1)]
m, attributes, index = build(False)
copies = {"TRANSLATION": m.add(shifts, FLOAT), "ROTATION": m.add([tuple(127 * c for c in q) for q in turns], BYTE, True), "SCALE": m.add(sizes, FLOAT)}
m.write("copies.gltf", m.tree(attributes, index, [dict(body, extensions={"EXT_mesh_gpu_instancing": {"attributes": copies}})]))
nodes = [{"mesh": 0, "translation": t, "rotation": q, "scale": s} for t, q, s in zip(shifts, turns, sizes)]
for name, order in (("nodes", (0, 1, 2)), ("other", (2, 0, 1))):
    tree = m.tree(attributes, index, [{"scale": [0.5, 0.5, 0.5], "children": [1, 2, 3]}] + [nodes[i] for i in order])
    tree["scenes"][0]["nodes"] = [0]
    m.write(name + ".gltf", tree)

# Materials.
m, attributes, index = build(False)
base = {"baseColorFactor": [0.8, 0.6, 0.4, 1], "metallicFactor": 0, "roughnessFactor": 0.5}
through = {"transmissionFactor": 0.75}
principled = '<bsdf type="principled">{}<float name="roughness" value="0.5"/><float name="metallic" value="0"/>{}</bsdf>'
color = '<rgb name="base_color" value="{}"/>'.format
def number(name, value):
    return f'<float name="{name}" value="{value}"/>'
plain = color("0.8 0.6 0.4")
cases = {
    "sheen": ({"KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.25, 0.5]}},
              '<bsdf type="twosided">' + principled.format(plain, number("sheen", 0.5) + number("sheen_tint", 0.5)) + "</bsdf>"),
    "specular": ({"KHR_materials_specular": {"specularFactor": 0.5}, "KHR_materials_ior": {"ior": 1.5}},
                 '<bsdf type="twosided">' + principled.format(plain, number("specular", 12.5 * 0.04 * 0.5)) + "</bsdf>"),
    "volume": ({"KHR_materials_transmission": through, "KHR_materials_ior": {"ior": 1.25},
                "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 1, "attenuationColor": [0.5, 1, 0.25]}},
               principled.format(color("0.2 0.6 0.025"), number("eta", 1.25) + number("spec_trans", 0.75))),
    # alpha across .25, along .25 + .75 * .36 = .52: roughness (.25 * .52)^(1/4), and 1 - .25 / .52 = .9 a
    "turned": ({"KHR_materials_anisotropy": {"anisotropyStrength": 0.6}}, '<bsdf type="twosided"><bsdf type="principled">' + plain +
               number("roughness", 0.13 ** 0.25) + number("metallic", 0) + number("anisotropic", (1 - 0.25 / 0.52) / 0.9) + "</bsdf></bsdf>"),
    "coated": ({"KHR_materials_clearcoat": {"clearcoatFactor": 0.75, "clearcoatTexture": {"index": 0}}}, '<bsdf type="twosided">' +
               principled.format(plain, '<texture type="bitmap" name="clearcoat"><string name="filename" value="texels.bmp"/><boolean name="raw" value="true"/>'
               '<string name="channel" value="red"/><vector name="factor" value="0.75 0.75 0.75"/></texture>' + number("clearcoat_gloss", 1)) + "</bsdf>"),
    "sheet": ({"KHR_materials_transmission": through},
              '<bsdf type="principledthin">' + plain + number("roughness", 0.5) + number("spec_trans", 0.75) + number("eta", 1.5) + "</bsdf>")}
for name, (extensions, bsdf) in cases.items():
    material = {"pbrMetallicRoughness": base, "extensions": extensions}
    m.write(name + ".gltf", m.tree(attributes, index, [body], material))
    with open(name + ".xml", "w") as file:
        file.write('<scene version="3.0.0"><shape type="ply"><string name="filename" value="body.ply"/><transform name="to_world">'
                   f'<scale value="0.5"/></transform>{bsdf}</shape><sensor type="perspective"><sampler type="multijitter"/></sensor></scene>')
open("texels.bmp", "wb").write(base64.b64decode(texels))
with open("body.ply", "w") as file:
    file.write(f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n" + "".join(f"property float {c}\n" for c in ("x", "y", "z", "nx", "ny", "nz", "u", "v")) +
               f"element face {len(indices) // 3}\nproperty list uchar int vertex_indices\nend_header\n")
    for p, n, uv in zip(points, normals, uvs):
        file.write(" ".join(map(str, p + n + (uv[0], uv[1]))) + "\n")
    for i in range(0, len(indices), 3):
        file.write("3 %d %d %d\n" % tuple(indices[i:i + 3]))

# Wrapping along v alone: u lies within the image, so that its wrapping does not matter to the nearest texel.
m, attributes, index = build(False)
attributes["TEXCOORD_0"] = m.add([(0.9 * u + 0.05, 3 * v - 1) for u, v in uvs], FLOAT)
for name, wrap in (("clamped", (33071, 33071)), ("mixed", (10497, 33071)), ("repeated", (10497, 10497))):
    tree = m.tree(attributes, index, [body])
    tree["samplers"] = [{"wrapS": wrap[0], "wrapT": wrap[1], "magFilter": 9728}]
    tree["textures"][0]["sampler"] = 0
    m.write(name + ".gltf", tree)
# Normals (.5, 0, 1) times a scale of 2 are (1, 0, 1).
for name, normal in (("scaled", '<rgb name="normalmap" value="0.75 0.5 1"/><float name="scale" value="2"/>'), ("steep", '<rgb name="normalmap" value="1 0.5 1"/>')):
    with open(name + ".xml", "w") as file:
        file.write('<scene version="3.0.0"><shape type="ply"><string name="filename" value="body.ply"/><bsdf type="twosided"><bsdf type="normalmap">' + normal +
                   '<bsdf type="diffuse"/></bsdf></bsdf></shape><sensor type="perspective"><sampler type="multijitter"/></sensor></scene>')

# Motion: a node, a morph target and a skin half way between keys, beside models that stand there.
m, attributes, index = build(False)
times, moves = m.add([1.0, 3.0], FLOAT), m.add([(0, 0, 0), (2, 4, 0)], FLOAT)
turns = m.add([(0, 0, 0, 1), (0, 1, 0, 0)], FLOAT)  # half a turn about y
for entry in (times,):
    m.accessors[entry].update(min=[1.0], max=[3.0])
ups = [(0, 2, 0)] * len(points)
lift = m.bounds(m.add(ups, FLOAT), ups)
weights = m.add([0.0, 1.0], FLOAT)
def moving(name, tree, *channels):
    tree["animations"] = [{"samplers": [{"input": times, "output": output} for _, _, output in channels],
                           "channels": [{"sampler": i, "target": {"node": node, "path": path}} for i, (node, path, _) in enumerate(channels)]}]
    m.write(name + ".gltf", tree)
moving("node", m.tree(attributes, index, [{"mesh": 0}]), (0, "translation", moves), (0, "rotation", turns))
tree = m.tree(attributes, index, [{"mesh": 0}])
tree["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": lift}]
tree["meshes"][0]["weights"] = [0]
moving("morph", tree, (0, "weights", weights))
joints = m.add([(1, 0, 0, 0)] * len(points), USHORT)
full = m.add([(1.0, 0.0, 0.0, 0.0)] * len(points), FLOAT)
# Weights of .25 alone, and those of one corner that has none: as if they were 1, but that corner stays.
short = m.add([(0.25, 0.0, 0.0, 0.0)] * (len(points) - 1) + [(0.0, 0.0, 0.0, 0.0)], FLOAT)
identity = tuple(float(i % 5 == 0) for i in range(16))
m.views.append({"buffer": 0, "byteOffset": len(m.data), "byteLength": 128})
m.data += struct.pack("<32f", *(identity * 2))
m.accessors.append({"bufferView": len(m.views) - 1, "componentType": FLOAT, "count": 2, "type": "MAT4"})
tree = m.tree(dict(attributes, JOINTS_0=joints, WEIGHTS_0=full), index, [{"mesh": 0, "skin": 0, "translation": [9, 9, 9]}, {"children": [2]}, {}])
tree["scenes"][0]["nodes"] = [0, 1]
tree["skins"] = [{"joints": [1, 2], "inverseBindMatrices": len(m.accessors) - 1}]
moving("skin", tree, (2, "translation", moves))
tree["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = short
moving("short", tree, (1, "translation", moves))
for name, transform in (("node", {"translation": [1, 2, 0], "rotation": [0, 0.5 ** 0.5, 0, 0.5 ** 0.5]}), ("morph", {"translation": [0, 1, 0]}),
                        ("skin", {"translation": [1, 2, 0]}), ("skin-rest", {})):
    m.write(name + "-there.gltf", m.tree(attributes, index, [dict({"mesh": 0}, **transform)]))

# Materials of variants, and what is not read.
red, blue = ({"pbrMetallicRoughness": dict(base, baseColorFactor=color)} for color in ([0.8, 0.1, 0.1, 1], [0.1, 0.1, 0.8, 1]))
m, attributes, index = build(False)
m.write("blue.gltf", m.tree(attributes, index, [body], blue))
tree = m.tree(attributes, index, [{"scale": [0.5, 0.5, 0.5], "children": [1]}, {"mesh": 0}], red)
tree["scenes"][0]["nodes"] = [0]
tree["materials"].append(blue)
tree["extensionsUsed"].append("KHR_materials_variants")
tree["extensions"] = {"KHR_materials_variants": {"variants": [{"name": "night"}, {"name": "deep sea"}]}}
tree["meshes"][0]["primitives"][0]["extensions"] = {"KHR_materials_variants": {"mappings": [{"material": 0, "variants": [0]}, {"material": 1, "variants": [1]}]}}
m.write("variants.gltf", tree)
glb = m.tree(attributes, index, [body], red, form="glb")
for key in ("materials", "extensions", "extensionsUsed"):
    glb[key] = tree[key]
glb["meshes"][0]["primitives"][0] = dict(tree["meshes"][0]["primitives"][0])
del glb["meshes"][0]["primitives"][0]["material"]
m.write("variants.glb", glb)
# Materials in another order than their meshes, with a line between these: each has its own extensions.
cloth = {"pbrMetallicRoughness": base, "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0.9, 0.9, 0.9]}}}
for name, materials, numbers in (("order", [cloth, red], (0, 1)), ("swapped", [red, cloth], (1, 0))):
    tree = m.tree(attributes, index, [dict(body), dict(body, mesh=1, translation=[0, 0, -2])])
    part = tree["meshes"][0]["primitives"][0]
    tree["meshes"] = [{"primitives": [dict(part, mode=1), dict(part, material=number)]} for number in numbers]
    tree["materials"] = materials
    m.write(name + ".gltf", tree)
lit = m.tree(attributes, index, [body, {"extensions": {"KHR_lights_punctual": {"light": 0}}}], red)
lit["extensionsUsed"].append("KHR_lights_punctual")
lit["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 20000}]}}
m.write("lit.gltf", lit)
eyes = m.tree(attributes, index, [body] + [{"camera": i, "name": "eye %d" % i, "translation": [0, 0, 9 + i]} for i in range(3)], red)
eyes["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}] * 3
m.write("eyes.gltf", eyes)
def odd(name, required=(), mode=None, textures=None, extensions=None):
    m, attributes, index = build(False)
    tree = m.tree(attributes, index, [body], {"pbrMetallicRoughness": base, "extensions": extensions or {}})
    tree["extensionsRequired"] = list(required)
    if mode is not None:
        tree["meshes"][0]["primitives"].append(dict(tree["meshes"][0]["primitives"][0], mode=mode))
    if textures:
        tree["textures"] = textures
    m.write("odd-" + name + ".gltf", tree)
odd("lines", mode=1)
odd("meshopt", ["EXT_meshopt_compression"])
odd("unknown", ["VENDOR_thing"])
for name in ("EXT_texture_webp", "KHR_texture_basisu"):
    odd(name, [name], textures=[{"extensions": {name: {"source": 0}}}])
odd("film", extensions={"KHR_materials_iridescence": {"iridescenceFactor": 1}})
odd("coat", extensions={"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0}}})
bare = m.tree(attributes, index, [body], red)
bare["meshes"][0]["primitives"][0]["mode"] = 0
m.write("odd-points.gltf", bare)
PYTHON

draw() { # draw FILE OUTPUT
  "$aureole" render "$1" -q "${@:3}" --camera 3,2,6,0.5,0.5,0.5,40 --environment studio --width 32 --height 24 --spp 16 --filter box -o "$2" || fail "$1 is not rendered"
}
draw float.gltf float.exr
for model in integer.gltf integer.glb beside.gltf; do
  draw $model made.exr && cmp float.exr made.exr || fail "$model is not float.gltf"
done
draw nodes.gltf nodes.exr
"$aureole" info copies.gltf >said 2>&1 && "$aureole" info nodes.gltf >other 2>&1 && diff <(grep -v '^a' said) <(grep -v '^a' other) || fail "copies are other shapes than nodes"
draw copies.gltf made.exr
"$aureole" compare nodes.exr made.exr --metric relative-rmse --tolerance 1e-5 >compared || fail "copies are not the nodes: $(cat compared)"
draw other.gltf made.exr
"$aureole" compare nodes.exr made.exr --metric relative-rmse --tolerance 1e-5 >compared || fail "the order of nodes matters: $(cat compared)"
for name in sheen specular volume sheet turned coated; do
  draw $name.gltf made.exr
  draw $name.xml scene.exr
  "$aureole" compare scene.exr made.exr --metric relative-rmse --tolerance 1e-5 >compared || fail "$name is not its scene: $(cat compared)"
done
for name in clamped mixed repeated scaled.xml steep.xml; do
  case $name in *.xml) draw $name "${name%.xml}.pfm" ;; *) draw $name.gltf $name.pfm ;; esac
done
cmp clamped.pfm mixed.pfm || fail "wrapping along v is not that of the sampler"
cmp -s repeated.pfm mixed.pfm && fail "wrapping along v does not matter"
cmp scaled.pfm steep.pfm || fail "the scale of a normal map is no factor of x and y"
for name in node morph skin; do
  draw $name.gltf made.exr --at 2
  draw $name-there.gltf there.exr
  "$aureole" compare there.exr made.exr --metric relative-rmse --tolerance 1e-4 >compared || fail "$name.gltf is elsewhere at 2 s: $(cat compared)"
done
draw skin.gltf made.exr
draw skin-rest-there.gltf there.exr
"$aureole" compare there.exr made.exr --metric relative-rmse --tolerance 1e-4 >compared || fail "a skin is not where its bones are: $(cat compared)"
draw short.gltf made.exr
"$aureole" compare there.exr made.exr --metric relative-rmse --tolerance 1e-4 >compared || fail "weights are not made to sum up to 1: $(cat compared)"
draw blue.gltf there.pfm
draw variants.gltf made.pfm --variant "deep sea"
cmp there.pfm made.pfm || fail "a variant has not its material"
draw variants.glb made.pfm --variant "deep sea"
cmp there.pfm made.pfm || fail "a variant of a .glb has not its material"
draw order.gltf there.pfm
draw swapped.gltf made.pfm
cmp there.pfm made.pfm || fail "the order of materials matters"
# Lights of any units do not leave the image white or black, unless an exposure is given; models without any are as they are.
small="--width 16 --height 12 --spp 4 -q"
"$aureole" render lit.gltf $small -o chosen.png && "$aureole" render lit.gltf $small --exposure auto -o auto.png && "$aureole" render lit.gltf $small --exposure 0 -o zero.png &&
  cmp chosen.png auto.png || fail "a bright light leaves the image white"
sed 's/"intensity": 20000/"intensity": 0.0002/' lit.gltf >dim.gltf
"$aureole" render dim.gltf $small -o dim.png && "$aureole" render dim.gltf $small --exposure auto -o auto.png && cmp dim.png auto.png || fail "a dim light leaves the image black"
cmp -s chosen.png zero.png && fail "--exposure 0 is not kept"
"$aureole" render blue.gltf $small -o chosen.png && "$aureole" render blue.gltf $small --exposure 0 -o zero.png && cmp chosen.png zero.png || fail "a model without lights has another exposure"
# noted WORDS MODEL [OPTION...]: a warning, and a render
noted() {
  "$aureole" render "$2" "${@:3}" --width 4 --height 3 --spp 1 -o no.exr >said 2>&1 && grep -q "warning: $2: $1" said || fail "no warning '$1': $(cat said)"
}
# refused WORDS MODEL [OPTION...]
refused() {
  "$aureole" render "$2" "${@:3}" --width 4 --height 3 --spp 1 -o no.exr >said 2>&1
  [ $? = 2 ] && grep -q "$1" said || fail "not refused with '$1': $(cat said)"
}
refused "unknown variant 'sea': it has 'night', 'deep sea'" variants.gltf --variant sea
refused "compressed by meshopt (EXT_meshopt_compression)" odd-meshopt.gltf
refused "only points and lines" odd-points.gltf
noted "the first of 3 cameras is used" eyes.gltf
noted "it has no variants" blue.gltf --variant sea
noted "1 of 2 primitives are points or lines" odd-lines.gltf
noted "the model requires the extension 'VENDOR_thing'" odd-unknown.gltf
noted "1 textures are WebP images" odd-EXT_texture_webp.gltf
noted "1 textures are KTX2 images" odd-KHR_texture_basisu.gltf
noted "iridescence (KHR_materials_iridescence) is not supported" odd-film.gltf
noted "textures of extensions are ignored: clearcoatNormalTexture" odd-coat.gltf
exit 0

#!/usr/bin/env python3
"""The analytical lighting cases with Radiance, Mitsuba 3, Cycles and Aureole: errors against the references, and CPU seconds.

    python3 -m venv /tmp/radiance && /tmp/radiance/bin/pip install pyradiance      # likewise for mitsuba and bpy
    python3 bench/peers/cases.py build/release/aureole --radiance /tmp/radiance/bin/python --mitsuba /tmp/mitsuba/bin/python \\
        --cycles /tmp/bpy/bin/python [--quick]

`aureole lab run analytical-cases` writes the scene and points of each case. This script writes the same scene for each tool and
computes the irradiances: Radiance with rtrace -I, Mitsuba with path-traced images of a white patch of a millimeter at each point,
Cycles by baking light into the corners of such patches. Errors are relative to the case's largest value. Tools without an option
are skipped; a dash marks a case that a tool cannot represent.
"""
import argparse
import csv
import fnmatch
import glob
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

HALF = 5e-4  # half the side of a patch
# Table 1 of ISO 15469, type by type: a, b, c, d, e.
CIE = [(4, -.7, 0, -1, 0), (4, -.7, 2, -1.5, .15), (1.1, -.8, 0, -1, 0), (1.1, -.8, 2, -1.5, .15), (0, -1, 0, -1, 0),
       (0, -1, 2, -1.5, .15), (0, -1, 5, -2.5, .3), (0, -1, 10, -3, .45), (-1, -.55, 2, -1.5, .15), (-1, -.55, 5, -2.5, .3),
       (-1, -.55, 10, -3, .45), (-1, -.32, 10, -3, .45), (-1, -.32, 16, -3, .3), (-1, -.15, 16, -3, .3), (-1, -.15, 24, -2.8, .15)]


# --- scenes

def value(node, name, default=None):
    for child in node:
        if child.get("name") == name:
            if child.tag in ("vector", "point") and child.get("value") is None:
                return [float(child.get(axis, 0)) for axis in "xyz"]
            return child.get("value")
    return default


def read_scene(path):
    """Shapes (kind, numbers, reflectance, radiance, glass) and emitters (type, XML node)."""
    shapes, emitters = [], []
    for node in ElementTree.parse(path).getroot():
        if node.tag == "emitter":
            emitters.append((node.get("type"), node))
            continue
        shape = {"kind": node.get("type"), "reflectance": 0.5, "radiance": 0.0, "glass": None, "two_sided": False,
                 "flip": value(node, "flip_normals") == "true", "center": value(node, "center", [0.0, 0.0, 0.0]),
                 "radius": float(value(node, "radius", 1)), "turned": False}
        for child in node.iter():
            if child.tag == "bsdf" and child.get("type") == "diffuse":
                shape["reflectance"] = float(value(child, "reflectance"))
            elif child.tag == "bsdf" and child.get("type") == "glass":
                shape["glass"] = float(value(child, "transmissivity", 1)), float(value(child, "int_ior"))
            elif child.tag == "bsdf":
                shape["two_sided"] = True
            elif child.tag == "emitter":
                shape["radiance"] = float(value(child, "radiance", 1))
            elif child.tag == "scale":
                shape["radius"] *= float(child.get("value"))
            elif child.tag == "rotate":
                shape["turned"] = True
            elif child.tag == "translate":
                shape["center"] = [float(child.get(axis, 0)) for axis in "xyz"]
        if shape["kind"] == "polygon":
            numbers = [float(word) for word in value(node, "vertices").split()]
            shape["corners"] = [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
        shapes.append(shape)
    return shapes, emitters


def read_points(path):
    with open(path) as rows:
        return [{key: float(number) for key, number in row.items()} for row in csv.DictReader(rows)]


def polygons(corners):
    """Splits into convex parts. The polygon with a hole has an explicit seam: the outer corners, then the inner ones."""
    if len(corners) == 4:
        return [corners]
    outer, inner = corners[:4], corners[5:9]
    nearest = [min(range(4), key=lambda k: math.dist(inner[k], o)) for o in outer]
    return [[outer[i], outer[(i + 1) % 4], inner[nearest[(i + 1) % 4]], inner[nearest[i]]] for i in range(4)]


def sky_formula(node):
    """(a, b, c, d, e, sun, scale) of radiance scale (1 + a exp(b / cos z)) (1 + c (exp(d x) - exp(d pi/2)) + e cos^2 x)."""
    model = value(node, "model")
    if model == "uniform":
        return None
    if model == "cie-overcast":
        return "overcast"
    a, b, c, d, e = CIE[int(value(node, "cie_type")) - 1]
    sun = value(node, "sun_direction")
    total, steps = 0.0, 400
    for i in range(steps):  # the midpoint rule about the zenith, in the squared sine
        z = math.sqrt(1 - (i + .5) / steps)
        for k in range(steps):
            azimuth = math.pi * (k + .5) / steps
            total += relative((a, b, c, d, e, sun), (math.cos(azimuth) * math.sqrt(1 - z * z), 0, z)) / steps ** 2 * math.pi
    return a, b, c, d, e, sun, float(value(node, "irradiance")) / total


def relative(sky, direction):
    a, b, c, d, e, sun = sky[:6]
    cosine = max(-1.0, min(1.0, sum(x * y for x, y in zip(direction, sun))))
    angle = math.acos(cosine)
    return (1 + a * math.exp(b / max(direction[2], 1e-6))) * (
        1 + c * (math.exp(d * angle) - math.exp(d * math.pi / 2)) + e * cosine * cosine)


def sky_image(node, width=2048):
    """Rows from the zenith to the nadir, columns by azimuth from +x towards +y: NumPy, float32. Black below the horizon."""
    import numpy as np
    height = width // 2
    polar = (np.arange(height) + .5) / height * math.pi
    azimuth = (np.arange(width) + .5) / width * 2 * math.pi
    z = np.cos(polar)[:, None] + 0 * azimuth[None]
    sky = sky_formula(node)
    if sky is None:
        light = np.ones_like(z)
    elif sky == "overcast":
        light = (1 + 2 * z) / 3
    else:
        a, b, c, d, e, sun, scale = sky
        x = np.sin(polar)[:, None] * np.cos(azimuth)[None]
        cosine = np.clip(x * sun[0] + z * sun[2], -1, 1)
        light = scale * (1 + a * np.exp(b / np.maximum(z, 1e-6))) * (
            1 + c * (np.exp(d * np.arccos(cosine)) - math.exp(d * math.pi / 2)) + e * cosine ** 2)
    return np.where(z > 0, light, 0).astype(np.float32)


# --- tools: each yields the irradiances of a case, or None

def radiance(shapes, emitters, points, samples, folder):
    import pyradiance
    tools = os.path.join(os.path.dirname(pyradiance.__file__), "bin")
    os.environ["RAYPATH"] = ".:" + os.path.join(os.path.dirname(pyradiance.__file__), "lib")
    text = ""
    for i, shape in enumerate(shapes):
        r = shape["reflectance"]
        if shape["radiance"] > 0 and r > 0 and shape["kind"] in ("sphere", "cube"):
            return None  # its light sources do not reflect
        if shape["glass"]:
            text += f"void glass m{i} 0 0 4 {shape['glass'][0]} {shape['glass'][0]} {shape['glass'][0]} {shape['glass'][1]}\n"
        elif shape["radiance"] > 0:
            text += f"void light m{i} 0 0 3 {shape['radiance']} {shape['radiance']} {shape['radiance']}\n"
        else:
            text += f"void plastic m{i} 0 0 5 {r} {r} {r} 0 0\n"
        if shape["kind"] == "polygon":
            numbers = " ".join(f"{x:.12g}" for corner in shape["corners"] for x in corner)
            text += f"m{i} polygon s{i} 0 0 {3 * len(shape['corners'])} {numbers}\n"
        elif shape["kind"] == "disk":
            c = shape["center"]
            text += f"m{i} ring s{i} 0 0 8 {c[0]} {c[1]} {c[2]} 0 0 {-1 if shape['turned'] else 1} 0 {shape['radius']}\n"
        elif shape["kind"] == "sphere":
            c = shape["center"]
            text += f"m{i} {'bubble' if shape['flip'] else 'sphere'} s{i} 0 0 4 {c[0]} {c[1]} {c[2]} {shape['radius']}\n"
        else:
            return None
    for kind, node in emitters:
        if kind == "point":  # not supported: a small sphere
            p, r = value(node, "position", [0.0, 0.0, 0.0]), 1e-3
            text += f"void light lamp 0 0 3" + f" {float(value(node, 'intensity')) / (math.pi * r * r):.9g}" * 3 + "\n"
            text += f"lamp sphere bulb 0 0 4 {p[0]} {p[1]} {p[2]} {r}\n"
        elif kind in ("directional", "sun"):
            half = math.radians(float(value(node, "half_angle", .01)))
            way = value(node, "sun_direction") or [-x for x in value(node, "direction")]
            power = float(value(node, "irradiance")) / (math.pi * math.sin(half) ** 2)
            text += "void light sun 0 0 3" + f" {power:.9g}" * 3 + "\n"
            text += f"sun source disk 0 0 4 {way[0]} {way[1]} {way[2]} {2 * math.degrees(half)}\n"
        elif kind == "sky":
            sky = sky_formula(node)
            if sky is None:
                formula = "1"
            elif sky == "overcast":
                formula = "(1+2*Dz)/3"
            else:
                a, b, c, d, e, sun, scale = sky
                chi = f"(Dx*{sun[0]:.12g}+Dz*{sun[2]:.12g})"
                formula = (f"{scale:.12g}*(1+{a}*exp({b}/if(Dz-1e-6,Dz,1e-6)))*(1+{c}*(exp({d}*Acos({chi}))-{math.exp(d * math.pi / 2):.12g})"
                           f"+{e}*{chi}*{chi})").replace("Acos", "acos")
            with open("sky.cal", "w") as file:
                file.write(f"light = {formula};\n".replace("+-", "-"))
            text += ("void brightfunc f 2 light sky.cal 0 0\nf glow glow 0 0 4 1 1 1 0\nglow source dome 0 0 4 0 0 1 180\n")
    with open("case.rad", "w") as file:
        file.write(text)
    with open("case.oct", "wb") as file:
        subprocess.run([f"{tools}/oconv", "case.rad"], stdout=file, check=True)
    lines = "".join("{x} {y} {z} {nx} {ny} {nz}\n".format(**p) for p in points)
    options = f"-ab 8 -ad {samples} -as 0 -aa 0 -lw 1e-6 -ds .02 -dj 0 -dc 1 -dt 0".split()
    out = subprocess.run([f"{tools}/rtrace", "-I", "-h", "-w", *options, "case.oct"], input=lines, capture_output=True, text=True,
                         check=True).stdout
    return [float(line.split()[0]) for line in out.split("\n") if line]


def frame(point):
    n = [point["nx"], point["ny"], point["nz"]]
    other = [1.0, 0.0, 0.0] if abs(n[0]) < .6 else [0.0, 1.0, 0.0]
    x = [n[1] * other[2] - n[2] * other[1], n[2] * other[0] - n[0] * other[2], n[0] * other[1] - n[1] * other[0]]
    length = math.hypot(*x)
    x = [c / length for c in x]
    y = [n[1] * x[2] - n[2] * x[1], n[2] * x[0] - n[0] * x[2], n[0] * x[1] - n[1] * x[0]]
    return n, x, y


def mitsuba(shapes, emitters, points, samples, folder):
    import mitsuba as mi
    if mi.variant() is None:
        mi.set_variant("scalar_rgb")
    from mitsuba import ScalarTransform4f as T
    gray = lambda r: {"type": "rgb", "value": r}
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": 65, "rr_depth": 65}}
    for i, shape in enumerate(shapes):
        made = {"bsdf": {"type": "diffuse", "reflectance": gray(shape["reflectance"])}}
        if shape["two_sided"]:
            made["bsdf"] = {"type": "twosided", "inside": made["bsdf"]}
        if shape["glass"]:
            if shape["glass"][0] != 1:
                return None  # no absorption in a pane
            made["bsdf"] = {"type": "thindielectric", "int_ior": shape["glass"][1], "ext_ior": 1.0}
        if shape["radiance"] > 0:
            made["light"] = {"type": "area", "radiance": gray(shape["radiance"])}
        if shape["kind"] == "polygon":
            for k, corners in enumerate(polygons(shape["corners"])):
                path = os.path.join(folder, f"p{i}-{k}.obj")
                with open(path, "w") as file:
                    file.write("".join("v {:.12g} {:.12g} {:.12g}\n".format(*c) for c in corners) + "f 1 2 3\nf 1 3 4\n")
                scene[f"s{i}-{k}"] = {**made, "type": "obj", "filename": path, "face_normals": True}
            continue
        to_world = T().translate(shape["center"])
        if shape["turned"]:
            to_world = to_world @ T().rotate([1, 0, 0], 180)
        scene[f"s{i}"] = {**made, "type": shape["kind"], "to_world": to_world @ T().scale(shape["radius"])}
        if shape["kind"] in ("sphere", "cube"):
            scene[f"s{i}"]["flip_normals"] = shape["flip"]
    for i, (kind, node) in enumerate(emitters):
        if kind == "point":
            scene[f"e{i}"] = {"type": "point", "intensity": gray(float(value(node, "intensity"))),
                              "position": value(node, "position", [0.0, 0.0, 0.0])}
        elif kind == "directional":
            scene[f"e{i}"] = {"type": "directional", "direction": value(node, "direction"),
                              "irradiance": gray(float(value(node, "irradiance")))}
        elif kind == "sun":  # a distant disk, centered on the point common to all receivers of these cases
            half, way, far = math.radians(float(value(node, "half_angle"))), value(node, "sun_direction"), 1000.0
            at = [points[0][axis] for axis in "xyz"]
            center = [a + far * w for a, w in zip(at, way)]
            scene[f"e{i}"] = {"type": "disk", "to_world": T().look_at(origin=center, target=at, up=[0, 1, 0]) @ T().scale(far * math.tan(half)),
                              "light": {"type": "area", "radiance": gray(float(value(node, "irradiance")) / (math.pi * math.sin(half) ** 2))}}
        else:
            import numpy as np
            pixels_rgb = np.repeat(sky_image(node)[:, ::-1, None], 3, axis=2)
            # Its columns run in the opposite direction around the pole, starting at -z.
            scene[f"e{i}"] = {"type": "envmap", "bitmap": mi.Bitmap(np.ascontiguousarray(pixels_rgb)),
                              "to_world": T().rotate([0, 0, 1], -90) @ T().rotate([1, 0, 0], 90)}
    white = {"type": "diffuse", "reflectance": gray(0.5)}
    for i, point in enumerate(points):
        n, x, y = frame(point)
        at = [point[axis] for axis in "xyz"]
        scene[f"patch{i}"] = {"type": "rectangle", "bsdf": white,
                              "to_world": T().look_at(origin=at, target=[a + b for a, b in zip(at, n)], up=y) @ T().scale(HALF)}
        scene[f"sensor{i}"] = {"type": "orthographic", "near_clip": 1e-6, "far_clip": 1.0,
                               "to_world": T().look_at(origin=[a + 5e-5 * b for a, b in zip(at, n)], target=at, up=y) @ T().scale(.5 * HALF),
                               "film": {"type": "hdrfilm", "width": 4, "height": 4, "rfilter": {"type": "box"}},
                               "sampler": {"type": "multijitter", "sample_count": max(samples // 16, 4)}}
    made = mi.load_dict(scene)
    found = []
    for i in range(len(points)):
        import numpy as np
        found.append(float(np.array(mi.render(made, sensor=i, seed=i)).mean()) * math.pi / 0.5)
    return found


def cycles(shapes, emitters, points, samples, folder):
    import bpy
    import numpy as np
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples // 4  # per corner
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    for name in ("max_bounces", "diffuse_bounces", "transmission_bounces", "transparent_max_bounces"):
        setattr(scene.cycles, name, 64)
    scene.cycles.sample_clamp_indirect = 0

    def material(reflectance, emission):
        made = bpy.data.materials.new("m")
        made.use_nodes = True
        tree = made.node_tree
        tree.nodes.clear()
        out, shader = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = (reflectance,) * 3 + (1,)
        if emission > 0:  # from the front only, like the other tools
            light, add = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeAddShader")
            side, mix = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeMixShader")
            light.inputs["Strength"].default_value = emission
            tree.links.new(side.outputs["Backfacing"], mix.inputs[0])
            tree.links.new(light.outputs[0], mix.inputs[1])
            tree.links.new(mix.outputs[0], add.inputs[0])
            tree.links.new(shader.outputs[0], add.inputs[1])
            shader = add
        tree.links.new(shader.outputs[0], out.inputs[0])
        return made

    def mesh(name, corners, faces, made):
        data = bpy.data.meshes.new(name)
        data.from_pydata(corners, [], faces)
        data.materials.append(made)
        item = bpy.data.objects.new(name, data)
        scene.collection.objects.link(item)
        return item

    for shape in shapes:
        if shape["glass"]:
            return None  # it has no thin glass panes
        made = material(shape["reflectance"], shape["radiance"])
        c, r = shape["center"], shape["radius"]
        if shape["kind"] == "polygon":
            for corners in polygons(shape["corners"]):
                mesh("polygon", corners, [(0, 1, 2, 3)], made)
        elif shape["kind"] == "disk":
            n = 512  # samples of the disk
            wide = r * math.sqrt(2 * math.pi / n / math.sin(2 * math.pi / n))
            rim = [(c[0] + wide * math.cos(2 * math.pi * k / n), c[1] + wide * math.sin(2 * math.pi * k / n), c[2]) for k in range(n)]
            mesh("disk", rim, [tuple(range(n))[::-1] if shape["turned"] else tuple(range(n))], made)
        elif shape["kind"] == "cube":
            corner = [[(-1, 1)[k >> d & 1] for d in range(3)] for k in range(8)]
            faces = [(0, 4, 6, 2), (0, 1, 5, 4), (0, 2, 3, 1), (1, 3, 7, 5), (2, 6, 7, 3), (4, 5, 7, 6)]
            mesh("cube", corner, [f[::-1] if shape["flip"] else f for f in faces], made)
        else:
            rows, columns = 256, 512
            corner = [(c[0] + r * math.sin(math.pi * i / rows) * math.cos(2 * math.pi * k / columns),
                       c[1] + r * math.sin(math.pi * i / rows) * math.sin(2 * math.pi * k / columns),
                       c[2] + r * math.cos(math.pi * i / rows)) for i in range(rows + 1) for k in range(columns)]
            faces = [(i * columns + k, (i + 1) * columns + k, (i + 1) * columns + (k + 1) % columns, i * columns + (k + 1) % columns)
                     for i in range(rows) for k in range(columns)]
            mesh("sphere", corner, [f[::-1] if shape["flip"] else f for f in faces], made)
    world = bpy.data.worlds.new("w")
    scene.world = world
    world.use_nodes = True
    back = world.node_tree.nodes["Background"]
    back.inputs["Strength"].default_value = 0
    for kind, node in emitters:
        if kind == "sky":
            pixels_rgb = np.ones((1024, 2048, 4), np.float32)
            # Rows from below; azimuth 0 (+x) is in the middle, and grows to the left.
            pixels_rgb[:, :, :3] = np.roll(sky_image(node)[::-1, ::-1], 1024, axis=1)[:, :, None]
            image = bpy.data.images.new("sky", 2048, 1024, float_buffer=True)
            image.colorspace_settings.name = "Non-Color"
            image.pixels.foreach_set(pixels_rgb.ravel())
            image.update()
            texture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
            texture.image = image
            world.node_tree.links.new(texture.outputs[0], back.inputs["Color"])
            back.inputs["Strength"].default_value = 1
            continue
        light = bpy.data.lights.new("l", "POINT" if kind == "point" else "SUN")
        item = bpy.data.objects.new("l", light)
        scene.collection.objects.link(item)
        if kind == "point":
            light.energy, light.shadow_soft_size = 4 * math.pi * float(value(node, "intensity")), 0
            item.location = value(node, "position", [0.0, 0.0, 0.0])
        else:
            import mathutils
            way = value(node, "sun_direction") or [-x for x in value(node, "direction")]
            light.energy, light.angle = float(value(node, "irradiance")), 2 * math.radians(float(value(node, "half_angle", 0)))
            item.rotation_euler = mathutils.Vector(way).to_track_quat("Z", "Y").to_euler()
    corners, faces = [], []
    for i, point in enumerate(points):
        n, x, y = frame(point)
        at = [point[axis] for axis in "xyz"]
        corners += [[a + HALF * (s * u + t * v) for a, u, v in zip(at, x, y)] for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        faces.append((4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3))
    item = mesh("patches", corners, faces, material(0.5, 0))
    light = item.data.color_attributes.new("light", "FLOAT_COLOR", "POINT")
    item.data.color_attributes.active_color = light
    bpy.context.view_layer.objects.active = item
    item.select_set(True)
    bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"}, target="VERTEX_COLORS")
    found = np.zeros(4 * len(corners), np.float32)
    light.data.foreach_get("color", found)
    return [float(x) * math.pi for x in found.reshape(-1, 4, 4)[:, :, 0].mean(axis=1)]


TOOLS = {"radiance": radiance, "mitsuba": mitsuba, "cycles": cycles}


def child(tool, folder, samples, only):
    """Runs in the tool's interpreter: prints a line of JSON per case."""
    out = os.dup(1)
    os.dup2(2, 1)  # output of the tools
    for path in sorted(glob.glob(os.path.join(folder, "analytical-cases-*.xml"))):
        name = os.path.basename(path)[len("analytical-cases-"):-len(".xml")]
        if not fnmatch.fnmatch(name, only):
            continue
        points = read_points(path[:-len("xml")] + "csv")
        used = lambda: sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
        with tempfile.TemporaryDirectory() as scratch:
            os.chdir(scratch)
            begin = used()
            found, waiting = [None] * len(points), list(range(len(points)))
            while waiting:  # patches at one position would occlude each other
                batch = []
                for i in waiting:
                    if all(math.dist(*([points[k][axis] for axis in "xyz"] for k in (i, j))) > 8 * HALF for j in batch):
                        batch.append(i)
                some = TOOLS[tool](*read_scene(path), [points[i] for i in batch], samples, scratch)
                if some is None:
                    found = None
                    break
                for i, number in zip(batch, some):
                    found[i] = number
                waiting = [i for i in waiting if i not in batch]
            os.write(out, (json.dumps([name, found, used() - begin]) + "\n").encode())
            os.chdir("/")


def errors(points, found):
    largest = max(abs(p["closed"]) for p in points)
    off = [abs(f - p["closed"]) / largest for p, f in zip(points, found)]
    return 100 * max(off), 100 * sum(off) / len(off)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    for tool in TOOLS:
        options.add_argument(f"--{tool}", metavar="PYTHON")
    options.add_argument("--samples", type=int, default=65536, help="of each tool and point")
    options.add_argument("--only", metavar="PATTERN", default="*", help="the cases whose names match, such as 'cie-sky-[2-9]'")
    options.add_argument("--quick", action="store_true", help="a sixteenth of all")
    options.add_argument("--child", nargs=2, metavar=("TOOL", "FOLDER"), help=argparse.SUPPRESS)
    given = options.parse_args()
    samples = given.samples // (16 if given.quick else 1)
    if given.child:
        return child(*given.child, samples, given.only)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([given.program, "lab", "run", "analytical-cases", "-q", "-o", folder, *(["--quick"] if given.quick else [])],
                       check=True, stdout=subprocess.DEVNULL)
        folder = os.path.join(folder, "analytical-cases")
        with open(os.path.join(folder, "analytical-cases.csv")) as rows:
            cases = {row["case"]: row for row in csv.DictReader(line for line in rows if not line.startswith("#"))}
        with open(os.path.join(folder, "analytical-cases-timings.csv")) as rows:
            own_seconds = {row["what"]: float(row["cpu_seconds"]) for row in csv.DictReader(rows)}
        results = {}
        for tool in TOOLS:
            python = getattr(given, tool)
            if python:
                out = subprocess.run([python, os.path.abspath(__file__), given.program, "--samples", str(samples), "--only", given.only, "--child", tool, folder],
                                     stdout=subprocess.PIPE, stderr=None if os.environ.get("VERBOSE") else subprocess.DEVNULL, text=True)
                for line in out.stdout.splitlines():
                    name, found, seconds = json.loads(line)
                    results[tool, name] = found, seconds
                if out.returncode:
                    print(f"{tool} ended with status {out.returncode}; set VERBOSE=1 to see what it says", file=sys.stderr)
        named = [tool for tool in TOOLS if getattr(given, tool)]
        print("| case | " + " | ".join(f"{tool}: worst, mean % | CPU s" for tool in ["aureole"] + named) + " |")
        print("|---" * (3 + 2 * len(named)) + "|")
        for name in fnmatch.filter(cases, given.only):
            points = read_points(os.path.join(folder, f"analytical-cases-{name}.csv"))
            cells = ["{:.3f}, {:.3f} | {:.1f}".format(*errors(points, [p["value"] for p in points]), own_seconds[name])]
            for tool in named:
                found, seconds = results.get((tool, name), (None, 0))
                cells.append("{:.3f}, {:.3f} | {:.1f}".format(*errors(points, found), seconds) if found else "- | -")
            print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Positions, texture coordinates, normals and tangents of every shape with every kind of transform, compared with Mitsuba 3
(needs `pip install mitsuba`).

    frames.py PROGRAM [--only TEXT] [--all]

Each case is a shape with `to_world` and `flip_normals`, by itself or in a rotated instance. The program renders it with one sample
per pixel from several sides, with the channels `position`, `uv`, `geo_normal` and `sh_normal`. Mitsuba traces rays
to the same positions. Tangents are tested through materials under one directional light: `roughconductor` with two roughnesses (the
direction of the first tangent) and `bumpmap` (the lengths and the angle of both). The radiance is compared with
Mitsuba's BSDF value. The table has the largest differences of a case: of distances, relative to the size of the shape; of texture
coordinates; of normals (except for the sign if something is mirrored, since Mitsuba turns such shapes inside out); of the radiance,
relative to the largest. Cases without a difference above 5e-3 (a slope jumps between texels) are only counted (--all prints them).
The radiance of curves is excluded where Mitsuba has no tangent (`linearcurve`) or one that contradicts finite differences
(`bsplinecurve`).
"""
import argparse
import itertools
import os
import subprocess
import sys
import tempfile

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)
LIMIT, SIZE = 5e-3, 12
HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "plugins")

SHAPES = {
    "rectangle": "", "cube": "", "disk": "", "sphere": "", "cylinder": "",
    "sphere of keys": '<point name="center" x=".1" y="-.2" z=".3"/><float name="radius" value=".7"/>',
    "cylinder of keys": '<point name="p0" x=".5" y="-.6" z=".2"/><point name="p1" x="-.3" y=".5" z="-.4"/>'
                        '<float name="radius" value=".6"/>',
    "cylinder downwards": '<point name="p0" x="0" y="0" z="1"/><point name="p1" x="0" y="0" z="-1"/>',
    "bsplinecurve": '<string name="filename" value="tube.txt"/>', "linearcurve": '<string name="filename" value="tube.txt"/>',
    "obj": f'<string name="filename" value="{HERE}/wave.obj"/>',
    "serialized": f'<string name="filename" value="{HERE}/wave.serialized"/>',
    "ply": '<string name="filename" value="fan.ply"/>',
    "obj of faces": f'<string name="filename" value="{HERE}/wave.obj"/><boolean name="face_normals" value="true"/>',
}
TUBE = "-.9 -.8 .3 .3\n-.3 -.3 -.2 .25\n.2 .1 .1 .2\n.5 .5 .4 .25\n.7 .9 -.3 .3\n"
# Shading normals that differ from the triangles' normals, and sheared texture coordinates.
FAN = ("ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
       "property float ny\nproperty float nz\nproperty float u\nproperty float v\nelement face 4\n"
       "property list uchar int vertex_index\nend_header\n-1 -1 0 -.3 -.3 .9 0 .1\n1 -1 0 .3 -.3 .9 1 .3\n1 1 .2 .3 .3 .9 .8 1\n"
       "-1 1 0 -.3 .3 .9 .1 .8\n0 0 .5 0 0 1 .4 .5\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n")
TRANSFORMS = {
    "none": "", "turned about z": '<rotate z="1" angle="77"/>', "turned twice": '<rotate x="1" angle="50"/><rotate y="1" angle="20"/>',
    "turned by 180": '<rotate y="1" angle="180"/>', "mirrored": '<scale x="-1"/>',
    "mirrored in z, turned": '<scale z="-1"/><rotate x=".6" y="-.64" z=".48" angle="130"/>',
    "moved, scaled": '<scale value="1.7"/><rotate x=".6" z=".8" angle="211"/><translate x=".2" y="-.1" z=".3"/>',
    "stretched along z": '<scale z="1.6"/><rotate x=".6" y=".8" angle="40"/>',
    "stretched": '<scale x="1.3" y=".7" z="1.1"/><rotate y="1" angle="35"/>',
    "sheared": '<matrix value="1 .4 0 0  0 1 .2 0  .3 0 1 0  0 0 0 1"/>',
    "sheared, mirrored": '<matrix value="-1 .4 0 0  0 1 .2 0  .3 0 1 0  0 0 0 1"/><rotate z="1" angle="20"/>',
}
INSTANCE = '<transform name="to_world"><rotate x=".6" y=".8" angle="65"/><scale x=".9" y="-1.1" z=".8"/></transform>'
MATERIALS = {
    "two roughnesses": '<bsdf type="twosided" id="m"><bsdf type="roughconductor"><string name="distribution" value="ggx"/>'
                       '<float name="alpha_u" value=".25"/><float name="alpha_v" value=".7"/></bsdf></bsdf>',
    "bumps": '<bsdf type="twosided" id="m"><bsdf type="bumpmap"><texture type="bitmap" name="arbitrary">'
             '<string name="filename" value="heights.exr"/><boolean name="raw" value="true"/></texture>'
             '<float name="scale" value=".1"/><bsdf type="roughconductor"><float name="alpha" value=".4"/></bsdf></bsdf></bsdf>',
}
VIEWS = [np.array(v) for v in ((3.1, 2.2, 4.3), (-4.4, 1.2, -2.9))]


def scene_text(shape, transform, flip, instance, material, view):
    body = SHAPES[shape]
    kind = shape.split()[0]
    turn = f'<transform name="to_world">{TRANSFORMS[transform]}</transform>' if TRANSFORMS[transform] else ""
    flips = '<boolean name="flip_normals" value="true"/>' if flip else ""
    text = f'<shape type="{kind}">{body}{turn}{flips}<ref id="m"/></shape>'
    if instance:
        text = (f'<shape type="shapegroup" id="g">{text}</shape><shape type="instance"><ref id="g"/>{INSTANCE}</shape>')
    light = -view + np.array([1.1, -.4, .3])
    origin, way = ", ".join(map(str, view)), " ".join(f'{c}="{v}"' for c, v in zip("xyz", light))
    return (f'<scene version="3.0.0"><integrator type="aov"><string name="aovs" value="a:position,b:uv,c:geo_normal,d:sh_normal"/>'
            f'<integrator type="direct"/></integrator>{MATERIALS[material]}{text}<emitter type="directional"><vector '
            f'name="direction" {way}/><rgb name="irradiance" value="1"/></emitter><sensor type="perspective"><float name="fov" value="32"/>'
            f'<transform name="to_world"><lookat origin="{origin}" target="0, 0, 0" up="0, 1, 0"/></transform><sampler '
            f'type="independent"><integer name="sample_count" value="1"/></sampler><film type="hdrfilm"><integer name="width" '
            f'value="{SIZE}"/><integer name="height" value="{SIZE}"/><rfilter type="box"/></film></sensor></scene>'), light


def compare(options, case, folder, view):
    """The largest differences, or the error message of either program."""
    text, light = scene_text(*case, view)
    with open(path := os.path.join(folder, "frames.xml"), "w", encoding="utf-8") as file:
        file.write(text)
    run = subprocess.run([options.program, "render", path, "-q", "-o", out := os.path.join(folder, "frames.exr")],
                         capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return run.stderr.strip().splitlines()[0].split("error: ")[-1]
    bitmap = mi.Bitmap(out)
    names = [bitmap.struct_()[i].name for i in range(bitmap.channel_count())]
    pixels = np.array(bitmap, dtype=np.float64).reshape(-1, bitmap.channel_count())
    take = lambda *requested: pixels[:, [names.index(name) for name in requested]]
    try:
        scene = mi.load_file(path)
    except RuntimeError as error:
        return "Mitsuba: " + str(error).strip().splitlines()[-1]
    extent = max(scene.bbox().extents())
    light = mi.Vector3f(list(-light / np.linalg.norm(light)))
    found, radiances = [], []
    columns = take("R"), take("a.X", "a.Y", "a.Z"), take("b.U", "b.V"), take("c.X", "c.Y", "c.Z"), take("d.X", "d.Y", "d.Z")
    for radiance, position, uv, geometric, shading in zip(*columns):
        if not geometric.any():
            continue
        way = position - view
        distance = np.linalg.norm(way)
        hit = scene.ray_intersect(mi.Ray3f(mi.Point3f(list(view)), mi.Vector3f(list(way / distance))))
        if not hit.is_valid() or abs(hit.t - distance) > 1e-3 * extent:
            continue  # grazed an edge
        wrapped = np.abs(uv - np.array(hit.uv))
        normal, smooth = np.array(hit.n), np.array(hit.sh_frame.n)
        value = hit.bsdf().eval(mi.BSDFContext(), hit, hit.to_local(light))[0]
        sides = [(normal @ way) * (smooth @ way), (normal @ np.array(light)) * (smooth @ np.array(light))]
        # In shadow, or the light or the camera is on different sides of geometric and shading normal.
        if min(sides) <= 0 or scene.ray_test(hit.spawn_ray(light)):
            value = radiance[0]
        if "mirrored" in case[1] or case[3]:  # Mitsuba turns some mirrored shapes inside out
            normal *= np.sign(normal @ geometric)
            smooth *= np.sign(smooth @ shading)
        if case[0] == "linearcurve" or (case[0] == "bsplinecurve" and case[4] == "bumps"):
            value = radiance[0]
        radiances.append(value)
        found.append((abs(hit.t - distance) / extent, np.minimum(wrapped, np.abs(1 - wrapped)).max(),
                      np.abs(geometric - normal).max(), np.abs(shading - smooth).max(),
                      abs(value - radiance[0])))
    if len(found) < 3:
        return f"only {len(found)} pixels meet it"
    worst = np.array(found).max(axis=0)
    worst[4] /= max(max(radiances), 1e-9)
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--only", default="")
    parser.add_argument("--all", action="store_true")
    options = parser.parse_args()
    counts = {"alike": 0, "differ": 0, "refused": 0}
    print(f"| case (Mitsuba {mi.__version__}) | distance | uv | normal | shading normal | radiance |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("tube.txt", TUBE), ("fan.ply", FAN)):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        x, y = np.meshgrid(np.arange(32), np.arange(32))
        heights = np.sin(2 * np.pi * x / 32) + np.cos(2 * np.pi * y / 16)
        mi.Bitmap((heights[..., None] + 2).astype(np.float32)).write(os.path.join(folder, "heights.exr"))
        for case in itertools.product(SHAPES, TRANSFORMS, (False, True), (False, True), MATERIALS):
            name = ", ".join([case[0], case[1]] + ["flipped"] * case[2] + ["instance"] * case[3] + [case[4]])
            if options.only not in name or (case[2] and "curve" in case[0]):
                continue
            results = [compare(options, case, folder, view) for view in VIEWS]
            messages = [result for result in results if isinstance(result, str)]
            worst = np.max([result for result in results if not isinstance(result, str)] or [[0]], axis=0)
            kind = "differ" if worst.max() > LIMIT else "refused" if messages else "alike"
            counts[kind] += 1
            if kind == "differ" or options.all:
                print(f"| {name} | " + " | ".join(f"{value:.1e}" for value in worst) + f" | {messages[0] if messages else ''}", flush=True)
            elif kind == "refused":
                print(f"| {name} | {messages[0]} |", flush=True)
    print(", ".join(f"{count} {kind}" for kind, count in counts.items()))
    sys.exit(0 if counts["differ"] == 0 else 1)


if __name__ == "__main__":
    main()

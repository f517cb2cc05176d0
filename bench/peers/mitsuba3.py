#!/usr/bin/env python3
"""Renders the same scenes with Aureole and with Mitsuba 3 and tests the difference against the noise.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install 'mitsuba==3.*'
    /tmp/peers/bin/python bench/peers/mitsuba3.py build/release/aureole [--only TEXT] [SCENE.xml...] >docs/mitsuba.md

SCENE.xml are further scenes, which both render with `path` and independent samples, at most SIZE pixels wide; one that
Mitsuba cannot load is reported. Each scene is rendered by both with SEEDS seeds. Means over BLOCKS x BLOCKS blocks and
three channels give a Welch t each; the largest |t| is judged by a Sidak correction over all blocks at a significance level of 0.1 % per
scene (Student's t of the seeds' degrees of freedom). The table also has the difference of the means of the whole images,
with its 95 % interval. The exit status is 1 if a scene differs unexpectedly.
"""
import math
import os
import re
import subprocess
import sys
import tempfile

import mitsuba as mi
import numpy as np

import mitsuba_scene

mi.set_variant("scalar_rgb")
SEEDS, BLOCKS, SIZE, SAMPLES = 12, 4, 48, 512
CHANCE = 0.001
PATH = '<integrator type="path"><integer name="max_depth" value="8"/></integrator>'

MATERIALS = {
    "diffuse": '<bsdf type="diffuse" id="m"><rgb name="reflectance" value="0.2, 0.5, 0.8"/></bsdf>',
    "twosided": '<bsdf type="twosided" id="m"><bsdf type="diffuse"/></bsdf>',
    "conductor": '<bsdf type="conductor" id="m"><string name="material" value="Au"/></bsdf>',
    "roughconductor": '<bsdf type="roughconductor" id="m"><string name="material" value="Cu"/>'
                      '<float name="alpha" value="0.3"/></bsdf>',
    "roughconductor-ggx": '<bsdf type="roughconductor" id="m"><string name="material" value="Al"/>'
                          '<string name="distribution" value="ggx"/><float name="alpha_u" value="0.1"/>'
                          '<float name="alpha_v" value="0.4"/></bsdf>',
    "dielectric": '<bsdf type="dielectric" id="m"/>',
    "thindielectric": '<bsdf type="thindielectric" id="m"><string name="int_ior" value="diamond"/></bsdf>',
    "roughdielectric": '<bsdf type="roughdielectric" id="m"><float name="alpha" value="0.3"/></bsdf>',
    "roughdielectric-ggx": '<bsdf type="roughdielectric" id="m"><string name="distribution" value="ggx"/>'
                           '<float name="alpha" value="0.2"/><string name="int_ior" value="water"/></bsdf>',
    "plastic": '<bsdf type="plastic" id="m"><rgb name="diffuse_reflectance" value="0.9, 0.4, 0.1"/></bsdf>',
    "plastic-nonlinear": '<bsdf type="plastic" id="m"><rgb name="diffuse_reflectance" value="0.9, 0.4, 0.1"/>'
                         '<boolean name="nonlinear" value="true"/></bsdf>',
    "roughplastic": '<bsdf type="roughplastic" id="m"><rgb name="diffuse_reflectance" value="0.9, 0.4, 0.1"/>'
                    '<float name="alpha" value="0.2"/></bsdf>',
    "roughplastic-ggx": '<bsdf type="roughplastic" id="m"><rgb name="diffuse_reflectance" value="0.9, 0.4, 0.1"/>'
                        '<string name="distribution" value="ggx"/><float name="alpha" value="0.2"/></bsdf>',
    "bitmap": '<bsdf type="diffuse" id="m"><texture type="bitmap" name="reflectance"><string name="filename" '
              'value="wood.png"/></texture></bsdf>',
    "mask": '<bsdf type="mask" id="m"><float name="opacity" value="0.3"/><bsdf type="twosided"><bsdf type="diffuse"/>'
            "</bsdf></bsdf>",
    "checkerboard": '<bsdf type="diffuse" id="m"><texture type="checkerboard" name="reflectance"><transform name="to_uv">'
                    '<scale x="8" y="4"/></transform></texture></bsdf>',
}
AREA = ('<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/><translate y="3"/></transform>'
        '<emitter type="area"><rgb name="radiance" value="4, 3, 2"/></emitter></shape>')
LIGHTS = {
    "point": '<emitter type="point"><point name="position" x="1" y="3" z="2"/><rgb name="intensity" value="9"/></emitter>',
    "spot": '<emitter type="spot"><transform name="to_world"><lookat origin="1,4,2" target="0,0,0" up="0,0,1"/></transform>'
            '<rgb name="intensity" value="30"/><float name="cutoff_angle" value="25"/></emitter>',
    "directional": '<emitter type="directional"><vector name="direction" x="-1" y="-2" z="-1"/>'
                   '<rgb name="irradiance" value="2"/></emitter>',
    "envmap": '<emitter type="envmap"><string name="filename" value="sky.exr"/><transform name="to_world">'
              '<rotate y="1" angle="70"/></transform></emitter>',
    "sphere": '<shape type="sphere"><point name="center" x="1" y="2.5" z="1"/><float name="radius" value="0.4"/>'
              '<emitter type="area"><rgb name="radiance" value="9"/></emitter></shape>',
}
BODY = '<shape type="sphere"><transform name="to_world"><rotate x="1" angle="-90"/></transform><ref id="m"/></shape>'
SHAPES = {
    "cylinder": '<shape type="cylinder"><point name="p0" x="-1" y="0" z="0"/><point name="p1" x="1" y="0.5" z="0"/>'
                '<float name="radius" value="0.6"/><ref id="m"/></shape>',
    "disk": '<shape type="disk"><transform name="to_world"><scale x="1.5"/><rotate x="1" angle="-60"/></transform>'
            '<ref id="m"/></shape>',
    "cube-texture": '<shape type="cube"><transform name="to_world"><scale value="0.7"/><rotate y="1" angle="30"/></transform>'
                    '<ref id="m"/></shape>',
    "instance": '<shape type="shapegroup" id="g"><shape type="cube"><ref id="m"/></shape></shape>'
                '<shape type="instance"><ref id="g"/><transform name="to_world"><scale x="0.4" y="0.8" z="0.4"/>'
                '<rotate z="1" angle="20"/></transform></shape>',
}
SENSORS = {
    "thinlens": '<sensor type="thinlens"><float name="aperture_radius" value="0.3"/>'
                '<float name="focus_distance" value="5"/>',
    "orthographic": '<sensor type="orthographic">',
}


def scene(materials=MATERIALS["diffuse"], lights=AREA, shapes=BODY, sensor='<sensor type="perspective">'):
    scale = '<scale x="2" y="2"/>' if "orthographic" in sensor else ""
    fov = "" if "orthographic" in sensor else '<float name="fov" value="40"/>'
    return (f'<scene version="3.0.0"><default name="spp" value="{SAMPLES}"/>{PATH}{sensor}{fov}<transform name="to_world">{scale}'
            '<lookat origin="2,2.5,4" target="0,0,0" up="0,1,0"/></transform><sampler type="independent">'
            '<integer name="sample_count" value="$spp"/></sampler><film type="hdrfilm">'
            f'<integer name="width" value="{SIZE}"/><integer name="height" value="{SIZE}"/>'
            '<string name="component_format" value="float32"/><rfilter type="box"/></film></sensor>'
            f'{materials}{lights}{shapes}'
            '<shape type="rectangle"><transform name="to_world"><scale value="6"/><rotate x="1" angle="-90"/>'
            '<translate y="-1"/></transform><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape></scene>')


def as_mitsuba(text):
    """The text for Aureole, with Mitsuba's formula for rough plastics (see EXPLANATION)."""
    return re.sub(r'<bsdf type="roughplastic"[^>]*>', r'\g<0><boolean name="as_mitsuba" value="true"/>', text)


EXPLANATION = """
Rough plastics differ for a reason that is known. The light that the coat mirrors back to the base is an integral over
directions; Mitsuba takes it as the plain mean of 64 values from grazing to normal, both ends counted in full, which is
1.5 % of it too little, and for Beckmann facets it uses a rational approximation of the shadowing. So its base is darker,
by 1 to 2 %. `as_mitsuba` of `roughplastic` makes ours by the same sums and the same approximation: it has Mitsuba's values
to single precision. The rows that say "as_mitsuba", and the bundled scenes, are so.
"""


def all_scenes():
    """Names with the texts for Mitsuba and for Aureole."""
    constant = '<emitter type="constant"><rgb name="radiance" value="0.4, 0.5, 0.6"/></emitter>'
    for name, text in MATERIALS.items():
        theirs = scene(materials=text, lights=AREA + constant)
        yield "material " + name, theirs, theirs
        if as_mitsuba(text) != text:
            yield f"material {name}, as_mitsuba", theirs, as_mitsuba(theirs)
    rest = [("light " + name, scene(lights=text)) for name, text in LIGHTS.items()]
    rest += [("shape " + name, scene(materials=MATERIALS["checkerboard" if "texture" in name else "diffuse"], shapes=text))
             for name, text in SHAPES.items()]
    rest += [("sensor " + name, scene(sensor=text)) for name, text in SENSORS.items()]
    for name, text in rest:
        yield name, text, text


# Bundled scenes in their variant with rough materials, 64 samples per pixel; scripts/scenes.sh generates their meshes.
BUNDLED = ("plates/plates", "sphere/sphere", "statue/statue", "room/room", "parade/parade", "occlusion/occlusion",
           "cornell-box/figure")
SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes")
SETTINGS = {"materials": "rough", "integrator": "path", "spp": "64", "resx": str(SIZE), "resy": str(SIZE),
            "rfilter": "box", "max_depth": "8"}


def bundled_pair(folder, scene_path):
    """Copies of a scene, the first for Mitsuba; the second uses Mitsuba's formula for rough plastics."""
    name, files = os.path.split(scene_path)[0], []
    for side in ("theirs", "ours"):
        copy = os.path.join(folder, side, name)
        os.makedirs(copy, exist_ok=True)
        for entry in os.listdir(os.path.join(SCENES, name)):
            if not entry.endswith(".xml"):
                os.symlink(os.path.realpath(os.path.join(SCENES, name, entry)), os.path.join(copy, entry))
                continue
            with open(os.path.join(SCENES, name, entry), encoding="utf-8") as file:
                text = file.read()
            if side == "ours" and entry == "materials-rough.xml":
                text = as_mitsuba(text)
            with open(os.path.join(copy, entry), "w", encoding="utf-8") as file:
                file.write(text)
        generated = os.path.join(folder, side, "generated")
        if not os.path.exists(generated):
            os.symlink(os.path.realpath(os.path.join(SCENES, "generated")), generated)
        files.append(os.path.join(folder, side, scene_path + ".xml"))
    return files


def compare_bundled(aureole, folder, scene_path):
    theirs_path, ours_path = bundled_pair(folder, scene_path)
    definitions = [word for item in SETTINGS.items() for word in ("-D", "=".join(item))]
    if subprocess.run([aureole, "info", ours_path, *definitions], capture_output=True, check=False).returncode != 0:
        print(f"| bundled {scene_path} | | | | | | not compared: scripts/scenes.sh has not made its meshes |", flush=True)
        return True
    loaded = mi.load_file(theirs_path, **SETTINGS)
    out = os.path.join(folder, "out.exr")
    ours, theirs = [], []
    for seed in range(1, SEEDS + 1):
        subprocess.run([aureole, "render", ours_path, "-q", "--seed", str(seed), "--sampler", "random", "-o", out, *definitions],
                       check=True)
        ours.append(read(out))
        theirs.append(np.array(mi.render(loaded, seed=seed), dtype=np.float64)[:, :, :3])
    return judge("bundled " + scene_path, ours, theirs)


def public_scene(path):
    """The scene with path, independent samples, a box filter and a small film."""
    return mitsuba_scene.change(mitsuba_scene.read(path), PATH, "independent", "box", SIZE, SIZE, SAMPLES)


def read(path):
    return np.array(mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32), dtype=np.float64)


def blocks(image):
    height, width, _ = image.shape
    part = image[:height - height % BLOCKS, :width - width % BLOCKS]
    return part.reshape(BLOCKS, part.shape[0] // BLOCKS, BLOCKS, part.shape[1] // BLOCKS, 3).mean(axis=(1, 3)).ravel()


def student_quantile(probability, freedom):
    """The t that |t| exceeds with this probability, by bisection of the tail integral."""
    constant = math.gamma((freedom + 1) / 2) / (math.sqrt(freedom * math.pi) * math.gamma(freedom / 2))
    x = np.linspace(0, 1, 20001)[:-1] + 0.5 / 20000

    def tail(t):  # substitution s = t / x
        s = t / x
        return 2 * np.mean(constant * (1 + s * s / freedom) ** (-(freedom + 1) / 2) * t / (x * x))

    low, high = 0.0, 1e4
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if tail(middle) > probability else (low, middle)
    return high


def render_ours(aureole, folder, text, seed):
    path, out = os.path.join(folder, "ours.xml"), os.path.join(folder, "out.exr")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    subprocess.run([aureole, "render", path, "-q", "--seed", str(seed), "--sampler", "random", "-o", out], check=True)
    return read(out)


def compare(aureole, folder, name, texts):
    path = os.path.join(folder, "theirs.xml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(texts[0])
    try:
        loaded = mi.load_file(path)
    except RuntimeError as error:
        unknown = re.search(r'[Pp]lugin "([^"]*)"', str(error))
        reason = f"has no '{unknown[1]}'" if unknown else "cannot load it"
        print(f"| {name} | | | | | | not compared: Mitsuba {reason} |", flush=True)
        return True
    ours, theirs = [], []
    for seed in range(1, SEEDS + 1):
        ours.append(render_ours(aureole, folder, texts[1], seed))
        theirs.append(np.array(mi.render(loaded, seed=seed), dtype=np.float64)[:, :, :3])
    return judge(name, ours, theirs)


def judge(name, ours, theirs):
    a, b = np.array([blocks(p) for p in ours]), np.array([blocks(p) for p in theirs])
    error = np.sqrt((a.var(axis=0, ddof=1) + b.var(axis=0, ddof=1)) / SEEDS)
    difference = a.mean(axis=0) - b.mean(axis=0)
    seen = error > 1e-7 * np.abs(b.mean(axis=0)) + 1e-9
    t = np.abs(difference[seen] / error[seen]).max() if seen.any() else 0.0
    flat = np.abs(difference[~seen]).max() if (~seen).any() else 0.0  # blocks without noise must agree
    limit = student_quantile(1 - (1 - CHANCE) ** (1 / max(seen.sum(), 1)), 2 * SEEDS - 2)
    ma, mb = a.mean(axis=1), b.mean(axis=1)
    half = student_quantile(0.05, 2 * SEEDS - 2) * math.sqrt((ma.var(ddof=1) + mb.var(ddof=1)) / SEEDS)
    relative = (ma.mean() - mb.mean()) / mb.mean()
    good = t <= limit and flat <= 1e-4
    expected = name.startswith("material roughplastic") and "as_mitsuba" not in name
    verdict = "agrees" if good else "differs, see below" if expected else "DIFFERS"
    print(f"| {name} | {mb.mean():.5f} | {100 * relative:+.3f} % | {100 * half / mb.mean():.3f} % | {t:.2f} | {limit:.2f} | "
          f"{verdict} |", flush=True)
    return good or expected


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    aureole, paths = os.path.abspath(sys.argv[1]), sys.argv[2:]
    only = ""
    if len(paths) > 1 and paths[0] == "--only":
        only, paths = paths[1], paths[2:]
    good = True
    print(f"# Mitsuba 3, scene by scene\n\nWritten by `bench/peers/mitsuba3.py` with Mitsuba {mi.__version__}: {SEEDS} seeds of {SAMPLES} samples per pixel each (bundled scenes: 64), "
          f"{SIZE} x {SIZE} pixels.\n\"Difference\" is ours from Mitsuba's in the mean of the picture, with its 95 % interval; t is the largest of\n"
          f"{BLOCKS} x {BLOCKS} blocks and three channels, which chance lets pass what is allowed in {100 * CHANCE:g} % of equal scenes.\n")
    print("| scene | mean (Mitsuba) | difference | 95 % interval | largest t | allowed | |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        azimuth, height = np.meshgrid(np.linspace(0, 2 * np.pi, 32, endpoint=False), np.linspace(0, np.pi, 16))
        sky = np.stack([0.3 + 0.2 * np.cos(azimuth), 0.4 + 0.3 * np.cos(height), 0.5 + 0 * height], axis=2)
        sky[4, 9] = 30.0
        mi.Bitmap(sky.astype(np.float32)).write(os.path.join(folder, "sky.exr"))
        x, y = np.meshgrid(np.arange(16), np.arange(8))
        wood = np.stack([40 + 12 * x, 200 - 20 * y, 128 + 0 * x], axis=2)
        mi.Bitmap(wood.astype(np.uint8)).write(os.path.join(folder, "wood.png"))
        for name, *texts in all_scenes():
            if only in name:
                good = compare(aureole, folder, name, texts) and good
        for scene_path in BUNDLED:
            if only in "bundled " + scene_path:
                good = compare_bundled(aureole, folder, scene_path) and good
        for path in paths:
            good = compare(aureole, folder, "file " + "/".join(path.split("/")[-2:]), 2 * [public_scene(path)]) and good
    print(EXPLANATION, end="")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()

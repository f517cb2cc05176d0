#!/usr/bin/env python3
"""Renders the same scenes with Aureole and with Mitsuba 3 and tests the difference against the noise.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install 'mitsuba==3.*'
    /tmp/peers/bin/python bench/peers/mitsuba3.py build/release/aureole [NAME...]

Each scene is rendered by both with SEEDS seeds. Means over BLOCKS x BLOCKS blocks and three channels give a Welch t each;
the largest |t| is judged by a Sidak correction over all blocks at a chance of 1 % a scene (Student's t of the seeds'
degrees of freedom). The table also has the difference of the means of the whole pictures, with its 95 % interval.
The exit status is 1 when a scene fails.
"""
import math
import os
import subprocess
import sys
import tempfile

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
SEEDS, BLOCKS, SIZE, SAMPLES = 6, 4, 48, 64

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
    return (f'<scene version="3.0.0"><default name="spp" value="{SAMPLES}"/><integrator type="path">'
            f'<integer name="max_depth" value="8"/></integrator>{sensor}{fov}<transform name="to_world">{scale}'
            '<lookat origin="2,2.5,4" target="0,0,0" up="0,1,0"/></transform><sampler type="independent">'
            '<integer name="sample_count" value="$spp"/></sampler><film type="hdrfilm">'
            f'<integer name="width" value="{SIZE}"/><integer name="height" value="{SIZE}"/>'
            '<string name="component_format" value="float32"/><rfilter type="box"/></film></sensor>'
            f'{materials}{lights}{shapes}'
            '<shape type="rectangle"><transform name="to_world"><scale value="6"/><rotate x="1" angle="-90"/>'
            '<translate y="-1"/></transform><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape></scene>')


def all_scenes():
    constant = '<emitter type="constant"><rgb name="radiance" value="0.4, 0.5, 0.6"/></emitter>'
    for name, text in MATERIALS.items():
        yield "material " + name, scene(materials=text, lights=AREA + constant)
    for name, text in LIGHTS.items():
        yield "light " + name, scene(lights=text)
    for name, text in SHAPES.items():
        yield "shape " + name, scene(materials=MATERIALS["checkerboard" if "texture" in name else "diffuse"], shapes=text)
    for name, text in SENSORS.items():
        yield "sensor " + name, scene(sensor=text)


def read(path):
    return np.array(mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32), dtype=np.float64)


def blocks(picture):
    height, width, _ = picture.shape
    part = picture[:height - height % BLOCKS, :width - width % BLOCKS]
    return part.reshape(BLOCKS, part.shape[0] // BLOCKS, BLOCKS, part.shape[1] // BLOCKS, 3).mean(axis=(1, 3)).ravel()


def student_quantile(chance, freedom):
    """The t that |t| exceeds with this chance, by bisection of the tail integral."""
    constant = math.gamma((freedom + 1) / 2) / (math.sqrt(freedom * math.pi) * math.gamma(freedom / 2))
    x = np.linspace(0, 1, 20001)[:-1] + 0.5 / 20000

    def tail(t):  # substitution s = t / x
        s = t / x
        return 2 * np.mean(constant * (1 + s * s / freedom) ** (-(freedom + 1) / 2) * t / (x * x))

    low, high = 0.0, 1e4
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if tail(middle) > chance else (low, middle)
    return high


def compare(aureole, folder, name, path):
    ours, theirs = [], []
    for seed in range(1, SEEDS + 1):
        out = os.path.join(folder, "out.exr")
        subprocess.run([aureole, "render", path, "-q", "--seed", str(seed), "--sampler", "random", "-o", out], check=True)
        ours.append(read(out))
        picture = mi.render(mi.load_file(path), seed=seed)
        theirs.append(np.array(picture, dtype=np.float64)[:, :, :3])
    a, b = np.array([blocks(p) for p in ours]), np.array([blocks(p) for p in theirs])
    error = np.sqrt((a.var(axis=0, ddof=1) + b.var(axis=0, ddof=1)) / SEEDS)
    difference = a.mean(axis=0) - b.mean(axis=0)
    seen = error > 1e-7 * np.abs(b.mean(axis=0)) + 1e-9
    t = np.abs(difference[seen] / error[seen]).max() if seen.any() else 0.0
    flat = np.abs(difference[~seen]).max() if (~seen).any() else 0.0  # blocks without noise must agree by themselves
    chance = 1 - (1 - 0.01) ** (1 / max(seen.sum(), 1))
    limit = student_quantile(chance, 2 * SEEDS - 2)
    ma, mb = a.mean(axis=1), b.mean(axis=1)
    half = student_quantile(0.05, 2 * SEEDS - 2) * math.sqrt((ma.var(ddof=1) + mb.var(ddof=1)) / SEEDS)
    relative = (ma.mean() - mb.mean()) / mb.mean()
    good = t <= limit and flat <= 1e-4
    print(f"| {name} | {mb.mean():.5f} | {100 * relative:+.3f} % | {100 * half / mb.mean():.3f} % | {t:.2f} | {limit:.2f} | "
          f"{'agrees' if good else 'DIFFERS'} |", flush=True)
    return good


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    aureole, wanted = os.path.abspath(sys.argv[1]), sys.argv[2:]
    good = True
    print("| scene | mean (Mitsuba) | difference | 95 % interval | largest t | allowed | |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        azimuth, height = np.meshgrid(np.linspace(0, 2 * np.pi, 32, endpoint=False), np.linspace(0, np.pi, 16))
        sky = np.stack([0.3 + 0.2 * np.cos(azimuth), 0.4 + 0.3 * np.cos(height), 0.5 + 0 * height], axis=2)
        sky[4, 9] = 30.0
        mi.Bitmap(sky.astype(np.float32)).write(os.path.join(folder, "sky.exr"))
        for name, text in all_scenes():
            if wanted and not any(w in name for w in wanted):
                continue
            path = os.path.join(folder, "scene.xml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            good = compare(aureole, folder, name, path) and good
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()

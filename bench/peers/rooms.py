#!/usr/bin/env python3
"""Generated rooms that no setting was tuned for: final gathering and --error, compared with path tracing.

    python3 -m venv /tmp/rooms && /tmp/rooms/bin/pip install numpy
    /tmp/rooms/bin/python bench/peers/rooms.py build/release/aureole [--seeds 101-112] [--seconds 3] [--size 64x48] [--scene FILE.xml]
    /tmp/rooms/bin/python bench/peers/rooms.py --write FOLDER --seeds 7

Each room has tables and chairs with thin legs, a floor of glossy wood, a rug, a wall with textures that are black at one corner, mirrors, vases
and bowls of many materials. A third are courtyards under sun and sky, a third have sun and sky behind blinds and one or two light sources, a third
up to sixteen light sources. Seeds 1 to 12 are for tuning, 101 to 112 for reported results.

By default `finalgather` with its default settings renders for a number of CPU seconds on one thread (whole processes, Sobol' points, box filter),
`path` for the same time, and --error to the smaller of their errors. The reference is two path-traced images a and b with independent seeds
and the number of rays of --rays, sampled adaptively. The mean square error of x is the mean of (x - a)(x - b). The relative standard error of
the RMSE, half the relative standard error of the mean square error, follows it in parentheses. Ratios are of times to the same error, extrapolated as seconds^-1/2.
"""
import argparse
import math
import os
import random
import re
import resource
import statistics
import subprocess
import tempfile

import interior
from interior import bitmap_texture, box, mesh, rgb, shape, two_sided, wall

MOST_SAMPLES = 16384


# --- scenes


def corner(x, y):
    """A texture that is black at one corner and bright elsewhere."""
    return (0, 0, 0) if x + y < 96 else (200, 120 + x // 2, 110 + y // 2)


def on_legs(size, place, thick, board, metal):
    """A board with four thin legs; its top is at height size[1]."""
    text = box((size[0], .04, size[2]), (place[0], size[1] - .02, place[1]), board)
    for x in (-1, 1):
        for z in (-1, 1):
            text += box((thick, size[1] - .045, thick), (place[0] + x * (size[0] / 2 - .05), (size[1] - .045) / 2 + .002,
                                                        place[1] + z * (size[2] / 2 - .05)), metal)
    return text


def furniture(dice, width, depth, board, metal):
    kinds = interior.materials(dice)
    text = ""
    for _ in range(dice.randint(2, 4)):
        place = (dice.uniform(-.3, .3) * width, dice.uniform(-.35, .1) * depth)
        size = (dice.uniform(.7, 1.5), dice.uniform(.45, .8), dice.uniform(.5, .9))
        text += on_legs(size, place, dice.uniform(.015, .05), board, metal)
        for _ in range(dice.randint(1, 4)):
            spot = (place[0] + dice.uniform(-.4, .4) * size[0], size[1] + .001, place[1] + dice.uniform(-.4, .4) * size[2])
            material = dice.choice(kinds if dice.random() < .2 else kinds[:5])()
            text += mesh(dice.choice(("vase", "ball", "bowl")), dice.uniform(.05, .13), spot, material)
        for side in (-1, 1):
            seat = (place[0] + side * (size[0] / 2 + .3), place[1] + dice.uniform(-.2, .2))
            text += on_legs((.4, .42, .4), seat, .025, board, metal)
            text += box((.03, .5, .4), (seat[0] + side * .19, .67, seat[1]), board)
    return text


def lamps(dice, count, width, depth, height):
    text, each = "", 18.0 / count
    for _ in range(count):
        x, z = dice.uniform(-.42, .42) * width, dice.uniform(-.42, .3) * depth
        color = [each * dice.uniform(.6, 1.4) for _ in range(3)]
        if dice.random() < .5:
            side = dice.uniform(.15, .6)
            light = [c / side ** 2 for c in color]
            text += wall((side, side), '<rotate x="1" angle="90"/>', (x, height - .02, z), "",
                         f'<emitter type="area">{rgb("radiance", light)}</emitter>')
        else:
            radius = dice.uniform(.04, .12)
            light = [c / (4 * math.pi * radius ** 2) for c in color]
            text += shape("sphere", f'<translate x="{x:.3f}" y="{dice.uniform(.9, .8 * height):.3f}" z="{z:.3f}"/>',
                          f'<emitter type="area">{rgb("radiance", light)}</emitter>', f'<float name="radius" value="{radius:.3f}"/>')
    return text


def sun_and_sky(dice):
    towards = (-dice.uniform(.4, 1), -dice.uniform(.6, 1.2), dice.uniform(-.5, .5))
    return (f'<emitter type="directional"><vector name="direction" x="{towards[0]:.3f}" y="{towards[1]:.3f}" z="{towards[2]:.3f}"/>'
            f'{rgb("irradiance", (9, 8.4, 7.5))}</emitter><emitter type="constant">{rgb("radiance", (.7, .9, 1.3))}</emitter>\n')


def blinds(dice, depth, height, material):
    """The right wall with an opening, and slats in front of it."""
    low, high, half = .8, height - .4, .3 * depth
    turn, x = '<rotate y="1" angle="-90"/>', dice.uniform(2, 3)
    text = wall((depth, low), turn, (x, low / 2, 0), material) + wall((depth, height - high), turn, (x, (height + high) / 2, 0), material)
    for side in (-1, 1):
        text += wall((depth / 2 - half, high - low), turn, (x, (low + high) / 2, side * (depth / 2 + half) / 2), material)
    tilt, count = dice.uniform(10, 50), dice.randint(6, 14)
    for i in range(count):
        text += shape("rectangle", f'<scale x="{half:.3f}" y=".05"/><rotate x="1" angle="{90 + tilt:.1f}"/><rotate y="1" angle="90"/>'
                      f'<translate x="{x - .08:.3f}" y="{low + (i + .5) * (high - low) / count:.3f}" z="0"/>', material)
    return text, 2 * x


def room(seed):
    dice = random.Random(seed)
    depth, height, kind = dice.uniform(4, 6), dice.uniform(2.5, 3.2), ("lamps", "courtyard", "blinds")[seed % 3]
    plain = two_sided(f'<bsdf type="diffuse">{rgb("reflectance", [dice.uniform(.4, .85) for _ in range(3)])}</bsdf>')
    pale = two_sided('<bsdf type="diffuse"><rgb name="reflectance" value=".75, .74, .7"/></bsdf>')
    board = two_sided(f'<bsdf type="diffuse">{bitmap_texture("reflectance", "wood.png")}</bsdf>')
    metal = two_sided('<bsdf type="roughconductor"><string name="material" value="Cr"/><float name="alpha" value=".25"/></bsdf>')
    gloss = (f'<float name="alpha" value="{dice.uniform(.06, .3):.3f}"/>' + bitmap_texture("diffuse_reflectance", "wood.png", 3))
    black = two_sided(f'<bsdf type="diffuse">{bitmap_texture("reflectance", "corner.png")}</bsdf>')
    text, width = blinds(dice, depth, height, pale) if kind == "blinds" else ("", dice.uniform(4, 6))
    if kind != "blinds":
        text += wall((depth, height), '<rotate y="1" angle="-90"/>', (width / 2, height / 2, 0), pale)
    text += wall((width, depth), '<rotate x="1" angle="-90"/>', (0, 0, 0), two_sided(f'<bsdf type="roughplastic">{gloss}</bsdf>'))
    text += wall((width, height), "", (0, height / 2, -depth / 2), dice.choice((plain, black)))
    text += wall((width, height), '<rotate y="1" angle="180"/>', (0, height / 2, depth / 2), pale)
    text += wall((depth, height), '<rotate y="1" angle="90"/>', (-width / 2, height / 2, 0), plain)
    text += wall((1.8, 1.2), '<rotate x="1" angle="-90"/>', (dice.uniform(-1, 1), .004, 0), black)
    for _ in range(dice.randint(0, 2)):
        left, along = dice.random() < .5, dice.uniform(-1.5, .5)
        text += wall((dice.uniform(.5, 1.4), dice.uniform(.6, 1.2)), '<rotate y="1" angle="90"/>' if left else "",
                     (-width / 2 + .02, 1.5, along) if left else (along, 1.5, -depth / 2 + .02), two_sided('<bsdf type="conductor"/>'))
    text += furniture(dice, width, depth, board, metal)
    if kind == "courtyard":
        return kind, text + sun_and_sky(dice)
    text += wall((width, depth), '<rotate x="1" angle="90"/>', (0, height, 0), pale)
    count = dice.randint(1, 2) if kind == "blinds" else dice.randint(3, 16)
    return kind, text + lamps(dice, count, width, depth, height) + (sun_and_sky(dice) if kind == "blinds" else "")


def write(folder, seed):
    interior.write_pictures(folder, random.Random(seed))
    interior.write_meshes(folder)
    interior.write_png(os.path.join(folder, "corner.png"), 128, 128, corner)
    kind, inner = room(seed)
    path = os.path.join(folder, f"room-{seed}.xml")
    with open(path, "w", encoding="utf-8") as file:
        file.write('<scene version="3.0.0">\n<integrator type="path"/>\n<sensor type="perspective"><float name="fov" value="68"/>'
                   '<transform name="to_world"><lookat origin=".6, 1.6, 1.9" target="-.3, .8, -1.5" up="0, 1, 0"/></transform>'
                   '<sampler type="independent"><integer name="sample_count" value="16"/></sampler><film type="hdrfilm">'
                   f'<integer name="width" value="640"/><integer name="height" value="480"/><rfilter type="box"/></film></sensor>\n{inner}</scene>\n')
    return kind, path


# --- measuring


def render(given, scene, *options, seed=1):
    """The image, CPU seconds of the process, and its last line."""
    import numpy as np
    width, height = given.size.split("x")
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "picture.pfm")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        message = subprocess.run([given.aureole, "render", scene, "--width", width, "--height", height, "--filter", "box", "-t", "1", "--no-cache",
                               "--seed", str(seed), *(["-D", "integrator=path"] if given.scene else []), *options, "-o", out], check=True, stderr=subprocess.PIPE, text=True).stderr
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        with open(out, "rb") as file:
            for _ in range(3):
                file.readline()
            values = np.frombuffer(file.read(), "<f4").astype(np.float64)
    return values, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, message.splitlines()[-1]


def error_of(values, references):
    """Relative RMSE, and its relative standard error."""
    product = (values - references[0]) * (values - references[1])
    square, mean = float(product.mean()), float((references[0] + references[1]).mean() / 2)
    return math.sqrt(max(square, 0)) / mean, float(product.std()) / math.sqrt(len(product)) / max(abs(square), 1e-30) / 2


def for_seconds(given, scene, integrator, seconds, samples):
    """An image that takes at least half of the time: samples increase fourfold, or less near the limit."""
    while True:
        values, spent, _ = render(given, scene, "--integrator", integrator, "--sampler", "sobol", "--spp", str(samples))
        if spent >= .5 * seconds or samples >= MOST_SAMPLES:
            return values, spent
        samples = round(samples * min(4.0, seconds / spent))


def compare(given, name, scene):
    references = [render(given, scene, "--integrator", "path", "--rays", given.rays, seed=seed)[0] for seed in (1001, 1002)]
    rows = {}
    values, seconds = for_seconds(given, scene, "finalgather", given.seconds, 4)
    rows["finalgather"] = (*error_of(values, references), seconds)
    values, seconds = for_seconds(given, scene, "path", seconds, 16)
    rows["path"] = (*error_of(values, references), seconds)
    target = max(min(rows["path"][0], rows["finalgather"][0]), .003)
    values, seconds, message = render(given, scene, "--error", f"{target:.4f}", "--error-measure", "mean")
    rows["target"] = (*error_of(values, references), seconds)
    cost = {key: error ** 2 * seconds for key, (error, _, seconds) in rows.items()}
    gather, auto = cost["path"] / cost["finalgather"], cost["path"] / cost["target"]
    chosen = re.search(r" by ([a-z]+)", message)
    print(f"| {name} | " + " | ".join(f"{100 * e:.2f} % ({100 * s:.0f}) in {t:.2f} s" for e, s, t in rows.values()) +
          f" | {chosen[1] if chosen else '?'} | {gather:.2f} | {auto:.2f} |", flush=True)
    return gather, auto


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("aureole", nargs="?", default="build/release/aureole")
    parser.add_argument("--seeds", default="101-112", help="FIRST-LAST, or one")
    parser.add_argument("--seconds", type=float, default=3)
    parser.add_argument("--size", default="64x48")
    parser.add_argument("--rays", default="1e7", help="of each of the two reference images")
    parser.add_argument("--scene", help="this one in place of rooms, whose $integrator is path")
    parser.add_argument("--write", metavar="FOLDER", help="write the rooms only")
    given = parser.parse_args()
    first, _, last = given.seeds.partition("-")
    seeds = range(int(first), int(last or first) + 1)
    if given.write:
        os.makedirs(given.write, exist_ok=True)
        for seed in seeds:
            print(": ".join(reversed(write(given.write, seed))))
        return
    print("| room | finalgather: error (% of that) | path | --error | by | finalgather / path | --error / path |\n|---|---|---|---|---|---|---|")
    if given.scene:
        compare(given, os.path.basename(os.path.dirname(os.path.abspath(given.scene))), given.scene)
        return
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        for seed in seeds:
            kind, scene = write(folder, seed)
            ratios.append(compare(given, f"{seed}, {kind}", scene))
    for name, values in zip(("finalgather", "--error"), zip(*ratios)):
        print(f"\n{name}: behind path in {sum(v < 1 for v in values)} of {len(values)}, median {statistics.median(values):.2f}")


if __name__ == "__main__":
    main()

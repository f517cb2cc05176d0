#!/usr/bin/env python3
"""Error of `aureole irradiance` with its default number of directions in rooms that it was not tuned for.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install numpy
    /tmp/peers/bin/python bench/peers/daylit_rooms.py build/release/aureole [--seeds 1-8] [--runs 8] [--public FOLDER] [-n N]

Rooms are generated from seeds: 3 to 12 m wide, windows in one or two walls or the roof, with and without glass, tables, a house opposite.
--public names a folder with clones of ladybug-tools/honeybee-radiance, ladybug-tools/honeybee-radiance-folder and LBNL-ETA/frads, as
OWNER+NAME: their models, unchanged. The sky is overcast. Each room has 16 sensors .8 m above the floor, or those of its model.

Results are unbiased: a sensor's error is its standard deviation over runs with different seeds. The table has the median and
the 90th percentile over the sensors of a room, relative to the sensor's mean, the median of the errors that the program reports, and CPU
seconds of one run.
"""
import argparse
import os
import random
import resource
import subprocess
import tempfile

import numpy as np


def polygon(name, material, *corners):
    return f"{material} polygon {name} 0 0 {3 * len(corners)} " + " ".join(f"{x:.6g} {y:.6g} {z:.6g}" for x, y, z in corners) + "\n"


def holed(name, material, hole, glass, place):
    """A wall with a window: place(u, v) of the wall's unit square, seen from inside; the hole is u0, v0, u1, v1."""
    u0, v0, u1, v1 = hole
    strips = ((0, 0, 1, v0), (0, v1, 1, 1), (0, v0, u0, v1), (u1, v0, 1, v1))
    text = "".join(polygon(f"{name}{i}", material, place(a, b), place(c, b), place(c, d), place(a, d)) for i, (a, b, c, d) in enumerate(strips))
    return text + (polygon(name + "pane", "pane", place(u0, v0), place(u1, v0), place(u1, v1), place(u0, v1)) if glass else "")


def room(seed):
    """The scene text, and positions of sensors."""
    dice = random.Random(seed)
    width, depth, height = dice.uniform(3, 8), dice.uniform(4, 12), dice.uniform(2.5, 4)
    text = "void glass pane 0 0 3 {0:.3f} {0:.3f} {0:.3f}\n".format(dice.uniform(0.6, 0.95))
    for name, low, high in (("floor", 0.1, 0.4), ("wall", 0.3, 0.7), ("ceiling", 0.6, 0.9), ("wood", 0.2, 0.6), ("house", 0.1, 0.5)):
        text += f"void plastic {name}_m 0 0 5 {dice.uniform(low, high):.3f} {dice.uniform(low, high):.3f} {dice.uniform(low, high):.3f} 0 0\n"
    glass, two, roof = dice.random() < 0.7, dice.random() < 0.4, dice.random() < 0.25
    window = (dice.uniform(0.05, 0.3), dice.uniform(0.1, 0.4), dice.uniform(0.6, 0.95), dice.uniform(0.7, 0.95))
    walls = (lambda u, v: (u * width, 0, v * height), lambda u, v: (width, u * depth, v * height),
             lambda u, v: (width - u * width, depth, v * height), lambda u, v: (0, depth - u * depth, v * height))  # fmt: skip
    for i, place in enumerate(walls):
        if (i == 0 and not roof) or (i == 2 and two):
            text += holed(f"wall{i}", "wall_m", window, glass, place)
        else:
            text += polygon(f"wall{i}", "wall_m", place(0, 0), place(1, 0), place(1, 1), place(0, 1))
    lid = lambda u, v: (u * width, v * depth, height)
    text += holed("lid", "ceiling_m", (0.3, 0.4, 0.7, 0.6), glass, lid) if roof else polygon("lid", "ceiling_m", lid(0, 0), lid(1, 0), lid(1, 1), lid(0, 1))
    text += polygon("floor", "floor_m", (0, 0, 0), (width, 0, 0), (width, depth, 0), (0, depth, 0))
    for i in range(dice.randint(1, 5)):
        x, y = dice.uniform(0.3, width - 1.6), dice.uniform(0.3, depth - 1.2)
        text += f"!genbox wood_m table{i} 1.2 .7 .03 | xform -t {x:.3f} {y:.3f} .7\n"
    if dice.random() < 0.6:
        text += f"!genbox house_m house 30 8 {dice.uniform(3, 12):.2f} | xform -t -12 {-8 - dice.uniform(5, 15):.2f} 0\n"
    return text, [(width * (i + 0.5) / 4, depth * (k + 0.5) / 4, 0.8) for i in range(4) for k in range(4)]


PUBLIC = (  # name, repository, files, sensors
    ("honeybee office", "ladybug-tools+honeybee-radiance-folder/tests/assets/model_folders/static/model",
     "scene/envelope.mat scene/envelope.rad aperture/aperture.mat aperture/aperture.rad", "grid/*.pts"),
    ("honeybee project folder", "ladybug-tools+honeybee-radiance-folder/tests/assets/project_folder/model",
     "scene/context.mat scene/context.rad scene/partition.mat scene/partition.rad scene/partition_glass.mat scene/partition_glass.rad "
     "scene/room_envelope.mat scene/room_envelope.rad aperture/aperture.mat aperture/aperture.rad", "grid/hallway.pts"),
    ("honeybee cubical", "ladybug-tools+honeybee-radiance-folder/tests/assets/project_folder/model",
     "scene/context.mat scene/context.rad scene/partition.mat scene/partition.rad scene/partition_glass.mat scene/partition_glass.rad "
     "scene/room_envelope.mat scene/room_envelope.rad aperture/aperture.mat aperture/aperture.rad", "grid/cubical.pts"),
    ("frads office", "LBNL-ETA+frads/tests/Objects",
     "materials.mat walls.rad ceiling.rad floor.rad desks.rad cubefabric.rad cubeframe.rad windowframe.rad horframe.rad extwalls.rad upper_glass.rad lower_glass.rad "
     "overhang.rad", "../Resources/grid.pts"),
)  # fmt: skip


def measure(program, files, points, runs, directions):
    """Median and 90th percentile of the relative errors of sensors, median of the reported ones, CPU seconds of a run."""
    values, said = [], []
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    for seed in range(runs):
        subprocess.run([program, "irradiance", "-q", "--diffuse", *files, "--sky", "cie-overcast", "--sensors", points, "--illuminance", "radiance",
                        "--seed", str(seed), "-o", "lux.npy", *(["-n", str(directions)] if directions else [])], check=True)  # fmt: skip
        table = np.load("lux.npy")
        values.append(table[:, 3])
        said.append(table[:, 4])
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    mean = np.mean(values, 0)
    lit = mean > 0
    error = np.std(values, 0, ddof=1)[lit] / mean[lit]
    return np.median(error), np.quantile(error, 0.9), np.median(np.mean(said, 0)[lit] / mean[lit]), (
        after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime) / runs, lit.sum()  # fmt: skip


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("--seeds", default="1-8")
    options.add_argument("--runs", type=int, default=8)
    options.add_argument("--public")
    options.add_argument("-n", type=int, default=0)
    given = options.parse_args()
    program = os.path.abspath(given.program)
    first, last = map(int, given.seeds.split("-"))
    rooms = [(f"room {seed}", seed) for seed in range(first, last + 1)]
    if given.public:
        rooms += [(name, (os.path.join(os.path.abspath(given.public), folder), files.split(), points)) for name, folder, files, points in PUBLIC]
    os.chdir(tempfile.mkdtemp())
    print("| room | sensors | median error | 90 % of the sensors | reported | CPU s |\n|---|---|---|---|---|---|")
    medians = []
    for name, what in rooms:
        if isinstance(what, int):
            text, positions = room(what)
            open("room.rad", "w").write(text)
            open("desk.pts", "w").write("".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in positions))
            files, points = ["room.rad"], "desk.pts"
        else:
            import glob

            folder, names, grid = what
            files = [os.path.join(folder, file) for file in names]
            points = sorted(glob.glob(os.path.join(folder, grid)))[0]
        median, most, said, seconds, count = measure(program, files, points, given.runs, given.n)
        medians.append(median)
        print(f"| {name} | {count} | {100 * median:.2f} % | {100 * most:.2f} % | {100 * said:.2f} % | {seconds:.2f} |", flush=True)
    print(f"| median room | | {100 * np.median(medians):.2f} % | | | |")


if __name__ == "__main__":
    main()

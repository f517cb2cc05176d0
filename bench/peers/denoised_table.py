#!/usr/bin/env python3
"""Errors of denoised images of `aureole render --time T --denoise` and of Mitsuba 3 at equal CPU time, scene by scene.

    AUREOLE_OIDN=.../libOpenImageDenoise.so.2 /tmp/peers/bin/python bench/peers/denoised_table.py build/release/aureole
        SCENE.xml[:WIDTHxHEIGHT]... [--samples 16,64] [--folder FOLDER]

Requires the packages of target_error.py. Both programs use the library in AUREOLE_OIDN, the filter box, path lengths without a limit and one thread.
Mitsuba is llvm_ad_rgb with multi-jittered samples; its integrator aov renders albedo and normals with the image. Its seconds are those of
this render call, compilation left out, and of denoising. Ours are the whole process's less those of a process that loads the scene and renders
one pixel, for times T from an eighth of Mitsuba's seconds up; the error at equal seconds is interpolated between the two nearest by a power law,
and the integrator named is the slower run's.

The error is relMSE by the measure `relative` of docs/target-error.md: the mean of (x - a)(x - b) / scale^2 in luminance, where a and b are
long renders of `path` and of Mitsuba, whose errors are independent (stored in FOLDER; their means are compared first).
A ratio below 1 means that our error is smaller. The last line has the median of the ratios and the largest."""
import argparse
import json
import math
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile

from denoised import FEATURES, denoise
from mitsuba_scene import PATH, change, cpu_seconds, load, read, split

LONG, PART = 512, 64  # samples per pixel of references, and of each of their parts


def copy(path, folder):
    """The name of a copy in `folder`, by path tracing and the filter box."""
    name = os.path.join(folder, os.path.basename(path))
    with open(name, "w", encoding="utf-8") as file:
        file.write(change(read(path), rfilter="box"))
    return name


def mitsuba(path, width, height, integrator):
    """A function (samples, seed) -> (image, CPU seconds); a first call for each number of samples compiles."""
    import drjit as dr
    import mitsuba as mi
    import numpy as np
    scene, sensor = load(change(read(path), integrator, "multijitter", "box"), width, height)

    def render(samples, seed):
        dr.set_thread_count(1)
        start = cpu_seconds()
        image = np.array(mi.render(scene, sensor=sensor, spp=samples, seed=seed), dtype=np.float32)
        taken = cpu_seconds() - start
        dr.set_thread_count(2)  # images are read and written by a second one
        return image, taken
    return render


def aureole(program, path, width, height, arguments):
    """Image, CPU seconds of the process, and report."""
    import mitsuba as mi
    import numpy as np
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "image.exr")
        before = cpu_seconds(resource.RUSAGE_CHILDREN)
        run = subprocess.run([program, "render", path, "--width", str(width), "--height", str(height), "-t", "1", "--no-cache", "--json",
                              "-o", output, *arguments], capture_output=True, text=True, check=True)
        seconds = cpu_seconds(resource.RUSAGE_CHILDREN) - before
        bitmap = mi.Bitmap(output)
        values = np.array(bitmap, dtype=np.float64)
        names = [field.name for field in bitmap.struct_()]
        image = np.stack([values[:, :, next(k for k, n in enumerate(names) if n in (c, "root." + c))] for c in "RGB"], axis=2)
    report = json.loads(run.stdout)
    return image, seconds, report[0] if isinstance(report, list) else report


def references(program, path, width, height, folder):
    """Two images with independent errors."""
    import numpy as np
    stored = os.path.join(folder, re.sub(r"\W+", "_", os.path.abspath(path)) + f"_{width}x{height}.npz")
    if not os.path.exists(stored):
        render = mitsuba(path, width, height, PATH)
        theirs = np.mean([render(PART, 100 + part)[0][:, :, :3].astype(np.float64) for part in range(LONG // PART)], axis=0)
        ours = aureole(program, copy(path, folder), width, height, ["--integrator", "path", "--samples", str(LONG), "--seed", "77"])[0]
        np.savez(stored, ours=ours, theirs=theirs)
    both = np.load(stored)
    return both["ours"], both["theirs"]


def relative_mse(image, a, b):
    import numpy as np
    from scipy.ndimage import uniform_filter
    weights = np.array([0.2126, 0.7152, 0.0722])
    light = (a + b) / 2 @ weights
    scale = uniform_filter(np.abs(light), 5, mode="nearest") + 0.01 * light.mean()
    return float(np.mean(((image - a) @ weights) * ((image - b) @ weights) / scale**2))


def peer(path, width, height, samples, a, b, keep):
    """Seconds and error of Mitsuba's denoised image, means over three seeds."""
    import numpy as np
    render = mitsuba(path, width, height, FEATURES)
    render(samples, 999)
    seconds, errors = [], []
    for seed in (1, 2, 3):
        image, taken = render(samples, seed)
        start = cpu_seconds()
        clean = denoise(*(image[:, :, first:first + 3] for first in (0, 3, 6)))
        seconds.append(taken + cpu_seconds() - start)
        errors.append(relative_mse(clean.astype(np.float64), a, b))
    keep(clean, f"mitsuba-{samples}")
    return statistics.mean(seconds), statistics.mean(errors)


def ours(program, path, width, height, seconds, a, b, keep, options):
    """The error at equal seconds, and the integrator."""
    found, time = [], seconds / 8
    loading = aureole(program, path, 1, 1, ["--integrator", "path", "--samples", "1"])[1]
    while not found or found[-1][0] < seconds and time < 100 * seconds:
        image, taken, report = aureole(program, path, width, height, ["--time", f"{time}s", "--denoise", *options])
        taken -= loading
        if not found or taken > found[-1][0]:
            found.append((taken, relative_mse(image, a, b), report.get("integrator", ""), image))
        time *= 1.35
    keep(found[-1][3], f"aureole-{seconds:.3g}")
    if len(found) == 1:
        return found[0][1] * found[0][0] / seconds, found[0][2]
    (less, high, _, _), (more, low, integrator, _) = found[-2:]
    part = math.log(seconds / less) / math.log(more / less)
    return math.exp(math.log(high) + part * (math.log(low) - math.log(high))), integrator


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("aureole")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--samples", type=lambda text: [int(word) for word in text.split(",")], default=[16, 64])
    parser.add_argument("--folder", help="for references, and the denoised images in EXR")
    parser.add_argument("--option", action="append", default=[], help="a further option of aureole render")
    given = parser.parse_args()
    import mitsuba as mi
    mi.set_variant("llvm_ad_rgb")
    ratios = []
    print("| scene | samples | seconds | Mitsuba | Aureole | ratio | integrator |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.folder or scratch
        for text in given.scenes:
            path, width, height, name = split(text)
            a, b = references(given.aureole, path, width, height, folder)
            if not 0.99 < a.mean() / b.mean() < 1.01:
                print(f"| {name} | the references' means differ: {a.mean():.4g}, {b.mean():.4g} |", flush=True)
            for samples in given.samples:
                def keep(image, what):
                    if given.folder:
                        mi.Bitmap(image.astype("float32")).write(os.path.join(folder, f"{name.replace('/', '-')}-{samples}-{what}.exr"))
                seconds, theirs = peer(path, width, height, samples, a, b, keep)
                mine, integrator = ours(given.aureole, copy(path, folder), width, height, seconds, a, b, keep, given.option)
                ratios.append(mine / theirs)
                print(f"| {name} | {samples} | {seconds:.2f} | {theirs:.5f} | {mine:.5f} | {ratios[-1]:.2f} | {integrator[:60]} |", flush=True)
    print(f"{len(ratios)} ratios: median {statistics.median(ratios):.2f}, largest {max(ratios):.2f}")


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Image quality at equal CPU time: the measured Cornell box with final gathering, Aureole's path tracer and Mitsuba 3, each at full size
next to a reference, with its RMSE. Writes the images to docs/gallery and the section of docs/gallery.md that shows them.

    /tmp/peers/bin/python bench/peers/equal_time.py build/release/aureole [--seconds T] [--folder FOLDER]

Requires Mitsuba 3 and NumPy, like time_to_quality.py, whose scene, timing and warm-up it uses. For Mitsuba only the render
call is timed, for Aureole the whole process with loading and photon map. Each runs on one thread. Samples per pixel are extrapolated from
the time of a first image. The reference is the mean of two path-traced images, which FOLDER stores for later runs; its squared error,
a quarter of their mean squared difference, is subtracted.
"""
import argparse
import math
import os
import re
import subprocess
import tempfile

import drjit as dr
import mitsuba as mi
import numpy as np

import time_to_quality
from mitsuba_scene import change, read

ROOT = os.path.normpath(time_to_quality.ROOT)
SCENE = "scenes/cornell-box/cornell-box.xml"
SIDE = 256
PATH = "path:interleaved=true,rr_depth=4"
GATHER = "finalgather:photons=60000,photons_per_texel=24,diffuse_samples=16,edges=640,light_samples=4,share=true"
SECTION = "At equal time"


def read_image(path):
    return np.array(mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32), dtype=np.float64)


def reference(aureole, scene, folder, samples):
    halves = []
    for seed in (11, 12):
        path = os.path.join(folder, f"ref{seed}.exr")
        if not os.path.exists(path):
            subprocess.run([aureole, "render", scene, "-q", "-t", "1", "--sampler", "sobol", "--integrator", PATH, "--spp", str(samples), "--seed",
                            str(seed), "-o", path], check=True)
        halves.append(read_image(path))
    return (halves[0] + halves[1]) / 2, ((halves[0] - halves[1]) ** 2).mean() / 4


def samples_for(render, seconds, first, allowed):
    """The largest number of samples for the time, interpolated from measured times."""
    few, many = render(first, 1)[1], render(4 * first, 1)[1]
    each = max(many - few, 1e-3) / (3 * first)
    return max(allowed(math.floor((seconds - few) / each + first)), 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("aureole")
    parser.add_argument("--seconds", type=float, default=1.0)
    parser.add_argument("--samples", type=int, default=256, help="of each half of the reference")
    parser.add_argument("--folder")
    given = parser.parse_args()
    aureole = os.path.abspath(given.aureole)
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.folder or scratch
        scene = os.path.join(folder, "cornell-box.xml")
        with open(scene, "w", encoding="utf-8") as file:
            file.write(change(read(os.path.join(ROOT, SCENE)), rfilter="box", width=SIDE, height=SIDE))
        mi.set_variant("llvm_ad_rgb")
        reference_image, reference_error = reference(aureole, scene, folder, given.samples)
        rows = [("reference", "reference", "", "", reference_image, math.sqrt(reference_error) / reference_image.mean())]

        def whole(count):
            return count

        def square(count):
            return math.isqrt(max(count, 1)) ** 2

        def peer(samples, seed):  # each number of samples needs a kernel; a second thread reads and writes images
            time_to_quality.SAMPLES["cornell-box"] = (samples,)
            done = time_to_quality.mitsuba("llvm_ad_rgb", "multijitter", scene, 1)(samples, seed)
            dr.set_thread_count(2)
            return done

        for name, title, command, first, allowed, render in (
                ("finalgather", "final gathering", GATHER, 1, whole, time_to_quality.ours(aureole, GATHER, scene, 1)),
                ("path", "Aureole `path`", PATH, 1, whole, time_to_quality.ours(aureole, PATH, scene, 1)),
                ("mitsuba", f"Mitsuba {mi.__version__}", "path, multijitter, llvm_ad_rgb", 4, square, peer)):
            count = samples_for(render, given.seconds, first, allowed)
            image, seconds = render(count, 1)
            error = math.sqrt(max(((image - reference_image) ** 2).mean() - reference_error, 0)) / reference_image.mean()
            print(f"{name}: {count} samples per pixel, {seconds:.2f} s, {100 * error:.2f} %, mean {image.mean() / reference_image.mean():.4f}", flush=True)
            rows.append((name, title, command, f"{count} samples per pixel, {seconds:.2f} s", image, error))
        for name, _, _, _, image, _ in rows:
            exr = os.path.join(folder, "picture.exr")
            mi.Bitmap(image.astype(np.float32)).write(exr)
            subprocess.run([aureole, "convert", exr, os.path.join(ROOT, f"docs/gallery/equal-{name}.png"), "--exposure", "0.5"], check=True)
    text = [f"## {SECTION}", "",
            f"The measured Cornell box at {SIDE} x {SIDE} pixels in about {given.seconds:g} CPU second{'s' * (given.seconds != 1)} on one thread, by",
            "`bench/peers/equal_time.py`. For Mitsuba only the render call counts, for Aureole the whole process. The RMSE is relative to the mean;",
            "the squared error of the reference is subtracted.", "",
            "| " + " | ".join(title for _, title, *_ in rows) + " |", "|" + "---|" * len(rows),
            "| " + " | ".join(f"![{title}](gallery/equal-{name}.png)" for name, title, *_ in rows) + " |",
            "| " + " | ".join(f"RMSE {100 * row[5]:.2g} %" for row in rows) + " |",
            "| " + " | ".join(row[3] or f"{given.samples} samples per pixel, twice" for row in rows) + " |",
            "| " + " | ".join(f"`{row[2] or PATH}`" for row in rows) + " |", ""]
    page = os.path.join(ROOT, "docs/gallery.md")
    with open(page, encoding="utf-8") as file:
        old = file.read()
    parts = [part for part in re.split(r"(?m)^(?=## )", old) if not part.startswith(f"## {SECTION}\n")]
    parts.insert(1, "\n".join(text) + "\n")
    with open(page, "w", encoding="utf-8") as file:
        file.write("".join(parts))


if __name__ == "__main__":
    main()

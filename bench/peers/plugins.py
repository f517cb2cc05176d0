#!/usr/bin/env python3
"""Mitsuba 3's own test of pictures on a folder of scenes: does each of our pixels lie within the noise of Mitsuba's?
(needs `pip install mitsuba`)

    plugins.py PROGRAM [FOLDER] [--references FOLDER] [--only NAME]

FOLDER (bench/peers/plugins beside this file, if none is given) has scenes NAME.xml; those without a <sensor> of their own
or in what they include are parts of others. Their references, NAME.exr, and the variances of a sample, NAME_var.exr (both XYZ), are
looked for in the folder of references and made there by PyPI's Mitsuba where they are missing; without it they are made
each time. A pixel's channel is t = (ours - reference) / sqrt(s^2 / n + variance / m) off, for n pictures of ours with their
own variance s^2 and m samples of the reference. The test is two-sided, in XYZ, by Sidak's correction at 1 % over all channels
of a picture, as in Mitsuba's regression tests; by Student's t, since our variance is an estimate of its own.
"""
import argparse
import os
import subprocess
import sys
import tempfile

import mitsuba as mi
import numpy as np

from mitsuba3 import student_quantile

mi.set_variant("scalar_rgb")
RUNS, SAMPLES, THEIRS, SIGNIFICANCE = 16, 256, 4096, 0.01
TO_XYZ = np.array([[0.412453, 0.357580, 0.180423], [0.212671, 0.715160, 0.072169], [0.019334, 0.119193, 0.950227]])


def has_sensor(path):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    return "<sensor" in text or "<include" in text


def make_reference(path):
    """The mean and the variance of a sample of a scene, XYZ as the moments are."""
    scene = mi.load_file(path, spp=str(THEIRS))
    moments = mi.load_dict({"type": "moment", "nested": scene.integrator()})
    channels = np.array(mi.render(scene, integrator=moments, spp=THEIRS, seed=7), dtype=np.float64)
    mean, square = channels[:, :, -6:-3], channels[:, :, -3:]
    return mean, np.maximum(square - mean * mean, 0)


def read(path):
    return np.array(mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32), dtype=np.float64)


def reference(path, folder):
    name = os.path.splitext(os.path.basename(path))[0]
    files = [os.path.join(folder, name + end) for end in (".exr", "_var.exr")]
    if not all(os.path.exists(file) for file in files):
        for file, picture in zip(files, make_reference(path)):
            mi.Bitmap(picture.astype(np.float32)).write(file)
    return [read(file) for file in files]


def judge(name, pictures, mean, variance):
    pictures = np.array(pictures) @ TO_XYZ.T
    ours = pictures.mean(axis=0)
    deviation = np.sqrt(pictures.var(axis=0, ddof=1) / RUNS + variance / THEIRS)
    # What has no noise must agree by itself, to the rounding of single-precision sums.
    t = np.abs(ours - mean) / np.maximum(deviation, 1e-4 * np.abs(mean) + 1e-9)
    limit = student_quantile(1 - (1 - SIGNIFICANCE) ** (1 / t.size), RUNS - 1)
    good = t.max() <= limit
    print(f"| {name} | {mean.mean():.5f} | {100 * (ours.mean() / mean.mean() - 1):+.3f} % | {t.max():.2f} | {limit:.2f} | "
          f"{'agrees' if good else 'DIFFERS'} |", flush=True)
    return good


def render(options, path, seed, out):
    """What the program says of a scene it refuses, or None; its picture is in `out`."""
    with open(path, encoding="utf-8") as file:
        integrator = "volpath" if "<medium" in file.read() else "path"
    run = subprocess.run([options.program, "render", path, "-q", "--sampler", "random", "--seed", str(seed), "--integrator",
                          f"{integrator}:max_depth=8", "-D", f"spp={SAMPLES}", "-o", out],
                         capture_output=True, text=True, check=False)
    return None if run.returncode == 0 else run.stderr.strip().splitlines()[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", nargs="?", default=os.path.join(os.path.dirname(os.path.abspath(__file__)), "plugins"))
    parser.add_argument("--references")
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    good = True
    print(f"| scene | mean (Mitsuba {mi.__version__}) | difference | largest t | allowed | |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        references = options.references or scratch
        os.makedirs(references, exist_ok=True)
        for entry in sorted(os.listdir(options.folder)):
            path = os.path.join(options.folder, entry)
            name, ending = os.path.splitext(entry)
            if ending != ".xml" or name == "stage" or options.only not in name or not has_sensor(path):
                continue
            mean, variance = reference(path, references)
            out = os.path.join(scratch, "out.exr")
            pictures, refused = [], None
            for seed in range(RUNS):
                refused = refused or render(options, path, seed, out)
                pictures += [] if refused else [read(out)]
            if refused:
                print(f"| {name} | | | | | refused: {refused} |", flush=True)
            good = not refused and judge(name, pictures, mean, variance) and good
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Mitsuba 3's image test on a folder of scenes: tests whether each pixel is within the noise of Mitsuba's
(needs `pip install mitsuba`).

    plugins.py PROGRAM [FOLDER] [--references FOLDER] [--only NAME]

FOLDER (by default bench/peers/plugins next to this file) has scenes NAME.xml; those without a <sensor>, including included files,
are parts of others. Both programs render a scene with only the samples per pixel changed; Aureole renders NAME.ours.xml
if it exists. References NAME.exr, and variances of a sample NAME_var.exr (both XYZ), are read from the folder
of references and rendered with PyPI's Mitsuba if missing; without that option they are rendered every time.
The statistic of a channel of a pixel is t = (ours - reference) / sqrt(s^2 / n + variance / m), for n images of Aureole with variance s^2
and m samples of the reference. The test is two-sided, in XYZ, with Sidak's correction at 1 % over all channels
of an image, as in Mitsuba's regression tests, but with Student's t, since s^2 is estimated.

Mitsuba's `moment` gives the variance of a sample if pixels are plain means of independent samples. Otherwise
(other samplers, filters wider than a pixel, other integrators) it comes from n images of m / n samples. The channels of an
`aov` integrator are compared too. Mitsuba renders spectra that only its spectral mode supports in that mode, `directionalarea`
with `ptracer`, and filters wider than a pixel with `llvm_ad_rgb` (with an LLVM newer than 16 in DRJIT_LIBLLVM_PATH).
"""
import argparse
import os
import subprocess
import sys
import tempfile

import mitsuba as mi
import numpy as np

from mitsuba3 import student_quantile  # selects scalar_rgb

RUNS, SAMPLES, THEIRS, SIGNIFICANCE = 16, 256, 4096, 0.01
TO_XYZ = np.array([[0.412453, 0.357580, 0.180423], [0.212671, 0.715160, 0.072169], [0.019334, 0.119193, 0.950227]])


OURS = ".ours"
PARTS = ("place", "stage")  # included by other scenes
PARTICLES = 'type="directionalarea"'
# Mitsuba's spectral mode divides by 106.75026; its RGB mode and Aureole divide by the sum over the curve of Y, 106.85703.
SPECTRAL_EXCESS = 106.85703 / 106.75026
SPECTRAL = ('type="regular"', 'type="irregular"', 'type="blackbody"')


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def has_sensor(path):
    text = text_of(path)
    return "<sensor" in text or "<include" in text


def to_xyz(image):
    """Converts colors to XYZ; other channels are unchanged."""
    return np.concatenate([image[..., :3] @ TO_XYZ.T, image[..., 3:]], axis=-1)


def has_box(scene):
    return scene.sensors()[0].film().rfilter().class_name() == "BoxFilter"


def has_moments(scene):
    """Mitsuba's `moment` omits the weight of an irradiance meter's rays."""
    return (has_box(scene) and scene.sensors()[0].class_name() != "IrradianceMeter" and scene.sensors()[0].sampler().class_name() == "IndependentSampler" and
            scene.integrator().class_name() in ("PathIntegrator", "VolumetricPathIntegrator",
                                               "VolpathMisIntegratorImpl"))


def make_reference(path):
    """The names of an image's channels, colours first, as XYZ, their means and the variances of a sample."""
    mi.set_variant("scalar_spectral" if any(words in text_of(path) for words in SPECTRAL) else "scalar_rgb")
    scene = mi.load_file(path, **({"integrator": "ptracer"} if PARTICLES in text_of(path) else {}))
    if not has_box(scene):  # the scalar modes tabulate filters with 31 values, up to 3 % too wide
        mi.set_variant("llvm_ad_rgb")
        scene = mi.load_file(path)
    if has_moments(scene):
        moments = mi.load_dict({"type": "moment", "nested": scene.integrator()})
        channels = np.array(mi.render(scene, integrator=moments, spp=THEIRS, seed=7), dtype=np.float64)
        mean, square = channels[:, :, -6:-3], channels[:, :, -3:]
        return ["R", "G", "B"], mean, np.maximum(square - mean * mean, 0)
    images = np.array([mi.render(scene, spp=THEIRS // RUNS, seed=seed + 7) for seed in range(RUNS)], dtype=np.float64)
    # Aureole has no channels of `moment`.
    further = images.shape[-1] - 3 if scene.integrator().class_name() == "AOVIntegrator" else 0
    names = scene.integrator().aov_names()[-further:] if further > 0 else []
    order = sorted(range(further), key=lambda k: names[k].rsplit(".", 1)[0])  # as in files: channels of a name keep their order
    images /= SPECTRAL_EXCESS if mi.variant() == "scalar_spectral" else 1
    images = to_xyz(images[..., [0, 1, 2] + [3 + k for k in order]])
    variance = images.var(axis=0, ddof=1) * (THEIRS // RUNS)
    return ["R", "G", "B"] + [names[k] for k in order], images.mean(axis=0), variance


def read(path):
    bitmap = mi.Bitmap(path)
    if bitmap.pixel_format() != mi.Bitmap.PixelFormat.MultiChannel:
        bitmap = bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32)
    return np.array(bitmap, dtype=np.float64)


def reference(path, folder):
    name = os.path.splitext(os.path.basename(path))[0]
    files = [os.path.join(folder, name + end) for end in (".exr", "_var.exr")]
    if not all(os.path.exists(file) for file in files):
        names, *images = make_reference(path)
        for file, image in zip(files, images):
            mi.Bitmap(image.astype(np.float32), channel_names=names).write(file)
    return [read(file) for file in files]


def judge(name, images, mean, variance):
    images = to_xyz(np.array(images))
    ours = images.mean(axis=0)
    variance_of_ours = images.var(axis=0, ddof=1) / RUNS
    # Without variance, rare contributions such as a filter's tail may have been missed.
    missed = np.abs(mean).max(axis=(0, 1)) / (RUNS * SAMPLES)
    deviation = np.sqrt(np.where(variance_of_ours > 0, variance_of_ours, missed ** 2) + variance / THEIRS)
    # Values without noise must agree up to the rounding of single-precision sums.
    t = np.abs(ours - mean) / np.maximum(deviation, 1e-4 * np.abs(mean) + 1e-6)
    limit = student_quantile(1 - (1 - SIGNIFICANCE) ** (1 / t.size), RUNS - 1)
    good = t.max() <= limit
    print(f"| {name} | {mean[..., :3].mean():.5f} | {100 * (ours[..., :3].mean() / mean[..., :3].mean() - 1):+.3f} % | "
          f"{t.max():.2f} | {limit:.2f} | {'agrees' if good else 'DIFFERS'} |", flush=True)
    return good


def render(options, path, seed, out):
    """The program's error message for a scene that it rejects, or None with the image in `out`."""
    run = subprocess.run([options.program, "render", path, "-q", "--seed", str(seed), "--spp", str(SAMPLES), "-o", out],
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
            if ending != ".xml" or name.endswith(OURS) or name in PARTS or options.only not in name or not has_sensor(path):
                continue
            ours = os.path.join(options.folder, name + OURS + ".xml")
            mean, variance = reference(path, references)
            out = os.path.join(scratch, "out.exr")
            images, refused = [], None
            for seed in range(RUNS):
                refused = refused or render(options, ours if os.path.exists(ours) else path, seed, out)
                images += [] if refused else [read(out)]
            if refused:
                print(f"| {name} | | | | | refused: {refused} |", flush=True)
            good = not refused and judge(name, images, mean, variance) and good
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Errors and CPU seconds of Mitsuba 3's images after Open Image Denoise, for `aureole-bench adaptive-speed`.

    denoised.py NAME WIDTHxHEIGHT REFERENCE_A.pfm REFERENCE_B.pfm ERROR SECONDS

Requires the packages of time_to_quality.py, and PyPI's pyoidn. Renders the scene with that name (see there) with llvm_ad_rgb, multi-jittered
samples, and albedo and normals, with 4, 16, 64, ... samples per pixel, and denoises, until the error is below ERROR or the next
image would take more than SECONDS. Prints a line per image: samples, CPU seconds of rendering and denoising (without kernel compilation), and
the error: the root of the mean of (x - a)(x - b), relative to the mean of the references a and b, whose errors are independent.
"""
import math
import os
import re
import sys
import tempfile

import time_to_quality as peers

FEATURES = '<integrator type="aov"><string name="aovs" value="albedo:albedo,normal:sh_normal"/>'


def read_pfm(path):
    import numpy as np
    with open(path, "rb") as file:
        file.readline()
        width, height = (int(word) for word in file.readline().split())
        order = "<f4" if float(file.readline()) < 0 else ">f4"
        return np.frombuffer(file.read(), order).reshape(height, width, 3)[::-1].astype(np.float64)


def load(name, width, height):
    import mitsuba as mi
    path, _, _, definitions = (peers.SCENES | peers.BUNDLED)[name]
    text = peers.scene_text(path, width, height, definitions)
    text = re.sub(r'<sampler\s+type="[^"]*"', '<sampler type="multijitter"', text)
    return mi.load_string(re.sub(r"(<integrator.*?</integrator>)", FEATURES + r"\1</integrator>", text, flags=re.S))


def main():
    import mitsuba as mi
    import numpy as np
    import pyoidn
    name, size, a, b = sys.argv[1:5]
    target, limit = (float(word) for word in sys.argv[5:7])
    width, height = (int(side) for side in size.split("x"))
    a, b = read_pfm(a), read_pfm(b)
    mi.set_variant("llvm_ad_rgb")
    scene = load(name, width, height)
    import drjit as dr  # after loading, see time_to_quality.py
    dr.set_thread_count(1)
    samples, spent = 4, 0.0
    while 4.0 * spent < limit:
        np.array(mi.render(scene, spp=samples, seed=999))  # compiles the kernels
        start = peers.cpu_seconds()
        image = np.array(mi.render(scene, spp=samples, seed=1), dtype=np.float32)
        parts = [np.ascontiguousarray(image[:, :, first:first + 3]) for first in (0, 3, 6)]
        clean = pyoidn.denoise(*parts, hdr=True).astype(np.float64)
        spent = peers.cpu_seconds() - start
        error = math.sqrt(max(((clean - a) * (clean - b)).mean(), 0.0)) / ((a.mean() + b.mean()) / 2)
        print(samples, spent, error, flush=True)
        if error <= target:
            break
        samples *= 4


if __name__ == "__main__":
    main()

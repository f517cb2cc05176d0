#!/usr/bin/env python3
"""Errors and CPU seconds of Mitsuba 3's images after Open Image Denoise, for `aureole-bench adaptive-speed`.

    denoised.py NAME WIDTHxHEIGHT REFERENCE_A.pfm REFERENCE_B.pfm ERROR SECONDS

Requires the packages of time_to_quality.py, and Open Image Denoise 2 in AUREOLE_OIDN. Renders the scene with that name (see there) with llvm_ad_rgb, multi-jittered
samples, and albedo and normals, with 4, 16, 64, ... samples per pixel, and denoises, until the error is below ERROR or the next
image would take more than SECONDS. Prints a line per image: samples, CPU seconds of rendering and denoising (without kernel compilation), and
the error: the root of the mean of (x - a)(x - b), relative to the mean of the references a and b, whose errors are independent.
"""
import ctypes
import math
import os
import sys

import time_to_quality as peers
from mitsuba_scene import PATH, change, cpu_seconds, read

FEATURES = f'<integrator type="aov"><string name="aovs" value="albedo:albedo,normal:sh_normal"/>{PATH}</integrator>'


def denoise(*images):
    """Color, denoised by the library in AUREOLE_OIDN with albedo and normals, all [height][width][3]; as cli/render/oidn.c does."""
    import numpy as np
    library = ctypes.CDLL(os.environ["AUREOLE_OIDN"])
    handle, size = ctypes.c_void_p, ctypes.c_size_t
    library.oidnNewDevice.restype = library.oidnNewFilter.restype = handle
    library.oidnNewFilter.argtypes = [handle, ctypes.c_char_p]
    library.oidnSetSharedFilterImage.argtypes = [handle, ctypes.c_char_p, handle, ctypes.c_int] + [size] * 5
    library.oidnSetFilterBool.argtypes = [handle, ctypes.c_char_p, ctypes.c_bool]
    cpu, float3 = 1, 3
    device = handle(library.oidnNewDevice(cpu))
    library.oidnCommitDevice(device)
    kernel = handle(library.oidnNewFilter(device, b"RT"))
    images = [np.ascontiguousarray(image, dtype=np.float32) for image in images]
    images.append(np.empty_like(images[0]))
    height, width, _ = images[0].shape
    for name, image in zip((b"color", b"albedo", b"normal", b"output"), images):
        library.oidnSetSharedFilterImage(kernel, name, image.ctypes.data, float3, width, height, 0, 12, 12 * width)
    library.oidnSetFilterBool(kernel, b"hdr", True)
    for call in (library.oidnCommitFilter, library.oidnExecuteFilter, library.oidnReleaseFilter):
        call(kernel)
    library.oidnReleaseDevice(device)
    return images[-1]


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
    return mi.load_string(change(read(path, definitions), FEATURES, "multijitter", "box", width, height))


def main():
    import mitsuba as mi
    import numpy as np
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
        start = cpu_seconds()
        image = np.array(mi.render(scene, spp=samples, seed=1), dtype=np.float32)
        clean = denoise(*(image[:, :, first:first + 3] for first in (0, 3, 6))).astype(np.float64)
        spent = cpu_seconds() - start
        error = math.sqrt(max(((clean - a) * (clean - b)).mean(), 0.0)) / ((a.mean() + b.mean()) / 2)
        print(samples, spent, error, flush=True)
        if error <= target:
            break
        samples *= 4


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Writes data/hosek_wilkie_sky.txt and data/hosek_wilkie_sun.txt: scripts/hosek_wilkie.py DATA.

Both come from the package mitsuba of PyPI, which holds the authors' own tables of the sky (mitsuba/data/sunsky, 3-clause BSD) and
evaluates the sun; the scale is that of its RGB images: what a spectrum of the model gives, over the integral of CIE's Y."""

import struct
import sys
from pathlib import Path

import mitsuba
import numpy as np

mitsuba.set_variant("scalar_rgb")
TURBIDITIES, ALBEDOS, CONTROL_POINTS, ELEVATIONS = 10, 2, 6, 30
LICENCE = "# Copyright (c) 2012 - 2013, Lukas Hosek and Alexander Wilkie; 3-clause BSD licence, whose text is in LICENSE.\n#\n"


def tensors(path):
    """The tensors of a file of Mitsuba's, by name."""
    data = path.read_bytes()
    count, at, found = struct.unpack_from("<I", data, 14)[0], 18, {}
    for _ in range(count):
        (length,) = struct.unpack_from("<H", data, at)
        name = data[at + 2 : at + 2 + length].decode()
        dimensions, kind, offset = struct.unpack_from("<HBQ", data, at + 2 + length)
        at += 13 + length
        shape = struct.unpack_from(f"<{dimensions}Q", data, at)
        at += 8 * dimensions
        if kind == 11:  # double
            found[name] = np.frombuffer(data, "<f8", int(np.prod(shape)), offset).reshape(shape)
    return found


def radiance(sky, direction):
    surface = mitsuba.SurfaceInteraction3f()
    surface.wi = mitsuba.Vector3f(*-direction)
    return np.array(sky.eval(surface), dtype=float)


def sun_of(turbidity, elevation):
    sun = np.array([np.cos(elevation), 0.0, np.sin(elevation)])
    keys = {"turbidity": turbidity, "sun_direction": list(sun), "sky_scale": 0.0}
    return radiance(mitsuba.load_dict({"type": "sunsky", **keys}), sun)


def write_sky(folder):
    found = tensors(Path(mitsuba.__file__).parent / "data/sunsky/sunsky_datasets.bin")
    with open(folder / "hosek_wilkie_sky.txt", "w", encoding="ascii") as file:
        file.write("# The sky of Hosek and Wilkie 2012, ACM Transactions on Graphics 31(4), 95, in sRGB's primaries.\n" + LICENCE)
        file.write("# Format: for turbidities 1 to 10, albedos 0 and 1, six control points over the sun's elevation, and R, G, B in\n")
        file.write("# turn a line: the nine parameters of the distribution and the mean radiance, W/m^2/sr/nm.\n")
        for index in np.ndindex(TURBIDITIES, ALBEDOS, CONTROL_POINTS, 3):
            row = [*found["sky_params_rgb"][index], found["sky_rad_rgb"][index]]
            file.write(" ".join(f"{value:.9g}" for value in row) + "\n")


def write_sun(folder):
    with open(folder / "hosek_wilkie_sun.txt", "w", encoding="ascii") as file:
        file.write("# The sun of Hosek and Wilkie 2013, IEEE Computer Graphics and Applications 33(3), 44-52, in sRGB's primaries.\n")
        file.write(LICENCE)
        file.write("# Format: for turbidities 1 to 10 and elevations of 2, 5, ... 89 degrees a line: the mean radiance of a disk of .5358\n")
        file.write("# degrees, R, G, B, over the integral of CIE's Y.\n")
        for turbidity in range(1, TURBIDITIES + 1):
            for k in range(ELEVATIONS):
                file.write(" ".join(f"{value:.8g}" for value in sun_of(turbidity, np.radians(2 + 3 * k))) + "\n")


if __name__ == "__main__":
    write_sky(Path(sys.argv[1]))
    write_sun(Path(sys.argv[1]))

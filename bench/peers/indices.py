#!/usr/bin/env python3
"""HEALPix pixels of directions and back, compared with healpy; rotations of a crystal and their fundamental zone, with orix.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install healpy orix
    PYTHONPATH=build/release/python /tmp/peers/bin/python bench/peers/indices.py     # writes the tables of bench/peers/indices.md

Speeds are millions per CPU second on one thread, the best of five calls. Sets of a zone are expanded by the 24 rotations of the cube and
measured by `aureole.measure`; values are scaled by powers of N as in sets.py. Pixels and zones must be the same, or the program fails.
"""
import os
import sys
import time
import warnings

for _name in "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS":
    os.environ[_name] = "1"

import aureole
import healpy
import numpy as np
import orix
from orix.quaternion import Orientation, symmetry
from orix.sampling import get_sample_fundamental

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "indices.md")
BEGIN, END = "<!-- bench/peers/indices.py writes from here -->", "<!-- to here -->"


def rate(count, function):
    """The result, and millions per CPU second."""
    seconds = []
    for _ in range(5):
        start = time.process_time()
        found = function()
        seconds.append(time.process_time() - start)
    return found, count / min(seconds) / 1e6


def row(what, *values):
    return "| " + " | ".join([what, *(f"{value:.3g}" for value in values)]) + " |"


def pixels():
    xyz = aureole.points("random", 10**6, domain="sphere")
    lines = ["| HEALPix | ours, M/s | healpy, M/s |", "|---|---|---|"]
    for side in (64, 2**29):
        for nested in (False, True):
            ours, speed = rate(len(xyz), lambda: aureole.healpix_pixels(xyz, side, nested=nested))
            theirs, other = rate(len(xyz), lambda: healpy.vec2pix(side, *xyz.T, nest=nested))
            assert (ours == theirs.astype(np.uint64)).all(), f"side {side}: other pixels"
            lines.append(row(f"pixels of directions, side {side}, {'nested' if nested else 'ring'}", speed, other))
    side = 256
    n = 12 * side * side
    for nested in (False, True):
        name = "healpix:order=nested" if nested else "healpix"
        ours, speed = rate(n, lambda: aureole.points(name, n, domain="sphere"))
        theirs, other = rate(n, lambda: np.stack(healpy.pix2vec(side, np.arange(n), nest=nested), 1))
        assert abs(ours - theirs).max() < 1e-15 and (aureole.healpix_pixels(ours, side, nested=nested) == np.arange(n)).all()
        lines.append(row(f"centres, side {side}, {'nested' if nested else 'ring'}", speed, other))
    return lines


def expanded(zone):
    """Products of the zone's rotations with the group, w >= 0."""
    w, v = zone[:, None, :1], zone[:, None, 1:]
    group = aureole.symmetry_group("432")[None]
    a, b = group[..., :1], group[..., 1:]
    product = np.concatenate([a * w - (b * v).sum(-1, keepdims=True), a * v + w * b + np.cross(b, v)], -1).reshape(-1, 4)
    return product * np.where(product[:, :1] < 0, -1, 1)


def crystals():
    lines = ["| rotations of a cubic crystal (432) | rotations of the zone | energy, N^2/3 | smallest angle, N^1/3 | covering, N^1/3 | M/s |",
             "|---|---|---|---|---|---|"]
    ways = [(f"ours: {name}", lambda name=name: aureole.points(name, 24 * 160, domain="rotations", symmetry="432"))
            for name in ("super-fibonacci", "esfg-rotations")]
    ways += [(f"orix: get_sample_fundamental, {method}", lambda method=method, angle=angle:
              get_sample_fundamental(angle, point_group=symmetry.O, method=method).data)
             for method, angle in (("cubochoric", 17.5), ("haar_euler", 16.5), ("quaternion", 16.5))]
    for name, make in ways:
        zone, speed = rate(1, make)
        every = expanded(np.ascontiguousarray(zone, dtype=float))
        n = len(every)
        scaled = [float(np.squeeze(aureole.measure(every, metric, domain="rotations"))) * n**power
                  for metric, power in (("energy", 2 / 3), ("min-angle", 1 / 3), ("covering", 1 / 3))]
        lines.append(row(name, len(zone), *scaled, speed * len(zone)))
    return lines


def zones():
    wxyz = aureole.points("random", 10**5, domain="rotations")
    ours, speed = rate(len(wxyz), lambda: aureole.symmetry_reduce(wxyz, "432"))
    orientations = Orientation(wxyz, symmetry=symmetry.O)
    theirs, other = rate(len(wxyz), orientations.reduce)
    assert abs(np.abs(ours[:, 0]) - np.abs(theirs.data[:, 0])).max() < 1e-12, "other zones"
    return ["| fundamental zone | ours, M/s | orix, M/s |", "|---|---|---|", row("10^5 rotations reduced by 432", speed, other)]


def main():
    warnings.simplefilter("ignore")
    head, tail = open(PAGE).read().split(BEGIN)[0], open(PAGE).read().split(END)[1]
    lines = []
    for part in (pixels, crystals, zones):
        lines += ["", *part()]
        print(*lines[-8:], sep="\n", file=sys.stderr)
    open(PAGE, "w").write(head + BEGIN + "\n" + "\n".join(lines) + "\n\n" + END + tail)


if __name__ == "__main__":
    main()

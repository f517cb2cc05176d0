"""How even are the points of other programs? Aureole's measures of points from files, beside sets of its own.

    python other_points.py pbrt-v4/src/pbrt/util/pmj02tables.cpp      # pbrt's tables: 5 sets of 65536 points of the square
    openqmc generate pmj > pmj.csv && python other_points.py pmj.csv  # OpenQMC's tool: rows of 8 coordinates
    python other_points.py mine.npy                                   # any .csv or .npy

Prints the L2 star discrepancy and the least distance of the first N points, N = 64, 256, 1024, of each set: the first two
coordinates where there are more.
"""

import re
import sys

import numpy as np

import aureole

MEASURES = ["l2-star", "min-distance"]


def pbrt_tables(text):
    """pmj02bnSamples[5][65536][2] of pbrt: whole numbers of 32 bits, of which 2^-32 is the unit."""
    body = text[text.index("{", text.index("pmj02bnSamples")) :]
    numbers = np.array([int(word, 0) for word in re.findall(r"0x[0-9a-fA-F]+|\b[0-9]+", body)], dtype=np.float64)
    sets = len(re.findall(r"\{\s*\{\s*\{|\}\s*,\s*\{\s*\{", body))  # each set opens one brace before its first point
    return numbers.reshape(max(1, sets), -1, 2) * 2.0**-32


def openqmc_table(text):
    """Rows of numbers with commas, one point a row; the tool prints several sets of 256 points one after the other."""
    rows = np.array([[float(word) for word in line.split(",")] for line in text.split()])
    return rows.reshape(-1, min(256, len(rows)), rows.shape[1])[:, :, :2]


def load(path):
    if path.endswith(".npy"):
        return aureole.read(path)[0][np.newaxis, :, :2]
    with open(path) as file:
        text = file.read()
    if "pmj02bnSamples" in text:
        return pbrt_tables(text)
    if re.match(r"\s*[a-z]", text):  # a header: Aureole's own form
        return aureole.read(path)[0][np.newaxis, :, :2]
    return openqmc_table(text)


def row(name, count, points):
    figures = aureole.measure(points, MEASURES, domain="square")
    print(f"{name:32} {count:6} " + " ".join(f"{value:12.6g}" for value in figures.values()))


print(f"{'points':32} {'N':>6} " + " ".join(f"{name:>12}" for name in MEASURES))
for path in sys.argv[1:]:
    for index, points in enumerate(load(path)):
        for count in (n for n in (64, 256, 1024) if n <= len(points)):
            row(f"{path.rsplit('/', 1)[-1]}, set {index}", count, points[:count])
for name, options in {"sobol": {"scramble": "owen"}, "bnot": {}, "larcher-pillichshammer": {}}.items():
    for count in (64, 256):
        row(name, count, aureole.points(name, count, domain="square", **options))

#!/usr/bin/env python3
"""Integrals over directions from four fields, with Aureole's points and weights and those of other packages.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install scipy healpy soprano
    /tmp/peers/bin/python bench/peers/fields.py [--program build/release/aureole]   # writes the table of bench/peers/fields.md
    /tmp/peers/bin/python bench/peers/fields.py --check                             # compares it, without missing packages

- powder: the free induction decay of a powder (magnetic resonance) after a time at which the anisotropy has turned the phase by
  12 radians, with the asymmetry .5: the mean of cos(12 (3 z^2 - 1 + .5 (x^2 - y^2)) / 2).
- cylinder: the form factor of a rod of length 400 and radius 20 angstroms at q = .1 (small-angle scattering), averaged over the
  directions of its axis.
- window: the solid angle of a square of side 1 seen from a height of 1/2 above its middle, a sixth of the sphere (transport from
  a point through a window): 1 inside, 0 outside.
- ambisonics: the channels to degree 5 of a source as wide as exp(8 (cos - 1)): the length of the error of all 36 channels over
  that of the channels.

Errors are relative to the integral, root mean squares over 64 random rotations of the rule, the same for all, so that nothing depends on
how a rule lies. Rules of other sizes have the one nearest to N (ZCW of soprano: the next).
"""
import argparse
import importlib
import os
import sys

for _name in "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS":
    os.environ[_name] = "1"

import numpy as np

import makers

HERE = os.path.dirname(os.path.abspath(__file__))
SIZES = 194, 770
ROTATIONS = 64


def bessel_j1_over(x):
    """2 J1(x) / x, by its integral form with equally spaced angles: exact up to rounding below x = 100."""
    t = (np.arange(256) + 0.5) * np.pi / 256
    return 2 * np.mean(np.sin(t) ** 2 * np.cos(np.multiply.outer(x, np.cos(t))), axis=-1)


def powder(x):
    return np.cos(6 * (3 * x[:, 2] ** 2 - 1 + 0.5 * (x[:, 0] ** 2 - x[:, 1] ** 2)))


def cylinder(x):
    q, length, radius = 0.1, 400.0, 20.0
    along = 0.5 * q * length * x[:, 2]
    return (np.sinc(along / np.pi) * bessel_j1_over(q * radius * np.sqrt(np.maximum(0, 1 - x[:, 2] ** 2)))) ** 2


def window(x):
    return (x[:, 2] > np.maximum(abs(x[:, 0]), abs(x[:, 1]))).astype(float)


def product_rule(degree):
    """Gauss-Legendre heights times equally spaced azimuths, exact to the degree."""
    heights, weights = np.polynomial.legendre.leggauss(degree // 2 + 1)
    phi = 2 * np.pi * np.arange(degree + 1) / (degree + 1)
    z, radius = np.repeat(heights, len(phi)), np.repeat(np.sqrt(1 - heights**2), len(phi))
    x = np.column_stack([radius * np.tile(np.cos(phi), len(heights)), radius * np.tile(np.sin(phi), len(heights)), z])
    return x, np.repeat(weights / 2, len(phi)) / len(phi)


def harmonics(x, degree):
    """Real spherical harmonics of mean square 1, one per column, from Legendre functions by recurrence."""
    z, columns = x[:, 2], []
    across = x[:, 0] + 1j * x[:, 1]
    for m in range(degree + 1):
        below, here = np.zeros(len(x)), np.full(len(x), np.sqrt(np.prod([(2 * k + 1) / (2 * k) for k in range(1, m + 1)])))
        for l in range(m, degree + 1):
            parts = (across**m).real, (across**m).imag
            columns += [here * parts[0] * (np.sqrt(2) if m else 1)] + ([here * parts[1] * np.sqrt(2)] if m else [])
            a = np.sqrt((2 * l + 3) * (2 * l + 1) / ((l + 1 - m) * (l + 1 + m)))
            b = np.sqrt((2 * l + 3) * (l - m) * (l + m) / ((2 * l - 1) * (l + 1 - m) * (l + 1 + m))) if l > m else 0.0
            below, here = here, a * z * here - b * below
    return np.column_stack(columns)


def ambisonics(x, weights, reference=None):
    channels = (weights * np.exp(8 * (x[:, 2] - 1))) @ harmonics(x, 5)
    return channels if reference is None else np.linalg.norm(channels - reference) / np.linalg.norm(reference)


def references():
    x, weights = product_rule(301)
    return {"powder": weights @ powder(x), "cylinder": weights @ cylinder(x), "window": 1 / 6, "ambisonics": ambisonics(x, weights)}


def rotations():
    random = np.random.default_rng(1)
    for _ in range(ROTATIONS):
        q, r = np.linalg.qr(random.normal(size=(3, 3)))
        yield q * np.sign(np.diag(r))


def errors(x, weights, exact):
    """Errors in the four fields."""
    squares = np.zeros(4)
    for turn in rotations():
        y = x @ turn
        found = [weights @ field(y) / exact[field.__name__] - 1 for field in (powder, cylinder, window)]
        squares += np.square(found + [ambisonics(y, weights, exact["ambisonics"])])
    return np.sqrt(squares / ROTATIONS)


def from_points(name):
    """A row of makers.MAKERS with its weights, or equal weights."""
    maker = next(m for m in makers.MAKERS if m.domain == "sphere" and m.name == name)

    def make(n):
        points = maker.make(n, 1)
        return points[:, :3], points[:, 3] if points.shape[1] > 3 else np.full(len(points), 1 / len(points))
    return maker.package, make


def with_weights(method, *set_and_options):
    def make(n):
        rows = makers.read_csv("weights", *set_and_options, "-n", str(n), "--domain", "sphere", "--method", method, "-q")
        return rows[:, :3], rows[:, 3]
    return None, make


def make_zcw(n):
    x, weights = importlib.import_module("soprano.calculate.powder").ZCW("sphere").get_orient_points(n)
    return x, weights


RULES = {
    "`spherical-fibonacci`": from_points("spherical-fibonacci"),
    "`spherical-fibonacci`, exact weights": with_weights("exact", "spherical-fibonacci"),
    "`electrostatic` (REPULSION)": from_points("electrostatic"),
    "`electrostatic`, exact weights": with_weights("exact", "electrostatic"),
    "`t-design`": from_points("t-design"),
    "`lebedev`": from_points("lebedev"),
    "`sobol`, Owen": from_points("sobol, Owen"),
    "`sobol`, Owen, exact weights": with_weights("exact", "sobol", "--scramble", "owen", "--seed", "1"),
    "`random`": from_points("random"),
    "SciPy: lebedev_rule": from_points("lebedev_rule"),
    "SciPy: Sobol, scrambled, by Lambert's map": from_points("Sobol, scrambled, by Lambert's map"),
    "healpy: pixel centres": from_points("pixel centres, in rings"),
    "soprano: ZCW": ("soprano", make_zcw),
    "Gauss times equal azimuths": (None, lambda n: product_rule(2 * round(np.sqrt(n / 2)) - 1)),
}


def lines(sizes, only_ours=False):
    """Lines of the table, and the names of missing packages."""
    exact, missing = references(), []
    table = ["| points and weights | N | powder | cylinder | window | ambisonics |", "|---|---|---|---|---|---|"]
    for n in sizes:
        for name, (package, make) in RULES.items():
            if package is not None and (only_ours or importlib.util.find_spec(package) is None):
                missing.append(name)
                continue
            x, weights = make(n)
            if abs(len(x) - n) < n / 2:
                found = (f"{error:.2g}" if error > 1e-14 else "< 1e-14" for error in errors(x, weights, exact))
                table.append(f"| {name} | {len(x)} | " + " | ".join(found) + " |")
    return table, missing


def agree(expected, found):
    """Whether the errors of two lines are equal up to rounding: within 2 % or below 1e-12."""
    a, b = ([cell.strip("< ") for cell in line.split("|")[1:-1]] for line in (expected, found))
    return a[:2] == b[:2] and all(
        abs(float(p) - float(q)) <= 0.02 * float(q) or max(float(p), float(q)) < 1e-12 for p, q in zip(a[2:], b[2:]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/aureole")
    parser.add_argument("--page", default=os.path.join(HERE, "fields.md"))
    parser.add_argument("--check", action="store_true", help="compare the page's table with today's")
    parser.add_argument("--ours", action="store_true", help="with --check: only what needs no other package")
    parser.add_argument("--sizes", default=",".join(map(str, SIZES)), help="with --check: only these N")
    arguments = parser.parse_args()
    makers.program = arguments.program
    begin, end = "<!-- bench/peers/fields.py writes from here -->", "<!-- to here -->"
    with open(arguments.page) as file:
        text = file.read()
    table, missing = lines([int(n) for n in arguments.sizes.split(",")], arguments.check and arguments.ours)
    if not arguments.check:
        if missing:
            sys.exit("not installed: " + ", ".join(sorted(set(missing))))
        with open(arguments.page, "w") as file:
            file.write(text.split(begin)[0] + begin + "\n\n" + "\n".join(table) + "\n\n" + end + text.split(end)[1])
        return 0
    expected = [line for line in text.split(begin)[1].split(end)[0].splitlines() if line.startswith("|")]
    status = 0
    for line in table[2:]:
        name = line.split("|")[1:3]
        same = [other for other in expected if other.split("|")[1:3] == name]
        if not same or not agree(same[0], line):
            print(f"{arguments.page} has {same}, found {line}")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Writes data/lebedev.txt and data/lebedev_rules.txt: quadrature of the sphere with octahedral symmetry.

usage: scripts/lebedev_table.py

Such a rule is a union of orbits of the octahedral group, each with one weight (Lebedev 1976; Lebedev and Laikov
1999). The starting values are those of scipy.integrate.lebedev_rule. Newton's method then solves the equations of
all harmonics that the symmetry leaves, P_lm(z) cos(m phi) with l even and m a multiple of 4: their residuals are
computed with 40 digits and the steps in double precision. Needs NumPy, SciPy 1.15 and mpmath.
"""
import mpmath
import numpy as np
import scipy.integrate
import tables

DEGREES = [3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31, *range(35, 132, 6)]
SIZES = [6, 12, 8, 24, 24, 48]
DIGITS = 40
STEPS = 12
RESIDUAL = 1e-28
ORDERS = [(0, 1, 2), (1, 2, 0), (2, 0, 1)]

mpmath.mp.dps = DIGITS
exact = np.vectorize(mpmath.mpf, otypes=[object])
root = np.vectorize(mpmath.sqrt, otypes=[object])


def harmonics(degree, x, y, z, sqrt):
    """P_lm(z) Re (x + i y)^m, orthonormal for the mean over the sphere but for sqrt 2, and their gradients as
    polynomials of x, y, z; one row for each even l and m = 0, 4, .."""
    values, slopes = [], []
    one = z * 0 + 1
    real, imaginary, before_real, before_imaginary = one, one * 0, one * 0, one * 0
    scale = one[0]
    for m in range(degree + 1):
        if m > 0:
            before_real, before_imaginary = real, imaginary
            real, imaginary = x * real - y * imaginary, x * imaginary + y * real
            scale = scale * sqrt(one[0] * (2 * m + 1) / (2 * m))
        if m % 4:
            continue
        last, here, last_slope, slope = one * 0, one * scale, one * 0, one * 0
        for l in range(m, degree + 1):
            if l % 2 == 0:
                values.append(here * real)
                slopes.append([m * here * before_real, -m * here * before_imaginary, slope * real])
            a = sqrt(one[0] * (2 * l + 1) * (2 * l + 3) / ((l + 1 - m) * (l + 1 + m)))
            b = sqrt(one[0] * (2 * l + 3) * (l - m) * (l + m) / ((2 * l - 1) * (l + 1 - m) * (l + 1 + m)))
            last, here, last_slope, slope = (here, a * z * here - b * last, slope,
                                             a * (here + z * slope) - b * last_slope)
    return np.array(values), np.array(slopes)


def orbits_of(degree):
    """The corners x >= y >= z >= 0 of the orbits, their kinds and the weights of whole orbits (of sum 1)."""
    points, weights = scipy.integrate.lebedev_rule(degree)
    corners = {}
    for corner, weight in zip(np.sort(np.abs(points.T), axis=1)[:, ::-1], weights):
        corners.setdefault(tuple(np.round(corner, 7)), (corner, weight))
    rows = []
    for corner, weight in corners.values():
        zeros, equal = np.sum(corner < 1e-7), [corner[0] - corner[1] < 1e-7, corner[1] - corner[2] < 1e-7]
        kind = (0 if zeros == 2 else 1 if zeros == 1 and equal[0] else 2 if all(equal) else 4 if zeros == 1 else
                3 if any(equal) else 5)
        rows.append((kind, equal[0], corner, weight / (4 * np.pi) * SIZES[kind]))
    return sorted(rows, key=lambda row: (row[0], -row[2][0], -row[2][1]))


def corner_of(kind, equal_first, free):
    """The corner with the free coordinates of its kind (two for the general one), with all digits."""
    if kind < 3:
        n = kind + 1
        return [1 / mpmath.sqrt(n)] * n + [mpmath.mpf(0)] * (3 - n), []
    a, zero = free[0], mpmath.mpf(0)
    if kind == 3:
        other = mpmath.sqrt(1 - 2 * a * a)
        return ([a, a, other], [[1, 1, -2 * a / other]]) if equal_first else ([other, a, a], [[-2 * a / other, 1, 1]])
    if kind == 4:
        other = mpmath.sqrt(1 - a * a)
        return [other, a, zero], [[-a / other, 1, 0]]
    b = free[1]
    other = mpmath.sqrt(1 - a * a - b * b)
    return [other, a, b], [[-a / other, 1, 0], [-b / other, 0, 1]]


def polish(degree):
    rows = orbits_of(degree)
    kinds = [row[0] for row in rows]
    free = [[mpmath.mpf(c) for c in row[2][{3: [1], 4: [1], 5: [1, 2]}.get(row[0], [])]] for row in rows]
    weights = exact(np.array([row[3] for row in rows]))
    for _ in range(STEPS):
        corners, turns = zip(*[corner_of(k, row[1], f) for k, row, f in zip(kinds, rows, free)])
        corners = np.array(corners)
        # The mean over an orbit is that over the three choices of the axis: the rest is symmetric by itself.
        values = sum(harmonics(degree, *corners[:, order].T, mpmath.sqrt)[0] for order in map(list, ORDERS)) / 3
        error = values @ weights
        error[0] -= 1
        worst = max(abs(error))
        if worst < RESIDUAL:
            return rows, corners, weights, kinds
        rough = corners.astype(float)
        slopes = np.zeros((len(values), 3, len(rows)))
        for order in map(list, ORDERS):
            slopes[:, order] += harmonics(degree, *rough[:, order].T, np.sqrt)[1] / 3
        columns = [slopes[:, :, i] @ np.array(turn, float) * float(weights[i])
                   for i, turned in enumerate(turns) for turn in turned]
        jacobian = np.column_stack([values.astype(float), *columns])
        scale = float(worst)
        step = np.linalg.lstsq(jacobian, -(error / worst).astype(float), rcond=None)[0] * scale
        weights = weights + exact(step[:len(rows)])
        at = len(rows)
        for f in free:
            for k in range(len(f)):
                f[k] += mpmath.mpf(step[at])
                at += 1
    raise SystemExit(f"degree {degree}: residual {mpmath.nstr(worst, 3)} after {STEPS} steps")


def main():
    written, rules = [], []
    for degree in DEGREES:
        _, corners, weights, kinds = polish(degree)
        count = sum(SIZES[kind] for kind in kinds)
        rules.append(f"{count} {degree} {len(written)} {len(kinds)}")
        for kind, corner, weight in zip(kinds, corners, weights):
            written.append(" ".join(f"{float(c):.17g}" for c in [*corner, weight / SIZES[kind]]))
        print(rules[-1], flush=True)
    tables.write("lebedev", written)
    tables.write("lebedev_rules", rules)


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""Writes data/t_design.txt and data/t_design_sizes.txt: symmetric spherical designs.

usage: scripts/t_design_table.py

A spherical t-design is a set of points whose plain mean is exact for all polynomials up to degree t (Delsarte,
Goethals and Seidel 1977). One that has the opposite of each point is exact for odd polynomials anyway, so that
the even harmonics of degrees 2 .. t-1 are left: t(t+1)/2 - 1 equations for N - 3 free angles. That is why N =
2 ceil((t^2 + t + 4)/4) points, or up to ten more, suffice in practice (Womersley 2018). Nothing is copied: the points are solved
for by damped Gauss-Newton steps from half a spherical Fibonacci set, as it is and then disturbed more and
more; last come steps whose residual is computed in extended precision. Designs that the table has already are
not solved for again. Needs NumPy.
"""
import numpy as np
import tables

DEGREES = range(1, 52, 2)
RESIDUAL = 1e-13
STEPS = 120
SLOW = (40, 1e-4)  # a start that is not below the second by then is given up
STARTS = 20  # before two points more are allowed
FEW = 3  # the same above degree 25
MORE = 8
POLISH = 3


def half_count(degree):
    return (degree * degree + degree + 7) // 4


def harmonics(degree, points):
    """Real harmonics of even degrees 2 .. degree - 1, orthonormal for the mean over the sphere, and their
    gradients (of the homogeneous polynomials); rows by harmonic."""
    x, y, z = points.T
    r2 = x * x + y * y + z * z
    one, zero = np.ones_like(x), np.zeros_like(x)
    values, gradients = [], []
    real, imaginary = (one, [zero] * 3), (zero, [zero] * 3)
    number = points.dtype.type
    scale = number(1)
    for m in range(degree):
        # Polynomials in z and r that (x + i y)^m is multiplied with, by the recurrence over l.
        before, here = (zero, [zero] * 3), (one * scale, [zero] * 3)
        for l in range(m, degree):
            if l % 2 == 0 and l > 0:
                for part in ([real] if m == 0 else [real, imaginary]):
                    factor = np.sqrt(number(2)) if m > 0 else 1.0
                    values.append(factor * here[0] * part[0])
                    gradients.append([factor * (here[1][d] * part[0] + here[0] * part[1][d]) for d in range(3)])
            a = np.sqrt(number((2 * l + 1) * (2 * l + 3)) / ((l + 1 - m) * (l + 1 + m)))
            b = 0.0
            if l > m:
                b = np.sqrt(number((2 * l + 3) * (l - m) * (l + m)) / ((2 * l - 1) * (l + 1 - m) * (l + 1 + m)))
            after = (a * z * here[0] - b * r2 * before[0],
                     [a * (z * here[1][d] + (here[0] if d == 2 else 0.0))
                      - b * (r2 * before[1][d] + 2 * points[:, d] * before[0]) for d in range(3)])
            before, here = here, after
        real, imaginary = (
            (x * real[0] - y * imaginary[0],
             [x * real[1][d] - y * imaginary[1][d] + (real[0] if d == 0 else -imaginary[0] if d == 1 else 0.0)
              for d in range(3)]),
            (x * imaginary[0] + y * real[0],
             [x * imaginary[1][d] + y * real[1][d] + (imaginary[0] if d == 0 else real[0] if d == 1 else 0.0)
              for d in range(3)]))
        scale *= np.sqrt(number(2 * m + 3) / (2 * m + 2))
    return np.array(values).reshape(-1, len(x)), np.array(gradients).reshape(-1, 3, len(x))


def tangents(points):
    """Two unit vectors across each point."""
    x, y, z = points.T
    radius = np.hypot(x, y)
    east = np.array([-y / radius, x / radius, 0 * x])
    north = np.array([-z * x / radius, -z * y / radius, radius])
    return east, north


def solve(degree, n, disturbance, random):
    z = 1 - (np.arange(n) + 0.5) / n
    azimuth = np.pi * (3 - np.sqrt(5)) * np.arange(n)
    radius = np.sqrt(1 - z * z)
    points = np.array([radius * np.cos(azimuth), radius * np.sin(azimuth), z]).T
    points += disturbance / np.sqrt(n) * random.normal(size=points.shape)
    points /= np.linalg.norm(points, axis=1)[:, None]
    damping, best = 1e-2, None
    for step in range(STEPS):
        values, gradients = harmonics(degree, points)
        error = values.mean(axis=1)
        norm = np.linalg.norm(error)
        if best is None or norm < best[0]:
            directions = tangents(points)
            jacobian = np.hstack([np.einsum("kdi,di->ki", gradients, t) / n for t in directions])
            best = (norm, points, error, jacobian, directions)
            damping = damping / 5
        else:
            damping *= 4
        norm, points, error, jacobian, (east, north) = best
        if norm < 1e-13 or damping > 1e8 or (step == SLOW[0] and norm > SLOW[1]):
            break
        # The shortest damped step: there are more angles than equations.
        square = jacobian @ jacobian.T
        shift = max(damping * min(1.0, norm), 1e-14) * max(1e-300, np.trace(square) / max(1, len(square)))
        change = -jacobian.T @ np.linalg.solve(square + shift * np.eye(len(square)), error)
        points = points + (east * change[:n] + north * change[n:]).T
        points /= np.linalg.norm(points, axis=1)[:, None]
    return best[0], best[1]


def polish(degree, points):
    """Undamped steps; the rounded points."""
    n = len(points)
    for _ in range(POLISH):
        extended = points.astype(np.longdouble)
        extended /= np.sqrt((extended * extended).sum(axis=1))[:, None]
        error = harmonics(degree, extended)[0].mean(axis=1)
        east, north = tangents(points)
        gradients = harmonics(degree, points)[1]
        jacobian = np.hstack([np.einsum("kdi,di->ki", gradients, t) / n for t in (east, north)])
        change = -np.linalg.lstsq(jacobian, error.astype(float), rcond=1e-12)[0] if len(error) else np.zeros(2 * n)
        extended += (east * change[:n] + north * change[n:]).T
        points = (extended / np.sqrt((extended * extended).sum(axis=1))[:, None]).astype(float)
    return points


def search(degree):
    """The points of z >= 0 of a design, as few as are found."""
    random = np.random.default_rng(degree)
    for more in range(MORE):
        for start in range(STARTS if degree <= 25 else FEW):
            norm, half = solve(degree, half_count(degree) + more, 2 * start / STARTS, random)
            half = polish(degree, half) if norm < RESIDUAL else half
            if norm < RESIDUAL and worst_degree(degree, half) < RESIDUAL:
                return half * np.where(half[:, 2:] < 0, -1, 1)
    raise SystemExit(f"no design of degree {degree} came out")


def worst_degree(degree, half):
    """The largest mean over pairs of P_l(x.y), the squared means of the harmonics of one degree, with their
    sum: apart from the solver."""
    points = np.vstack([half, -half])
    cosines = np.clip(points @ points.T, -1, 1)
    before, here, worst = np.ones_like(cosines), cosines, 0.0
    for l in range(1, degree + 1):
        worst = max(worst, abs(here.mean()))
        before, here = here, ((2 * l + 1) * cosines * here - l * before) / (l + 1)
    return worst


def main():
    rows, sizes = tables.read("t_design"), tables.read("t_design_sizes")
    for degree in DEGREES[len(sizes):]:
        half = search(degree)
        sizes.append(f"{2 * len(half)} {degree} {len(rows)} {len(half)}")
        rows += [" ".join(f"{c:.17g}" for c in x) for x in half]
        print(sizes[-1], flush=True)
        tables.write("t_design", rows)
        tables.write("t_design_sizes", sizes)


if __name__ == "__main__":
    main()

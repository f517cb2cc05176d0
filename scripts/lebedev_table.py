#!/usr/bin/python3
"""Writes data/lebedev.txt and data/lebedev_rules.txt: quadrature of the sphere with octahedral symmetry.

usage: scripts/lebedev_table.py

Such a rule is a union of orbits of the octahedral group, each with one weight (Lebedev 1976). It is exact up
to a degree when it is for the invariant polynomials, those in s = x^2 y^2 + y^2 z^2 + z^2 x^2 and
t = x^2 y^2 z^2 (Sobolev 1962). Nothing is copied: the numbers of orbits of each kind are those of Lebedev's
rules with positive weights, nodes and weights are solved for by damped Gauss-Newton steps from seeded random
starts. Needs NumPy.
"""
import itertools

import numpy as np
import tables

# Degree, then how many orbits: (1,0,0), (1,1,0), (1,1,1), (a,a,b), (a,b,0), (a,b,c).
RULES = [(3, 1, 0, 0, 0, 0, 0), (5, 1, 0, 1, 0, 0, 0), (7, 1, 1, 1, 0, 0, 0), (9, 1, 0, 1, 0, 1, 0),
         (11, 1, 1, 1, 1, 0, 0), (15, 1, 0, 1, 2, 1, 0), (17, 1, 0, 1, 3, 1, 0), (19, 1, 1, 1, 3, 0, 1),
         (21, 1, 1, 1, 3, 1, 1), (23, 1, 1, 1, 4, 1, 1)]
SIZES = np.array([6, 12, 8, 24, 24, 48])
STARTS = 1000
DRAWS = 100  # for each start
STEPS = 100
RESIDUAL = 1e-13


def chebyshev(n, x):
    """Chebyshev polynomials 0..n of x and their derivatives, rows by degree."""
    values, slopes = [np.ones_like(x), x], [np.zeros_like(x), np.ones_like(x)]
    for _ in range(n - 1):
        values.append(2 * x * values[-1] - values[-2])
        slopes.append(2 * values[-2] + 2 * x * slopes[-1] - slopes[-2])
    return np.array(values), np.array(slopes)


class Invariants:
    """An orthonormal basis of the invariant polynomials up to a degree; its first member is 1."""

    def __init__(self, degree):
        self.powers = [(a, b) for a in range(degree // 4 + 1) for b in range((degree - 4 * a) // 6 + 1)]
        # An exact rule in z and azimuth, in terms of u = x^2 and v = y^2.
        z, of_z = np.polynomial.legendre.leggauss(degree + 1)
        azimuth = 2 * np.pi * (np.arange(2 * degree + 2) + 0.5) / (2 * degree + 2)
        u = np.outer(1 - z * z, np.cos(azimuth)**2).ravel()
        v = np.outer(1 - z * z, np.sin(azimuth)**2).ravel()
        weights = np.repeat(of_z / 2, azimuth.size) / azimuth.size
        raw = self.raw(u, v)[0]
        self.change = np.linalg.inv(np.linalg.qr((raw * np.sqrt(weights)).T)[1]).T
        self.integrals = self.change @ (raw @ weights)

    def raw(self, u, v):
        w = 1 - u - v
        s, t = u * v + (u + v) * w, u * v * w
        top = max(2, max(a for a, _ in self.powers)), max(2, max(b for _, b in self.powers))
        of_s, slope_s = chebyshev(top[0], 6 * s - 1)
        of_t, slope_t = chebyshev(top[1], 54 * t - 1)
        a, b = np.array(self.powers).T
        along_s, along_t = 6 * slope_s[a] * of_t[b], 54 * of_s[a] * slope_t[b]
        # ds/du = v + w - (u + v) = w - u, dt/du = v (w - u), and so for v.
        return of_s[a] * of_t[b], (w - u) * (along_s + v * along_t), (w - v) * (along_s + u * along_t)

    def at(self, u, v):
        return [self.change @ part for part in self.raw(u, v)]


def place(kinds, nodes):
    """u, v of each orbit, and how they change with the unknowns of the nodes."""
    u, v, du, dv, next_unknown = [], [], [], [], 0
    for kind in kinds:
        row_u, row_v = np.zeros(nodes.size), np.zeros(nodes.size)
        if kind < 3:
            u.append([0, 1 / 2, 1 / 3][kind])
            v.append([0, 1 / 2, 1 / 3][kind])
        else:
            first = nodes[next_unknown]
            row_u[next_unknown] = 1
            u.append(first)
            if kind == 5:
                row_v[next_unknown + 1] = 1
                v.append(nodes[next_unknown + 1])
                next_unknown += 1
            else:
                row_v[next_unknown] = 1 if kind == 3 else -1
                v.append(first if kind == 3 else 1 - first)
            next_unknown += 1
        du.append(row_u)
        dv.append(row_v)
    return np.array(u), np.array(v), np.array(du), np.array(dv)


def inside(kinds, u, v, weights):
    w = 1 - u - v
    return weights.min() > 0 and u.min() > -1e-12 and v.min() > -1e-12 and w.min() > -1e-12


def draw(kinds, random):
    unknown = [kind for kind in kinds for _ in range([0, 0, 0, 1, 1, 2][kind])]
    nodes = np.zeros(len(unknown))
    i = 0
    while i < len(unknown):
        if unknown[i] < 5:
            nodes[i] = random.uniform(0.0, 0.5)
            i += 1
        else:
            nodes[i:i + 2] = np.sort(random.dirichlet([1, 1, 1]))[:2]
            i += 2
    return nodes


def closest(kinds, nodes):
    """The largest cosine between two nodes of all orbits."""
    u, v = place(kinds, nodes)[:2]
    corners = np.sqrt(np.maximum(0.0, [u, v, 1 - u - v])).T
    cosines = np.concatenate([corners @ corners[:, order].T for order in itertools.permutations(range(3))])
    mirrored = [corners @ (corners * flip)[:, order].T for order in itertools.permutations(range(3))
                for flip in ([-1, 1, 1], [1, -1, 1], [1, 1, -1])]
    cosines = np.concatenate([cosines, *mirrored])
    return cosines[cosines < 1 - 1e-9].max()


def solve(basis, kinds, random):
    """One start, the most spread out of some random ones; None where it comes to rest elsewhere."""
    nodes = min((draw(kinds, random) for _ in range(DRAWS)), key=lambda drawn: closest(kinds, drawn))
    weights = SIZES[kinds] / SIZES[kinds].sum()
    damping, best = 1e-2, None
    for step in range(STEPS):
        u, v, du, dv = place(kinds, nodes)
        value, of_u, of_v = basis.at(u, v)
        error = value @ weights - basis.integrals
        norm = np.linalg.norm(error)
        if best is None or norm < best[0]:
            best = (norm, nodes, weights, value, (of_u * weights) @ du + (of_v * weights) @ dv, error)
            damping = max(damping / 5, 1e-15)
        else:
            damping *= 4
        norm, nodes, weights, value, of_nodes, error = best
        if norm < 2e-16 or damping > 1e6 or (step == 50 and norm > 1e-4):
            break
        jacobian = np.hstack([value, of_nodes])
        system = np.vstack([jacobian, np.sqrt(damping * min(norm, 1.0)) * np.eye(jacobian.shape[1])])
        change = np.linalg.lstsq(system, np.concatenate([-error, np.zeros(jacobian.shape[1])]), rcond=None)[0]
        weights, nodes = weights + change[:len(kinds)], nodes + change[len(kinds):]
    norm, nodes, weights = best[:3]
    u, v = place(kinds, nodes)[:2]
    return (u, v, weights) if norm < RESIDUAL and inside(kinds, u, v, weights) else None


def search(rule):
    basis = Invariants(rule[0])
    kinds = np.repeat(np.arange(6), rule[1:])
    random = np.random.default_rng(rule[0])
    for _ in range(STARTS):
        found = solve(basis, kinds, random)
        if found is not None:
            return kinds, found
    raise SystemExit(f"no rule of degree {rule[0]} came out of {STARTS} starts")


def corner(kind, u, v):
    """The node of an orbit with x >= y >= z >= 0; equal coordinates are equal bits and zeros are exact."""
    if kind < 3:
        n = kind + 1
        return [1 / np.sqrt(n)] * n + [0.0] * (3 - n)
    if kind == 3:
        return sorted([np.sqrt(u), np.sqrt(u), np.sqrt(max(0.0, 1 - 2 * u))], reverse=True)
    return sorted(np.sqrt([u, v, 1 - u - v if kind == 5 else 0.0]), reverse=True)


def images(x):
    found = set()
    for order in itertools.permutations(x):
        for signs in itertools.product([1, -1], repeat=3):
            found.add(tuple(c * s + 0.0 for c, s in zip(order, signs)))
    return np.array(sorted(found))


def check(degree, orbits):
    """By the sum over pairs of w w P_l(x.y), which is the square of all harmonics' sums of degree l."""
    points = np.vstack([images(x) for x, _ in orbits])
    weights = np.concatenate([np.full(len(images(x)), w) for x, w in orbits])
    cosines = np.clip(points @ points.T, -1, 1)
    before, here = np.ones_like(cosines), cosines
    worst = abs(weights.sum() - 1)
    for l in range(1, degree + 1):
        worst = max(worst, abs(weights @ here @ weights) / 1e-2)
        before, here = here, ((2 * l + 1) * cosines * here - l * before) / (l + 1)
    if worst > RESIDUAL:
        raise SystemExit(f"degree {degree} has an error of {worst}")
    return len(points)


def main():
    rows, rules = [], []
    for rule in RULES:
        kinds, (u, v, weights) = search(rule)
        orbits = [(corner(k, a, b), w / SIZES[k]) for k, a, b, w in zip(kinds, u, v, weights)]
        count = check(rule[0], orbits)
        rules.append(f"{count} {rule[0]} {len(rows)} {len(orbits)}")
        rows += [" ".join(f"{c:.17g}" for c in [*x, w]) for x, w in orbits]
    tables.write("lebedev", rows)
    tables.write("lebedev_rules", rules)


if __name__ == "__main__":
    main()

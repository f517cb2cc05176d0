#!/usr/bin/python3
"""The condition number of the system that exact weights of spherical Fibonacci points solve, and what preconditioners
leave of it: the inverse of the blocks of one order (all that latitudes alone can do), and points scaled by their own sums
of squares.

usage: scripts/exact_condition.py [N [DEGREE ...]]        (1000 27 28 29)

Needs NumPy. Spherical harmonics have mean square 1, by recurrences in the degree.
"""
import sys

import numpy as np


def spherical_fibonacci(n):
    j = np.arange(n)
    return 1 - (2 * j + 1) / n, 2 * np.pi * np.mod(j * (np.sqrt(5) - 1) / 2, 1.0)


def harmonics(z, phi, degree):
    """Columns, and the order of each with its parity."""
    columns, orders, first = [], [], np.ones_like(z)
    for m in range(degree + 1):
        if m > 0:
            first = first * np.sqrt(1 - z * z) * np.sqrt((2 * m + 1) / (2 * m))
        before, now = np.zeros_like(z), first
        for degree_now in range(m, degree + 1):
            if degree_now > m:
                square = degree_now * degree_now
                scale = np.sqrt((4 * square - 1) / (square - m * m))
                back = np.sqrt(max(0, (degree_now - 1)**2 - m * m) / (4 * (degree_now - 1)**2 - 1))
                before, now = now, scale * (z * now - back * before)
            columns.append(now * np.cos(m * phi) * (1 if m == 0 else np.sqrt(2)))
            orders.append(m)
            if m > 0:
                columns.append(now * np.sin(m * phi) * np.sqrt(2))
                orders.append(-m)
    return np.array(columns).T, np.array(orders)


def condition(matrix):
    values = np.linalg.eigvalsh(matrix)
    return values[-1] / values[0]


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    print("degree  N/(L+1)^2  condition  by order  by point")
    for degree in [int(word) for word in sys.argv[2:]] or [27, 28, 29]:
        values, orders = harmonics(*spherical_fibonacci(n), degree)
        matrix = values.T @ values / n
        root = np.zeros_like(matrix)
        for order in np.unique(orders):
            block = np.ix_(orders == order, orders == order)
            lengths, vectors = np.linalg.eigh(matrix[block])
            root[block] = vectors @ np.diag(lengths**-0.5) @ vectors.T
        by_point = values.T @ (values / np.sum(values**2, axis=1)[:, None])
        figures = condition(matrix), condition(root @ matrix @ root), condition(by_point)
        print(f"{degree:6} {n / (degree + 1)**2:10.3f} " + " ".join(f"{figure:9.4g}" for figure in figures))


main()

#!/usr/bin/env python3
"""Relative RMSE of integrals over the square and the cube with Aureole's sets: the tables of docs/choosing.md.

    PYTHONPATH=build/release/python python3 bench/peers/cube.py

Each value is over 16 randomizations. `periodic` is a product of 1 + (exp(sin 2 pi x) - I0(1)) / k, `exp` is exp of the mean coordinate, `Gauss` a
product of exp(-4 (x - .5)^2), `kink` a product of (|4 x - 2| + k) / (1 + k), `step` the half space with mean coordinate below .45.
"""
import math

import numpy as np

import aureole

SETS = {
    6: (16384, [("cbc", "shift"), ("cbc:baker=true", "shift"), ("interlaced", "owen"), ("sobol", "owen"),
                ("cascaded", "owen"), ("r2", "shift"), ("random", "none")]),
    2: (1024, [("cbc", "shift"), ("cbc:baker=true", "shift"), ("sobol", "owen"), ("pmj02", "none"), ("owen-tree", "none"), ("sliced", "none"), ("bnot", "shift"),
               ("blue-noise", "shift"), ("jittered", "none"), ("random", "none")]),
}  # fmt: skip


def integrands(d):
    k = np.arange(1, d + 1)
    below = sum((-1) ** j * math.comb(d, j) * max(0.0, 0.45 * d - j) ** d for j in range(d + 1)) / math.factorial(d)
    return {
        "periodic": (lambda x: (1 + (np.exp(np.sin(2 * np.pi * x)) - np.i0(1)) / k).prod(axis=1), 1.0),
        "exp": (lambda x: np.exp(x.mean(axis=1)), (d * (math.exp(1 / d) - 1)) ** d),
        "Gauss": (lambda x: np.exp(-4 * (x - 0.5) ** 2).prod(axis=1), (math.sqrt(math.pi) / 2 * math.erf(1)) ** d),
        "kink": (lambda x: ((abs(4 * x - 2) + k) / (1 + k)).prod(axis=1), 1.0),
        "step": (lambda x: x.mean(axis=1) < 0.45, below),
    }


for d, (n, sets) in SETS.items():
    functions = integrands(d)
    print(f"\n| d = {d}, n = {n} | " + " | ".join(functions) + " |\n|---" * 1 + "|---" * len(functions) + "|")
    for name, scramble in sets:
        errors = {key: [] for key in functions}
        for seed in range(16):
            x = aureole.points(name, n, domain="square" if d == 2 else "cube", dimension=d, scramble=scramble, seed=seed)
            for key, (f, exact) in functions.items():
                errors[key].append(float(np.mean(f(x))) / exact - 1)
        print(f"| `{name}{'' if scramble == 'none' else ' --scramble ' + scramble}` | "
              + " | ".join(f"{np.sqrt(np.mean(np.square(e))):.2g}" for e in errors.values()) + " |")

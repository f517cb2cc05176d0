#!/usr/bin/env python3
"""Axes that repel each other: energy and time, compared with MRtrix's dirgen and dipy's disperse_charges.

    pip install dipy; apt install mrtrix3
    python3 bench/peers/axes.py [--program build/release/aureole] [--sizes 6,30,60,256]

Prints a Markdown table: the energy (the sum over pairs of 1/|x - y| + 1/|x + y|) relative to Aureole's, the smallest angle in
degrees, and CPU seconds. Each program runs with its defaults on one thread; missing programs are skipped.
"""
import argparse
import importlib.util
import io
import os
import resource
import shutil
import subprocess
import tempfile
import time

import numpy as np


def figures(x):
    x = x / np.linalg.norm(x, axis=1)[:, None]
    c = (x @ x.T)[np.triu_indices(len(x), 1)]
    energy = (1 / np.sqrt(2 - 2 * c) + 1 / np.sqrt(2 + 2 * c)).sum()
    return energy, np.degrees(np.arccos(min(1.0, np.abs(c).max())))


def run(*command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return text, after.ru_utime - before.ru_utime


def ours(program, n):
    text, seconds = run(program, "points", "electrostatic", "-n", str(n), "--domain", "axes")
    return np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1, ndmin=2), seconds


def dirgen(n):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "directions.txt")
        _, seconds = run("dirgen", str(n), path, "-cartesian", "-quiet", "-nthreads", "0")
        return np.loadtxt(path), seconds


def dipy(n, iterations):
    from dipy.core.sphere import HemiSphere, disperse_charges

    random = np.random.default_rng(n)
    start = random.normal(size=(n, 3))
    before = time.process_time()
    sphere, _ = disperse_charges(HemiSphere(xyz=start / np.linalg.norm(start, axis=1)[:, None]), iterations)
    return sphere.vertices, time.process_time() - before


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/aureole")
    parser.add_argument("--sizes", default="6,30,60,256")
    arguments = parser.parse_args()
    makers = {"aureole electrostatic": lambda n: ours(arguments.program, n)}
    if shutil.which("dirgen"):
        makers["MRtrix dirgen"] = dirgen
    if importlib.util.find_spec("dipy"):
        makers["dipy disperse_charges, 5000 steps"] = lambda n: dipy(n, 5000)
    print("| axes | made by | energy | over ours | smallest angle | CPU seconds |\n|---|---|---|---|---|---|")
    for n in map(int, arguments.sizes.split(",")):
        least = None
        for name, make in makers.items():
            points, seconds = make(n)
            energy, angle = figures(points)
            least = least or energy
            print(f"| {n} | {name} | {energy:.6f} | {energy / least:.7f} | {angle:.2f} | {seconds:.2f} |", flush=True)


if __name__ == "__main__":
    main()

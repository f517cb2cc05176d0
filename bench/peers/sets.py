#!/usr/bin/env python3
"""Point sets compared with those of other packages: uniformity, by `aureole measure`, and speed.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install scipy qmcpy healpy pylebedev qc-grid spaudiopy dipy orix quaternionic
    sudo apt install mrtrix3
    /tmp/peers/bin/python bench/peers/sets.py [--program build/release/aureole]          # writes the tables of bench/peers/sets.md
    python3 bench/peers/sets.py --check                                                  # compares all but the times

Values are scaled by powers of N so that sets of nearly equal sizes can be compared; those of random and scrambled sets are
means over eight seeds. Speed is the median of several calls on one thread, in millions of points per CPU second, of at most 2^20 points and
as many as take a fifth of a second. --check skips missing packages; failures are printed on standard error.
"""
import argparse
import csv
import io
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

for _name in "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS":
    os.environ[_name] = "1"
os.environ["AUREOLE_CACHE"] = ""  # blue noise is computed, not read

import numpy as np

import makers

HERE = os.path.dirname(os.path.abspath(__file__))
SEEDS = 8
# The size and the metrics of a domain: name, power of N that scales the value, and title of the column.
DOMAINS = {
    "square": (1024, [("star", 1, "star discrepancy, N"), ("l2-star", 1, "L2 star, N"),
                      ("min-distance", 0.5, "smallest distance, N^1/2")]),
    "sphere": (588, [("energy", 0.75, "energy, N^3/4"), ("cap", 0.75, "cap discrepancy, N^3/4"),
                     ("min-angle", 0.5, "smallest angle, N^1/2"), ("covering", 0.5, "covering, N^1/2")]),
    "rotations": (1000, [("energy", 2 / 3, "energy, N^2/3"), ("min-angle", 1 / 3, "smallest angle, N^1/3"),
                         ("covering", 1 / 3, "covering, N^1/3")]),
}
HEADERS = {"square": "x,y", "sphere": "x,y,z", "rotations": "w,x,y,z"}


def measure(domain, sets):
    """The metrics of arrays of points, one row each."""
    names = [metric for metric, *_ in DOMAINS[domain][1]]
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.join(folder, f"{i}.csv") for i in range(len(sets))]
        for file, points in zip(files, sets):
            header = HEADERS[domain] + (",w" if points.shape[1] > len(HEADERS[domain].split(",")) else "")
            np.savetxt(file, points, "%.17g", ",", header=header, comments="")
        text = subprocess.run([makers.program, "measure", *files, "-m", ",".join(names), "--domain", domain, "-q", "--format",
                               "csv"], capture_output=True, text=True, check=True).stdout
    return np.array([[float(row[name]) for name in names] for row in csv.DictReader(io.StringIO(text))])


def figures(maker):
    """The number of points, and the scaled values."""
    n, metrics = DOMAINS[maker.domain]
    sets = [maker.make(n, seed) for seed in range(1, 1 + (SEEDS if maker.random else 1))]
    values = measure(maker.domain, sets)
    sizes = np.array([[len(points)] for points in sets])
    scaled = values * sizes ** np.array([power for _, power, *_ in metrics])
    return round(sizes.mean()), scaled.mean(axis=0)


def child_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def build_clock(folder):
    build = os.path.dirname(os.path.abspath(makers.program))
    program = os.path.join(folder, "clock")
    include = os.path.join(HERE, "../../include")
    subprocess.run(["cc", "-O2", "-I", include, os.path.join(HERE, "clock.c"), "-L", build, "-laureole",
                    f"-Wl,-rpath,{build}", "-o", program], check=True)
    return program


def call_seconds(maker, n, clock):
    """CPU seconds of one call, and the number of its points."""
    if maker.arguments:
        size = makers.nearest_size(maker.sizes, n)
        scramble = maker.arguments[2] if len(maker.arguments) > 2 else "none"
        return float(subprocess.check_output([clock, maker.arguments[0], str(size), maker.domain, scramble])), size
    if maker.package == "dirgen":
        return child_seconds([sys.executable, __file__, "--make", str(makers.MAKERS.index(maker)), os.devnull]), n
    size = len(maker.make(n, 1))
    seconds = []
    while len(seconds) < 3 or (len(seconds) < 21 and sum(seconds) < 0.3):
        calls, start = 0, time.process_time()
        while calls == 0 or time.process_time() - start < 1e-3:
            maker.make(n, 1)
            calls += 1
        seconds.append((time.process_time() - start) / calls)
    return statistics.median(seconds), size


def speed(maker, clock):
    """Millions of points per CPU second."""
    n = DOMAINS[maker.domain][0]
    while True:
        seconds, size = call_seconds(maker, n, clock)
        if seconds > 0.05 or 4 * n > 1 << 20 or size < n / 2:
            return size / seconds / 1e6
        n *= 4


def cells(domain, maker, clock):
    size, values = figures(maker)
    texts = [str(size)] + [f"{value:.3g}" for value in values]
    if clock is not None:
        texts.append(f"{speed(maker, clock):.3g}")
    return texts


def title(maker):
    return f"`{maker.name}`" if maker.package is None else f"{makers.version(maker.package)}: {maker.name}"


def rows(domain, only_ours, clock):
    """Title and cells of each available set; an error text for the others."""
    for maker in makers.MAKERS:
        if maker.domain != domain or (only_ours and maker.package is not None):
            continue
        if not makers.is_installed(maker):
            yield maker.name, f"{maker.package}: not installed"
            continue
        try:
            yield title(maker), cells(domain, maker, clock)
        except ImportError as error:
            yield title(maker), f"{title(maker)}: {error}".split(" (/")[0]


def columns(domain):
    return ["set", "points"] + [name for *_, name in DOMAINS[domain][1]] + ["Mpoint/s"]


def write(page, begin, end):
    text = open(page).read()
    lines = []
    with tempfile.TemporaryDirectory() as folder:
        clock = build_clock(folder)
        for domain in DOMAINS:
            lines += ["", "| " + " | ".join(columns(domain)) + " |", "|---" * len(columns(domain)) + "|"]
            for name, found in rows(domain, False, clock):
                print(domain, name, found, file=sys.stderr)
                if not isinstance(found, str):
                    lines.append("| " + " | ".join([name, *found]) + " |")
    lines.append("")
    head, tail = text.split(begin)[0], text.split(end)[1]
    open(page, "w").write(head + begin + "\n" + "\n".join(lines) + end + tail)


def check(page, begin, end, domains, only_ours):
    """All cells except times, for all available sets."""
    stored, status = {}, 0
    table = open(page).read().split(begin)[1].split(end)[0]
    for chunk, domain in zip(table.split("| set |")[1:], DOMAINS):
        for line in chunk.splitlines():
            row = [cell.strip() for cell in line.strip("|").split("|")]
            stored[domain, row[0]] = row[1:-1]
    for domain in domains:
        for name, found in rows(domain, only_ours, None):
            if isinstance(found, str):
                print(f"left out: {found}")
            elif stored.get((domain, name)) != found:
                print(f"{domain}, {name}: {page} has {stored.get((domain, name))}, found {found}")
                status = 1
    return status


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/aureole")
    parser.add_argument("--page", default=os.path.join(HERE, "sets.md"))
    parser.add_argument("--check", action="store_true", help="compare the page's figures with those of today, but for times")
    parser.add_argument("--ours", action="store_true", help="with --check: only our own sets")
    parser.add_argument("--domains", default=",".join(DOMAINS), help="with --check: only these")
    parser.add_argument("--make", nargs=2, metavar=("ROW", "FILE"), help="make the points of one row, and no more")
    arguments = parser.parse_args()
    makers.program = arguments.program
    if arguments.make:
        maker = makers.MAKERS[int(arguments.make[0])]
        with open(arguments.make[1], "wb") as file:
            np.save(file, maker.make(DOMAINS[maker.domain][0], 1))
        return 0
    markers = "<!-- bench/peers/sets.py writes from here -->", "<!-- to here -->"
    if arguments.check:
        return check(arguments.page, *markers, arguments.domains.split(","), arguments.ours)
    write(arguments.page, *markers)
    return 0


if __name__ == "__main__":
    sys.exit(main())

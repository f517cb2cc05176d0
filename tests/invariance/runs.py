"""Running the program and comparing what it answers."""

import csv
import io
import json
import math
import os
import statistics
import subprocess
from pathlib import Path


class Context:
    """The program, the source tree, and how much work a row may do. Files go to the current folder."""

    def __init__(self, program, source, full):
        self.program, self.source, self.full = program, Path(source), full
        self.seeds = 32 if full else 4 if os.environ.get("AUREOLE_SHORT_TESTS") else 8

    def run(self, *arguments, environment=None, status=0, stdin=None):
        """What the program prints; an answer with another status is an error."""
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, input=stdin,
                              env={**os.environ, "AUREOLE_CACHE": "", **(environment or {})})
        if done.returncode != status:
            raise AssertionError(f"{' '.join(map(str, arguments))}: status {done.returncode}: {done.stderr.decode(errors='replace')[:500]}")
        return done.stdout

    # --- answers as numbers

    def irradiance(self, scene, sensors, seed=0, directions=1024, *options):
        """r of every sensor."""
        scenes = scene if isinstance(scene, (list, tuple)) else [scene]
        text = self.run("irradiance", *scenes, "--sensors", sensors, "-n", directions, "--seed", seed, "-q", *options)
        return [float(row["r"]) for row in csv.DictReader(io.StringIO(text.decode()))]

    def factors(self, mesh, seed=0, *options):
        """{(row, column): (factor, half width)}; column -1 is the sky."""
        meshes = mesh if isinstance(mesh, (list, tuple)) else [mesh]
        self.run("viewfactors", *meshes, "--seed", seed, "-q", "-o", "factors.csv", *options)
        with open("factors.csv", newline="") as file:
            return {(int(r["row"]), int(r["column"])): (float(r["factor"]), float(r["half_width"] or 0)) for r in csv.DictReader(file)}

    def radiosity(self, mesh, seed=0, *options):
        """(area, sky, radiosity) of every row."""
        self.run("viewfactors", mesh, "--seed", seed, "-q", "-o", "radiosity.csv", *options)
        with open("radiosity.csv", newline="") as file:
            return [(float(r["area"]), float(r["sky"]), float(r["radiosity"])) for r in csv.DictReader(file)]

    def image(self, scene, seed=0, samples=16, *options):
        """The luminances of the image, in blocks of 4 by 4 pixels."""
        self.run("render", scene, "--seed", seed, "--spp", samples, "-q", "-o", "image.pfm", *options)
        return blocks(Path("image.pfm"))

    def image_bytes(self, scene, *options, environment=None):
        self.run("render", scene, "-q", "-o", "bytes.pfm", *options, environment=environment)
        return Path("bytes.pfm").read_bytes()

    def table(self, *arguments, stdin=None):
        return json.loads(self.run(*arguments, "--json", stdin=stdin))


def read_pfm(path):
    import array
    data = path.read_bytes()
    kind, size, scale, rest = data.split(b"\n", 3)
    width, height = map(int, size.split())
    values = array.array("f", rest)
    assert float(scale) < 0 and kind == b"PF" and len(values) == 3 * width * height
    return width, height, values


def blocks(path, edge=4):
    width, height, values = read_pfm(path)
    sums = {}
    for y in range(height):
        for x in range(width):
            sums.setdefault((y // edge, x // edge), []).append(values[3 * (y * width + x) + 1])
    return [statistics.fmean(v) for _, v in sorted(sums.items())]


# --- comparisons: each raises AssertionError, and returns what it saw


def equal_bytes(first, second):
    assert first == second, "the bytes differ"
    return "the same bits"


def nearly_equal(first, second, relative, absolute=0.0):
    """Rounding: every value within `relative` of the larger one, or `absolute`."""
    assert len(first) == len(second), f"{len(first)} values and {len(second)}"
    worst = 0.0
    for i, (a, b) in enumerate(zip(first, second)):
        allowed = max(absolute, relative * max(abs(a), abs(b)))
        assert abs(a - b) <= allowed, f"value {i} is {a!r} and {b!r}"
        worst = max(worst, abs(a - b) / max(abs(a), abs(b), 1e-300))
    return f"{worst:.1e} apart"


def student_tail(t, degrees):
    """P(|T| > t), by Simpson's rule on the density with x = tan(u)."""
    norm = math.exp(math.lgamma((degrees + 1) / 2) - math.lgamma(degrees / 2)) / math.sqrt(degrees * math.pi)
    low, steps = math.atan(t), 2000
    width = (math.pi / 2 - low) / steps

    def density(u):
        c = math.cos(u)
        return 0.0 if c < 1e-12 else norm * (1 + math.tan(u) ** 2 / degrees) ** (-(degrees + 1) / 2) / (c * c)

    total = sum((1 if i in (0, steps) else 4 if i % 2 else 2) * density(low + i * width) for i in range(steps + 1))
    return 2 * total * width / 3


ERROR_RATE = 1e-4  # of a row of the table whose numbers are sampled: all of its comparisons together


def same_means(first, second, floor=1e-12, absolute=0.0):
    """Welch's test for each value; `first` and `second` hold one list of values a seed, of seeds that differ.

    A row fails by chance with probability ERROR_RATE (Bonferroni). `floor` is what rounding leaves, relative to the mean, and
    `absolute` what it leaves of values that are 0."""
    count = len(first[0])
    assert all(len(v) == count for v in [*first, *second]), "the answers have different sizes"
    resolution = []
    for i in range(count):
        a, b = [v[i] for v in first], [v[i] for v in second]
        mean = [statistics.fmean(v) for v in (a, b)]
        variance = [statistics.variance(v) / len(v) for v in (a, b)]
        difference, scale = abs(mean[0] - mean[1]), max(abs(mean[0]), abs(mean[1]))
        if difference <= max(floor * scale, absolute):
            continue
        error = math.sqrt(sum(variance))
        degrees = sum(variance) ** 2 / max(sum(v * v / (len(a) - 1) for v in variance), 1e-300)
        chance = student_tail(difference / error, max(degrees, 1.0)) if error > 0 else 0.0
        far = f"{difference / error:.1f} standard errors" if error > 0 else "without any spread"
        assert chance * count > ERROR_RATE, f"value {i}: {mean[0]:.10g} and {mean[1]:.10g} differ by {far} (probability {chance:.1e}, {count} comparisons)"
        resolution.append(error / scale if scale else 0.0)
    return f"means agree; standard errors {100 * statistics.median(resolution):.2g} %" if resolution else "the same numbers"

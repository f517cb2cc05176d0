#!/usr/bin/env python3
"""CPU seconds that Mitsuba 3 and `aureole render --error` take to the same target error, scene by scene.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install 'mitsuba==3.*' numpy scipy
    /tmp/peers/bin/python bench/peers/target_error.py build/release/aureole SCENE.xml[:WIDTHxHEIGHT]... [--errors .05,.02] [--measure relative]
        [-D NAME=VALUE]...

Mitsuba is llvm_ad_rgb with multi-jittered samples and the scene's filter, on one thread. Its samples grow fourfold from 16 until the
target is met or the next image would take more than --seconds; beyond, the power law between the last two errors gives the samples, and the line
between their times the seconds. Its error is half the difference of two images with different seeds, by the measure of --measure as in
docs/target-error.md, because path tracing has no bias. Of Mitsuba only the render call counts, after a first one that compiles; of Aureole
all from the loaded scene until it reports that the target is met, that is, its upper confidence bound; Mitsuba has no bound. A ratio above 1
means that Aureole is faster. `whole` is the ratio with loading, and with Mitsuba's compilation. The last line has the median of the ratios and
the least. Mitsuba has no plugin for the papers' material `phong_lobe`; the glossy box is scenes/cornell-box/figure.xml with -D materials=rough."""
import argparse
import json
import math
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile

from mitsuba_scene import change, cpu_seconds, load, read, split

FIRST, STEP, MOST_LANES = 16, 4, 1 << 24  # samples; a kernel runs at most this number of lanes, each with some hundred bytes of path state


def error_of(first, second, measure):
    """The root mean square error of a single image, estimated from two independent ones."""
    import numpy as np
    from scipy.ndimage import uniform_filter
    weights = np.array([0.2126, 0.7152, 0.0722])
    mean, half = (first + second) / 2, (first - second) / math.sqrt(2)
    if measure == "mean":
        return float(np.sqrt(np.mean(half**2)) / np.mean(mean))
    light = mean @ weights
    scale = uniform_filter(np.abs(light), 5, mode="nearest") + 0.01 * light.mean()
    return float(np.sqrt(np.mean((half @ weights / scale) ** 2)))


def mitsuba_child(path, width, height, definitions, errors, measure, most_seconds):
    """Prints a JSON line: seconds to each error, and the measurements."""
    import drjit as dr
    import mitsuba as mi
    import numpy as np
    mi.set_variant("llvm_ad_rgb")
    start = cpu_seconds()
    scene, sensor = load(change(read(path, definitions), sampler="multijitter"), width, height)
    loading = cpu_seconds() - start
    dr.set_thread_count(1)
    samples, found = FIRST, []
    while True:
        images, seconds = [], []
        for seed in (999, 1, 2):  # the first compiles
            start = cpu_seconds()
            images.append(np.array(mi.render(scene, sensor=sensor, spp=samples, seed=seed), dtype=np.float64)[:, :, :3])
            seconds.append(cpu_seconds() - start)
        compiling = max(seconds[0] - statistics.mean(seconds[1:]), 0) if not found else compiling
        found.append((samples, error_of(images[1], images[2], measure), statistics.mean(seconds[1:])))
        met = found[-1][1] <= min(errors) or STEP * found[-1][2] > most_seconds or samples * STEP * width * height > MOST_LANES
        if met and len(found) > 1:
            break
        samples *= STEP
    (few, error, less), (many, least, more) = found[-2:]
    slope = math.log(least / error) / math.log(many / few)
    each = (more - less) / (many - few)
    counts = [many * (target / least) ** (1 / slope) for target in errors]
    seconds = [max(each * count / 2, more + each * (count - many)) for count in counts]
    print(json.dumps({"seconds": seconds, "before": loading + compiling, "found": found, "slope": slope}))


def ours(aureole, path, width, height, definitions, error, measure, most_seconds):
    """Seconds of the process, and the program's report; None if the time limit is reached first."""
    with tempfile.TemporaryDirectory() as folder:
        before = cpu_seconds(resource.RUSAGE_CHILDREN)
        run = subprocess.run([aureole, "render", path, "--width", str(width), "--height", str(height), "-t", "1", "--no-cache", "--error", repr(error),
                              "--error-measure", measure, "--json", "-o", os.path.join(folder, "image.exr"), "--time-limit", str(most_seconds),
                              *(f"-D{name}={value}" for name, value in definitions.items())],
                             capture_output=True, text=True)
        seconds = cpu_seconds(resource.RUSAGE_CHILDREN) - before
    if run.returncode != 0:
        return None, run.stderr.strip().splitlines()[-1:] or [f"exit status {run.returncode}"]
    report = json.loads(run.stdout)
    return seconds, report[0] if isinstance(report, list) else report


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("aureole")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--errors", type=lambda text: [float(word) for word in text.split(",")], default=[0.05, 0.02])
    parser.add_argument("--measure", choices=["relative", "mean"], default="relative")
    parser.add_argument("--seconds", type=float, default=30)
    parser.add_argument("-D", action="append", default=[], metavar="NAME=VALUE", help="a definition of the scenes")
    parser.add_argument("--child", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    definitions = dict(text.split("=", 1) for text in given.D)
    if given.child:
        return mitsuba_child(*split(given.scenes[0])[:3], definitions, given.errors, given.measure, given.seconds)
    ratios = []
    print("| scene | error | Mitsuba | Aureole | ratio | whole | integrator |\n|---|---|---|---|---|---|---|")
    for text in given.scenes:
        path, width, height, name = split(text)
        child = subprocess.run([sys.executable, os.path.abspath(__file__), given.aureole, text, "--errors", ",".join(map(repr, given.errors)),
                                "--measure", given.measure, "--seconds", str(given.seconds), *(f"-D{item}" for item in given.D), "--child"],
                               capture_output=True, text=True)
        if child.returncode != 0:
            print(f"| {name} | | not measured: {(child.stderr.strip().splitlines() or ['?'])[-1]} | | | | |", flush=True)
            continue
        peer = json.loads(re.search(r'{"seconds".*', child.stdout)[0])  # after Mitsuba's warnings
        for error, theirs in zip(given.errors, peer["seconds"]):
            whole, report = ours(given.aureole, path, width, height, definitions, error, given.measure, 100 * given.seconds)
            if whole is None:
                print(f"| {name} | {error:g} | {theirs:.3g} | {report[0]} | | | |", flush=True)
                continue
            seconds = report["cpu_seconds"]
            ratios.append(theirs / seconds)
            print(f"| {name} | {error:g} | {theirs:.3g} | {seconds:.3g} | {ratios[-1]:.2f} | {(theirs + peer['before']) / whole:.2f} "
                  f"| {report.get('integrator', '')[:60]} |", flush=True)
    if ratios:
        print(f"{len(ratios)} ratios: median {statistics.median(ratios):.2f}, least {min(ratios):.2f}")


sys.exit(main())

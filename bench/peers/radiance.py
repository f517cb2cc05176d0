#!/usr/bin/env python3
"""Irradiance at 25 sensors of a shoebox room by Radiance's rtrace -I and rcontrib -I+ and by aureole irradiance: error, bias, CPU seconds.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install pyradiance
    /tmp/peers/bin/python bench/peers/radiance.py build/release/aureole

Both read the same .rad file. The reference is a run of Aureole with 250,000 directions per sensor and another seed; it is
unbiased, and its standard error is printed. Errors are those of the red channel, relative to the mean over all sensors.
"""
import os
import resource
import subprocess
import sys
import tempfile

import pyradiance

BIN = os.path.join(os.path.dirname(pyradiance.__file__), "bin")
ROOM = """
void plastic white 0 0 5 .7 .7 .7 0 0
void plastic floor 0 0 5 .3 .25 .2 0 0
void plastic wall 0 0 5 .5 .5 .5 0 0
void light lamp 0 0 3 10 10 10
floor polygon f 0 0 12 0 0 0 6 0 0 6 4 0 0 4 0
white polygon c 0 0 12 0 0 3 0 4 3 6 4 3 6 0 3
wall polygon w1 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3
wall polygon w2 0 0 12 6 0 0 6 0 3 6 4 3 6 4 0
wall polygon w3 0 0 12 0 0 0 0 0 3 6 0 3 6 0 0
wall polygon w4 0 0 12 0 4 0 6 4 0 6 4 3 0 4 3
lamp polygon l 0 0 12 2 1.5 2.95 2 2.5 2.95 3 2.5 2.95 3 1.5 2.95
wall polygon d1 0 0 12 4 1 .7 5.5 1 .7 5.5 3 .7 4 3 .7
wall polygon d2 0 0 12 4 1 .69 4 3 .69 5.5 3 .69 5.5 1 .69
"""
RADIANCE = {
    "rtrace, its defaults": "",
    "rtrace, -ab 4": "-ab 4",
    "rtrace, good": "-ab 5 -ad 1024 -as 256 -aa .1 -ar 64",
    "rtrace, experts' (no cache)": "-ab 6 -ad 4096 -as 512 -aa 0 -lw 1e-5",
    "rtrace, experts' (fine cache)": "-ab 8 -ad 4096 -as 1024 -aa .05 -ar 512 -lw 1e-5",
    "rtrace, experts' (no cache, many)": "-ab 8 -ad 16384 -as 0 -aa 0 -lw 1e-6",
}
CONTRIBUTIONS = {"rcontrib, 16,384 paths": "-ab 8 -ad 16384 -lw 1e-6"}
OURS = {
    "aureole, 256 directions": "-n 256",
    "aureole, its defaults": "",
    "aureole, --error 1%": "--error 1%",
    "aureole, 16,384 directions": "-n 16384",
}


MOST_SECONDS = 120


def run(command, text=None):
    """Its output and CPU seconds; it is terminated after MOST_SECONDS of them."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    out = subprocess.run(command, input=text, capture_output=True, text=True, check=True,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS + 1))).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return out, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    aureole = os.path.abspath(sys.argv[1])
    os.environ["RAYPATH"] = os.path.join(os.path.dirname(pyradiance.__file__), "lib")
    os.chdir(tempfile.mkdtemp())
    with open("room.rad", "w") as file:
        file.write(ROOM)
    points = "".join(f"{.6 + 1.2 * i} {.4 + .8 * j} .8 0 0 1\n" for i in range(5) for j in range(5))
    with open("desk.pts", "w") as file:
        file.write(points)
    with open("room.oct", "wb") as file:
        file.write(subprocess.run([f"{BIN}/oconv", "room.rad"], capture_output=True, check=True).stdout)

    def ours(options):
        out, seconds = run([aureole, "irradiance", "room.rad", "--sensors", "desk.pts", "-q"] + options.split())
        rows = [line.split(",") for line in out.split("\n")[1:] if line]
        return [float(row[3]) for row in rows], [float(row[6]) for row in rows], seconds

    def radiance(options):
        command = [f"{BIN}/rtrace", "-I", "-h", "-w"] + options.split() + ["room.oct"]
        out, seconds = run(command, points)
        return [float(line.split()[0]) for line in out.split("\n") if line], None, seconds

    def contributions(options):
        command = [f"{BIN}/rcontrib", "-I+", "-V+", "-h"] + options.split() + ["-m", "lamp", "room.oct"]
        out, seconds = run(command, points)
        return [float(line.split()[0]) for line in out.split("\n") if line], None, seconds

    reference, errors, seconds = ours("-n 250000 --seed 12345")
    mean = sum(reference) / len(reference)
    standard_error = (sum(e * e for e in errors) / len(errors)) ** .5 / mean
    print(f"reference: mean {mean:.4f}, its standard error {100 * standard_error:.3f} %, {seconds:.1f} CPU s\n")
    print("| | RMS error | bias | worst | CPU s | reported |\n|---|---|---|---|---|---|")
    for table, solve in ((RADIANCE, radiance), (CONTRIBUTIONS, contributions), (OURS, ours)):
        for name, options in table.items():
            try:
                values, reported, seconds = solve(options)
            except subprocess.CalledProcessError as failure:
                if failure.returncode < 0 or "CPU limit" in failure.stderr:
                    done = failure.stdout.count("\n")
                    print(f"| {name} | ended after {MOST_SECONDS} CPU s, at sensor {done + 1} of 25 | | | | |", flush=True)
                else:
                    print(f"| {name} | failed: {failure.stderr.strip()} |", flush=True)
                continue
            differences = [(v - t) / mean for v, t in zip(values, reference)]
            reported_text = "nothing" if reported is None else f"{100 * (sum(e * e for e in reported) / len(reported)) ** .5 / mean:.2f} %"
            print(f"| {name} | {100 * (sum(o * o for o in differences) / len(differences)) ** .5:.2f} % | {100 * sum(differences) / len(differences):+.2f} % "
                  f"| {100 * max(map(abs, differences)):.2f} % | {seconds:.2f} | {reported_text} |", flush=True)


main()

#!/usr/bin/env python3
"""A year of daylight by Radiance (rfluxmtx, gendaymtx, dctimestep) and by aureole irradiance --weather: hours, metrics, CPU seconds.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install pyradiance numpy
    /tmp/peers/bin/python bench/peers/year.py build/release/aureole [--epw FILE] [--patches 4] [-ad 65536]

The room of 6 x 4 x 3 m has a window without glass to the south, and stands on ground that reflects .2; nine sensors. Weather is that of
scripts/weather.sh unless --epw names a file. Radiance has the sun in the nearest patch and ours has its disk, so that hours with sun
on a sensor differ: hours are compared over overcast days, metrics over the year. Both read the same .wea and take the efficacies of Perez. Hourly values agree where the difference is within
the 95 % intervals of ours and Radiance's own noise, which two of its runs tell.
"""
import argparse
import os
import resource
import subprocess
import tempfile

import numpy as np
import pyradiance

BIN = os.path.join(os.path.dirname(pyradiance.__file__), "bin")
ROOM = """void plastic white 0 0 5 .7 .7 .7 0 0
void plastic floor 0 0 5 .2 .2 .2 0 0
void plastic wall 0 0 5 .5 .5 .5 0 0
floor polygon f 0 0 12 0 0 0 6 0 0 6 4 0 0 4 0
white polygon c 0 0 12 0 0 3 0 4 3 6 4 3 6 0 3
wall polygon w1 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3
wall polygon w2 0 0 12 6 0 0 6 0 3 6 4 3 6 4 0
wall polygon w3 0 0 12 0 4 0 6 4 0 6 4 3 0 4 3
wall polygon s1 0 0 12 0 0 0 0 0 .9 6 0 .9 6 0 0
wall polygon s2 0 0 12 0 0 2.5 0 0 3 6 0 3 6 0 2.5
wall polygon s3 0 0 12 0 0 .9 0 0 2.5 1 0 2.5 1 0 .9
wall polygon s4 0 0 12 5 0 .9 5 0 2.5 6 0 2.5 6 0 .9
"""
SKY = """#@rfluxmtx h=u u=Y
void glow ground_glow 0 0 4 1 1 1 0
ground_glow source ground 0 0 4 0 0 -1 180
#@rfluxmtx h=r{m} u=Y
void glow sky_glow 0 0 4 1 1 1 0
sky_glow source sky 0 0 4 0 0 1 180
"""


def cpu(function):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    out = function()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return out, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def radiance(m, rays, points):
    """Lux of sensors and hours."""
    shell = lambda text: subprocess.run(["bash", "-c", "set -o pipefail; " + text], check=True, capture_output=True)
    shell(f"rfluxmtx -I+ -y {points} -ab 10 -ad {rays} -lw 1e-6 - sky.rad room.rad <desk.pts >coefficients.mtx")
    shell(f"gendaymtx -m {m} -g .2 .2 .2 -O0 year.wea >sky.smx")
    out = shell("dctimestep coefficients.mtx sky.smx | rmtxop -fa -c 47.4 119.9 11.6 - | getinfo -").stdout
    return np.array(out.decode().split(), float).reshape(points, -1)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("--epw")
    options.add_argument("--patches", type=int, default=4)
    options.add_argument("-n", type=int, default=65536)
    options.add_argument("-ad", type=int, default=65536)
    given = options.parse_args()
    program = os.path.abspath(given.program)
    weather = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "weather.sh")
    os.environ["PATH"] = BIN + os.pathsep + os.environ["PATH"]
    os.environ["RAYPATH"] = "." + os.pathsep + os.path.join(os.path.dirname(BIN), "lib")
    text = open(given.epw).read() if given.epw else subprocess.run(["bash", weather, "48", "11", "1"], check=True, capture_output=True, text=True).stdout
    os.chdir(tempfile.mkdtemp())
    open("year.epw", "w").write(text)
    subprocess.run(["epw2wea", "year.epw", "year.wea"], check=True)
    open("room.rad", "w").write(ROOM)
    open("sky.rad", "w").write(SKY.format(m=given.patches))
    points = [(x, y, 0.8) for x in (1.5, 3, 4.5) for y in (0.7, 2, 3.3)]
    open("desk.pts", "w").write("".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in points))
    run = lambda n, patches: subprocess.run(
        [program, "irradiance", "-q", "room.rad", "--sensors", "desk.pts", "--weather", "year.wea", "--patches", patches,
         "-n", str(n), "--series", "series.npy", "-o", "year.csv"], check=True)
    (_, ours_cpu) = cpu(lambda: run(given.n, f"reinhart:{given.patches}" if given.patches > 1 else "tregenza"))
    series = np.load("series.npy")
    table = np.genfromtxt("year.csv", delimiter=",", names=True)
    (lux, peer_cpu) = cpu(lambda: radiance(given.patches, given.ad, len(points)))
    (again, _) = cpu(lambda: radiance(given.patches, given.ad + 1, len(points)))
    direct = np.array([float(line.split(",")[14]) for line in text.splitlines()[8:]])
    mine, error = series[:, 0], series[:, 1]
    noise = np.abs(lux - again)
    lit = lux.mean(0) > 100
    for name, hours in (("overcast hours", lit & (direct == 0)), ("hours with sun", lit & (direct > 0))):
        off = mine[:, hours] - lux[:, hours]
        inside = np.abs(off) <= 2.13 * error[:, hours] + 2 * noise[:, hours] + 0.005 * lux[:, hours]
        print(f"| {name} ({hours.sum()}) | bias {100 * off.mean() / lux[:, hours].mean():+.2f} % | "
              f"RMS {100 * np.sqrt((off ** 2).mean()) / lux[:, hours].mean():.2f} % | within {100 * inside.mean():.1f} % |", flush=True)
    clock = np.arange(lux.shape[1]) % 24
    counted = (clock >= 8) & (clock < 18)
    for name, values in (("autonomy", 100 * (lux[:, counted] >= 300).mean(1)),
                         ("continuous_autonomy", 100 * np.minimum(lux[:, counted] / 300, 1).mean(1)),
                         ("useful", 100 * ((lux[:, counted] >= 100) & (lux[:, counted] <= 3000)).mean(1)),
                         ("annual_lux_hours", lux.sum(1))):
        off = table[name] - values
        scale = 100 / values.mean() if name == "annual_lux_hours" else 1
        print(f"| {name} | mean {table[name].mean():.6g}, Radiance {values.mean():.6g} | largest difference {scale * np.abs(off).max():.2f} "
              f"{'%' if scale != 1 else 'points'} | largest half interval {scale * 2.13 * table[name + '_error'].max():.2f} |")
    print(f"| CPU s | ours {ours_cpu:.1f} | Radiance {peer_cpu:.1f} |")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""A year of daylight with Radiance (rfluxmtx, gendaymtx, dctimestep) and with aureole irradiance --weather: hours, metrics, CPU seconds.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install pyradiance numpy
    /tmp/peers/bin/python bench/peers/year.py build/release/aureole [--epw FILE] [--patches 4] [-ad 65536]

The room of 6 x 4 x 3 m has a window without glass to the south, and stands on ground with reflectance .2; nine sensors. The weather file is that
of scripts/weather.sh unless --epw names another. Both read the same .wea and use the efficacies of Perez.

gendaymtx distributes the sun over the nearest patches and computes its declination with a formula that has errors up to .5 degrees; Aureole
uses the disk at the position of Michalsky (1988). The rows "exact sun" replace the direct sunlight in Radiance's results by the
closed form: the direct illuminance of gendaymtx -d, if the line from the sensor to the sun of Michalsky passes through the window.
Hourly values agree if the difference is within the 95 % intervals of Aureole and the noise of Radiance, which is the difference
between two of its runs.
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


def shell(text):
    return subprocess.run(["bash", "-c", "set -o pipefail; " + text], check=True, capture_output=True).stdout


def numbers(command, rows):
    """Reads the luminances of a matrix."""
    return np.array(shell(command + " | rmtxop -fa -c 47.4 119.9 11.6 - | getinfo -").decode().split(), float).reshape(rows, -1)


def radiance(m, rays, points, bounces=10, sky="-g .2 .2 .2"):
    """Illuminances of sensors and hours, in lux."""
    shell(f"rfluxmtx -I+ -y {points} -ab {bounces} -ad {rays} -lw 1e-6 - sky.rad room.rad <desk.pts >coefficients.mtx")
    shell(f"gendaymtx -m {m} {sky} -O0 year.wea >sky.smx")
    return numbers("dctimestep coefficients.mtx sky.smx", points)


def suns(latitude, longitude, zone):
    """Unit vectors to the sun (east, north, up) in the middle of the hours of 2001 (Michalsky 1988)."""
    hours = np.arange(8760) + 0.5 - zone
    days = 365.5 + hours / 24  # from noon of 1 January 2000, UTC
    g = np.radians(357.528 + 0.9856003 * days)
    l = np.radians(280.460 + 0.9856474 * days + 1.915 * np.sin(g) + 0.020 * np.sin(2 * g))
    tilt = np.radians(23.439 - 4e-7 * days)
    ascension, declination = np.arctan2(np.cos(tilt) * np.sin(l), np.cos(l)), np.arcsin(np.sin(tilt) * np.sin(l))
    angle = np.radians(15 * ((6.697375 + 0.0657098242 * days + hours) % 24) + longitude) - ascension
    phi = np.radians(latitude)
    return np.stack([-np.cos(declination) * np.sin(angle),
                     np.sin(declination) * np.cos(phi) - np.cos(declination) * np.sin(phi) * np.cos(angle),
                     np.sin(declination) * np.sin(phi) + np.cos(declination) * np.cos(phi) * np.cos(angle)], 1)


def exact_sun(m, points, place):
    """Direct sunlight through the window in lux, by closed form with a point sun."""
    shell(f"gendaymtx -m {m} -d -O0 year.wea >sun.smx")
    patches = 144 * m * m + 2
    angles = np.array(shell(f"cnt {patches} | rcalc -e 'MF:{m};Rbin=recno-1' -f reinsrc.cal -e '$1=Romega'").split(), float)
    normal = angles @ numbers("cat sun.smx", patches)  # lux on a plane that faces the sun
    sun = suns(*place)
    lit = np.zeros((len(points), len(sun)))
    for i, (x, y, z) in enumerate(points):
        with np.errstate(divide="ignore", invalid="ignore"):
            far = -y / sun[:, 1]
            across, height = x + far * sun[:, 0], z + far * sun[:, 2]
        seen = (sun[:, 1] < 0) & (sun[:, 2] > 0) & (across > 1) & (across < 5) & (height > 0.9) & (height < 2.5)
        lit[i] = np.where(seen, normal * np.maximum(sun[:, 2], 0), 0)
    return lit


def metrics(lux):
    clock = np.arange(lux.shape[1]) % 24
    counted = lux[:, (clock >= 8) & (clock < 18)]
    return {"autonomy": 100 * (counted >= 300).mean(1), "continuous_autonomy": 100 * np.minimum(counted / 300, 1).mean(1),
            "useful": 100 * ((counted >= 100) & (counted <= 3000)).mean(1), "annual_lux_hours": lux.sum(1)}


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
    head = text.split("\n", 1)[0].split(",")
    patches = radiance(given.patches, given.ad, len(points), 1, "-d")  # direct light from the sun's patches
    better = lux - patches + exact_sun(given.patches, points, [float(head[i]) for i in (6, 7, 8)])
    for peer, values in (("Radiance", lux), ("exact sun", better)):
        for name, hours in (("overcast hours", lit & (direct == 0)), ("hours with sun", lit & (direct > 0))):
            off, mean = mine[:, hours] - values[:, hours], values[:, hours].mean()
            inside = np.abs(off) <= 2.13 * error[:, hours] + 2 * noise[:, hours] + 0.005 * values[:, hours]
            print(f"| {peer}: {name} ({hours.sum()}) | bias {100 * off.mean() / mean:+.2f} % | "
                  f"RMS {100 * np.sqrt((off ** 2).mean()) / mean:.2f} % | within {100 * inside.mean():.1f} % |", flush=True)
        for name, found in metrics(values).items():
            off = table[name] - found
            scale = 100 / found.mean() if name == "annual_lux_hours" else 1
            print(f"| {peer}: {name} | mean {table[name].mean():.6g} for {found.mean():.6g} | largest difference {scale * np.abs(off).max():.2f} "
                  f"{'%' if scale != 1 else 'points'} | largest half interval {scale * 2.13 * table[name + '_error'].max():.2f} |")
    print(f"| CPU s | ours {ours_cpu:.1f} | Radiance {peer_cpu:.1f} |")


if __name__ == "__main__":
    main()

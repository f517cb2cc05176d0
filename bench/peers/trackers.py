#!/usr/bin/env python3
"""Single-axis trackers with pvlib and with aureole irradiance --tracker: rotations, and irradiation of unshaded modules.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install pvlib
    /tmp/peers/bin/python bench/peers/trackers.py build/release/aureole [--epw FILE]

The weather file comes from scripts/weather.sh unless --epw names another. pvlib's singleaxis and get_total_irradiance (the models perez and
isotropic) receive the sun's position in the middle of the sunlit part of each hour, without refraction. Aureole's modules stand in an empty
scene: the sky follows Perez, Seals and Michalsky (1993), and the ground reflects .2 of the global irradiance.
"""
import argparse
import csv
import os
import subprocess
import tempfile
import time

import numpy as np
import pandas
import pvlib

AXES = ((0, 180, 60, 0), (0, 180, 60, 0.4), (20, 150, 50, 0.4))


def sun_of(data, where):
    """Zenith and azimuth at the mean of the sunlit 12ths of each hour (the last hour's label ends it)."""
    starts = pandas.DatetimeIndex(data.index)
    offsets = (np.arange(12) + 0.5) / 12 * 3600
    up = np.stack([pvlib.solarposition.get_solarposition(starts + pandas.to_timedelta(s, "s"), *where).zenith.to_numpy() < 90 for s in offsets])
    middle = np.where(up.any(0), (up * offsets[:, None]).sum(0) / np.maximum(up.sum(0), 1), 1800.0)
    sun = pvlib.solarposition.get_solarposition(starts + pandas.to_timedelta(middle, "s"), *where)
    return sun.zenith.to_numpy(), sun.azimuth.to_numpy()


def aureole(program, weather, axis, directions):
    with open("none.rad", "w") as file:
        file.write("void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey polygon far 0 0 9 0 0 -900 1 0 -900 0 1 -900\n")
    with open("cell.pts", "w") as file:
        file.write("0 0 1 0 0 1\n")
    before, start = os.times(), time.time()
    subprocess.run([program, "irradiance", "-q", "none.rad", "--sensors", "cell.pts", "--weather", weather, "--tracker", ",".join(map(str, axis)),
                    "-n", str(directions), "--series", "series.csv", "-o", "sums.csv"], check=True)  # fmt: skip
    after = os.times()
    rows = list(csv.DictReader(open("series.csv")))
    values = {name: np.array([float(row[name] or "nan") for row in rows]) for name in ("rotation", "front", "rear")}
    return values, after.children_user - before.children_user, time.time() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--epw")
    parser.add_argument("-n", type=int, default=16384)
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    weather = os.path.abspath(arguments.epw) if arguments.epw else "year.epw"
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../scripts/weather.sh")
    os.chdir(tempfile.mkdtemp())
    if not arguments.epw:
        with open(weather, "w") as file:
            subprocess.run(["bash", script], stdout=file, check=True)
    data, head = pvlib.iotools.read_epw(weather, coerce_year=2001)
    zenith, azimuth = sun_of(data, (head["latitude"], head["longitude"]))
    extra = pvlib.irradiance.get_extra_radiation(pandas.DatetimeIndex(data.index)).to_numpy()
    mass = pvlib.atmosphere.get_relative_airmass(zenith)
    print("| tilt, azimuth, limit, ground cover | rotations: hours that differ | front, of pvlib's Perez | of pvlib's isotropic | CPU s |\n|---|---|---|---|---|")
    for axis in AXES:
        step = 5
        found, cpu, _ = aureole(program, weather, (*axis, step), arguments.n)
        theta = np.asarray(pvlib.tracking.singleaxis(zenith, azimuth, *axis[:3], backtrack=axis[3] > 0, gcr=axis[3] or 1)["tracker_theta"])
        rounded = np.clip(step * np.round(theta / step), -axis[2], axis[2])
        # The sun at the horizon, and rotations within .02 degrees of the middle between two steps, round to either side.
        sure = (abs(zenith - 90) > 0.05) & ~(abs(abs(theta / step % 1 - 0.5)) < 0.02 / step)
        differ = int((sure & ~((rounded == found["rotation"]) | (np.isnan(theta) & np.isnan(found["rotation"])))).sum())
        lit = ~np.isnan(rounded) & ~np.isnan(found["rotation"])
        surface = pvlib.tracking.calc_surface_orientation(np.where(lit, found["rotation"], 0), *axis[:2])
        totals = []
        for model in ("perez", "isotropic"):
            total = pvlib.irradiance.get_total_irradiance(
                surface["surface_tilt"], surface["surface_azimuth"], zenith, azimuth, data["dni"].to_numpy(), data["ghi"].to_numpy(),
                data["dhi"].to_numpy(), dni_extra=extra, airmass=mass, albedo=0.2, model=model)  # fmt: skip
            totals.append(np.nansum(np.asarray(total["poa_global"])[lit]))
        front = found["front"][lit].sum()
        print(f"| {', '.join(map(str, axis))} | {differ} of {int(lit.sum())} | {100 * (front / totals[0] - 1):+.2f} % | {100 * (front / totals[1] - 1):+.2f} % | {cpu:.1f} |")


main()

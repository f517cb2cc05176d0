#!/usr/bin/env python3
"""Error of daylight coefficients due to sky patches: hours of a clear day, compared with each hour traced directly.

    python3 bench/peers/patches.py build/release/aureole [-n 262144]

The scene is a wall on a floor, both reflecting; three sensors face up, to the wall and away from it. scripts/weather.sh writes
the weather file; the hours are those of 10 June, a clear day. Direct tracing uses Perez's sky without patches and the sun as a disk.
Prints the root mean square difference over hours and sensors in % of the mean illuminance, the root mean square
of the standard errors of both, and CPU seconds for the year.
"""
import argparse
import csv
import math
import os
import resource
import subprocess
import tempfile

ROOM = """<shape type="cube"><transform name="to_world"><scale x="3" y=".1" z="2"/><translate y="1.5" z="1"/></transform>
<bsdf type="diffuse"><rgb name="reflectance" value=".6"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="20"/></transform><bsdf type="diffuse"/></shape>"""


def run(*arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(list(map(str, arguments)), check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("-n", type=int, default=262144, help="directions of each sensor")
    given = options.parse_args()
    program, count = os.path.abspath(given.program), given.n
    weather = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "weather.sh")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        with open("year.epw", "w") as out:
            subprocess.run(["bash", weather, "48", "11", "1"], stdout=out, check=True)
        with open("year.epw") as lines:
            records = [line.split(",") for line in list(lines)[8:]]
        day = {int(r[3]): (float(r[14]), float(r[15])) for r in records if (r[1], r[2]) == ("6", "10") and float(r[14]) > 100}
        with open("points.pts", "w") as out:
            out.write("0 0 .5 0 0 1\n1 .8 .7 0 1 0\n-2 1 1 0 -1 0\n")
        with open("scene.xml", "w") as out:
            out.write(f'<scene version="3.0.0">{ROOM}</scene>')
        reference, reference_noise = {}, 0.0
        for hour, (direct, diffuse) in day.items():
            keys = f"""<string name="date" value="2001-06-10"/><string name="time" value="{hour - 1:02d}:30"/>
<float name="latitude" value="48"/><float name="longitude" value="11"/><float name="timezone" value="1"/><vector name="up" value="0 0 1"/>"""
            with open("hour.xml", "w") as out:
                out.write(f"""<scene version="3.0.0">{ROOM}<emitter type="sky"><string name="model" value="perez"/>
<float name="direct_normal" value="{direct}"/><float name="diffuse_horizontal" value="{diffuse}"/>{keys}</emitter>
<emitter type="sun"><rgb name="irradiance" value="{direct}"/>{keys}</emitter></scene>""")
            run(program, "irradiance", "-q", "hour.xml", "--sensors", "points.pts", "-n", count, "--illuminance", "rec709", "-o", "hour.csv")
            with open("hour.csv") as rows:
                for sensor, row in enumerate(csv.DictReader(rows)):
                    reference[sensor, hour] = float(row["lux"])
                    reference_noise += float(row["lux_error"]) ** 2
        mean = sum(reference.values()) / len(reference)
        print("| patches | | difference | standard errors | CPU s for the year |\n|---|---|---|---|---|")
        for patches, number in (("tregenza", 145), ("reinhart:2", 577), ("reinhart:4", 2305)):
            cpu = run(program, "irradiance", "-q", "scene.xml", "--sensors", "points.pts", "--weather", "year.epw", "-n", count, "--efficacy", 179,
                      "--ground-albedo", 0, "--up", "0,0,1", "--patches", patches, "--series", "series.csv", "-o", "year.csv")
            square_sum = noise = 0.0
            with open("series.csv") as lines:
                for line in list(lines)[1:]:
                    sensor, month, date, hour, lux, error = line.split(",")[:6]
                    if (month, date) == ("6", "10") and (int(sensor), int(hour)) in reference:
                        square_sum += (float(lux) - reference[int(sensor), int(hour)]) ** 2
                        noise += float(error) ** 2
            print(f"| {patches} | {number} | {100 * math.sqrt(square_sum / len(reference)) / mean:.2f} % | "
                  f"{100 * math.sqrt((noise + reference_noise) / len(reference)) / mean:.2f} % | {cpu:.1f} |", flush=True)


if __name__ == "__main__":
    main()

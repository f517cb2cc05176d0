#!/usr/bin/env python3
"""Many sensors in a large scene: irradiance on the ground and the roofs of a generated city, compared with ray tracing alone.

    python3 bench/peers/sensors.py AUREOLE [--facets 1000000] [--sensors 100000] [-n 64]

The city comes from city.py, with diffuse facets under a uniform sky. Prints CPU seconds of `aureole irradiance` with one path edge (a
ray and a shadow ray per direction) and with four, without the time for reading the scene, and whether one thread and three give
identical bytes. The baseline is `aureole render --integrator ao` on the city, which does no shading.
"""
import argparse
import os
import random
import re
import resource
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


def run(arguments):
    """CPU seconds, and the messages."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    messages = subprocess.run(arguments, check=True, stderr=subprocess.PIPE, text=True).stderr
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, messages


def write_sensors(path, facets, count):
    """Random positions one centimeter above the horizontal facets of the city."""
    dice = random.Random(7)
    corners, level = [], []
    for line in open(facets):
        words = line.split()
        if words[0] == "v":
            corners.append(tuple(map(float, words[1:])))
        elif words[0] == "f":
            quad = [corners[int(word) - 1] for word in words[1:]]
            if len({corner[2] for corner in quad}) == 1:
                level.append(quad)
    with open(path, "w") as out:
        for _ in range(count):
            quad = dice.choice(level)
            u, v = dice.random(), dice.random()
            x = [quad[0][d] + u * (quad[1][d] - quad[0][d]) + v * (quad[3][d] - quad[0][d]) for d in range(3)]
            out.write(f"{x[0]:.4f} {x[1]:.4f} {x[2] + .01:.4f} 0 0 1\n")


SCENE = """<scene version="3.0.0"><integrator type="ao"><integer name="samples" value="16"/></integrator>
<sensor type="perspective"><float name="fov" value="50"/><transform name="to_world">
<lookat origin="{0},{0},{0}" target="{1},{1},0" up="0,0,1"/></transform>
<sampler type="independent"><integer name="sample_count" value="4"/></sampler>
<film type="hdrfilm"><integer name="width" value="256"/><integer name="height" value="256"/></film></sensor>
<emitter type="constant"/><shape type="obj"><string name="filename" value="city.obj"/>
<boolean name="face_normals" value="true"/><bsdf type="diffuse"><rgb name="reflectance" value=".3"/></bsdf></shape></scene>
"""


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("aureole")
    options.add_argument("--facets", type=int, default=1000000)
    options.add_argument("--sensors", type=int, default=100000)
    options.add_argument("-n", type=int, default=64)
    given = options.parse_args()
    aureole = os.path.abspath(given.aureole)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        subprocess.run([sys.executable, os.path.join(HERE, "city.py"), "city.obj", "--facets", str(given.facets)], check=True)
        triangles = 2 * sum(line.startswith("f ") for line in open("city.obj"))
        width = max(float(line.split()[1]) for line in open("city.obj") if line.startswith("v "))
        open("city.xml", "w").write(SCENE.format(-0.2 * width, 0.5 * width))
        write_sensors("all.pts", "city.obj", given.sensors)
        write_sensors("one.pts", "city.obj", 1)
        loading, _ = run([aureole, "irradiance", "-q", "city.xml", "--sensors", "one.pts", "-n", "16", "-o", "one.csv"])
        print(f"{triangles} triangles, {given.sensors} sensors, {given.n} directions each; read in {loading:.1f} CPU s")
        _, messages = run([aureole, "render", "-q", "--stats", "city.xml", "-o", "city.exr"])
        rays, seconds = int(re.search(r"(\d+) rays", messages)[1]), float(re.search(r"([\d.]+) CPU s", messages)[1])
        bare = seconds / rays
        print(f"bare rays: {1e-6 / bare:.2f} million a CPU second")
        for edges in 1, 4:
            spent = []
            for threads in 1, 3:
                seconds, _ = run([aureole, "irradiance", "-q", "city.xml", "--sensors", "all.pts", "-n", str(given.n),
                                  "--max-depth", str(edges), "--threads", str(threads), "-o", f"{threads}.csv"])
                spent.append(seconds - loading)
            same = open("1.csv").read() == open("3.csv").read()
            ratio = f", {spent[0] / (2 * given.n * given.sensors * bare):.2f} times its bare rays" if edges == 1 else ""
            print(f"{edges} edges: {spent[0]:.1f} CPU s by one thread, {spent[1]:.1f} by three{ratio}; "
                  f"{'the same' if same else 'OTHER'} bytes")
            if not same:
                sys.exit(1)


if __name__ == "__main__":
    main()

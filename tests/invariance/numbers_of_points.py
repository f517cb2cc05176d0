"""Points, weights and integrals: order, rotation, scale, format; and light that is added or multiplied."""

import csv
import io
import math
import random
from pathlib import Path

import models
from relations import relation
from runs import equal_bytes, nearly_equal


def points(context, *options):
    rows = list(csv.reader(io.StringIO(context.run("points", *options, "--no-header").decode())))
    return [tuple(float(v) for v in row) for row in rows if not row[0].startswith("#")]


def write_points(path, rows, header="x,y,z"):
    Path(path).write_text(header + "\n" + "".join(",".join(repr(v) for v in row) + "\n" for row in rows))
    return path


def turn(p, a=0.7, b=1.1):
    x, y, z = p
    x, y = x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a)
    return x, y * math.cos(b) - z * math.sin(b), y * math.sin(b) + z * math.cos(b)


def figures(context, file, metrics, *options):
    """The numbers of one row of measures."""
    row = context.table("measure", file, "-m", metrics, *options)[0]
    return [v for k, v in row.items() if isinstance(v, (int, float)) and k not in ("n", "seed")]


SPHERE = "energy,covering,voronoi-max"


@relation("numbers", "measure", "points permuted", "1e-12")
def _(context):
    rows = points(context, "spherical-fibonacci", "-n", "200", "--domain", "sphere")
    write_points("a.csv", rows)
    write_points("b.csv", random.Random(2).sample(rows, len(rows)))
    return nearly_equal(figures(context, "a.csv", SPHERE, "--domain", "sphere"), figures(context, "b.csv", SPHERE, "--domain", "sphere"), 1e-12)


@relation("numbers", "measure", "points rotated or mirrored", "1e-9")
def _(context):
    rows = points(context, "random", "-n", "150", "--domain", "sphere")
    write_points("a.csv", rows)
    write_points("b.csv", [turn(p) for p in rows])
    write_points("c.csv", [(-x, y, z) for x, y, z in rows])
    here = figures(context, "a.csv", SPHERE, "--domain", "sphere")
    return max(nearly_equal(here, figures(context, name, SPHERE, "--domain", "sphere"), 1e-9) for name in ("b.csv", "c.csv"))


@relation("numbers", "measure", "axes given by either end", "1e-12")
def _(context):
    rows = points(context, "spherical-fibonacci", "-n", "120", "--domain", "axes")
    write_points("a.csv", rows)
    write_points("b.csv", [tuple(-v for v in p) if i % 3 else p for i, p in enumerate(rows)])
    return nearly_equal(figures(context, "a.csv", "all", "--domain", "axes"), figures(context, "b.csv", "all", "--domain", "axes"), 1e-12)


@relation("numbers", "measure", "points as CSV, NPY and PLY", "the same numbers")
def _(context):
    answers = []
    for kind in ("csv", "npy", "ply", "json"):
        context.run("points", "spherical-fibonacci", "-n", "80", "--domain", "sphere", "-o", f"p.{kind}")
        if kind in ("csv", "npy"):
            answers.append(figures(context, f"p.{kind}", SPHERE))
    assert answers[0] == answers[1], f"{answers}"
    return "the same numbers"


@relation("numbers", "measure", "weights multiplied by a constant", "1e-13")
def _(context):
    rows = points(context, "spherical-fibonacci", "-n", "60", "--domain", "sphere")
    write_points("a.csv", [(*p, 1.0 + (i % 7)) for i, p in enumerate(rows)], "x,y,z,w")
    write_points("b.csv", [(*p, 3.0 * (1.0 + (i % 7))) for i, p in enumerate(rows)], "x,y,z,w")
    return nearly_equal(figures(context, "a.csv", "energy", "--domain", "sphere"), figures(context, "b.csv", "energy", "--domain", "sphere"), 1e-13)


def weights(context, file, *options):
    return [float(row["w"]) for row in csv.DictReader(line for line in io.StringIO(context.run("weights", file, *options).decode())
                                                      if not line.startswith("#"))]


for _method, _options in (("exact", ("--degree", "6")), ("voronoi", ()), ("osw", ())):
    @relation("numbers", f"weights --method {_method}", "points permuted", "1e-9")
    def _(context, method=_method, options=_options):
        rows = points(context, "spherical-fibonacci", "-n", "150", "--domain", "sphere")
        order = random.Random(4).sample(range(len(rows)), len(rows))
        write_points("a.csv", rows)
        write_points("b.csv", [rows[i] for i in order])
        a = weights(context, "a.csv", "--method", method, "--domain", "sphere", *options)
        return nearly_equal([a[i] for i in order], weights(context, "b.csv", "--method", method, "--domain", "sphere", *options), 1e-9)

    @relation("numbers", f"weights --method {_method}", "points rotated", "1e-9")
    def _(context, method=_method, options=_options):
        rows = points(context, "random", "-n", "150", "--domain", "sphere")
        write_points("a.csv", rows)
        write_points("b.csv", [turn(p) for p in rows])
        a = weights(context, "a.csv", "--method", method, "--domain", "sphere", "--negative" if method == "exact" else "-q", *options)
        b = weights(context, "b.csv", "--method", method, "--domain", "sphere", "--negative" if method == "exact" else "-q", *options)
        return nearly_equal(a, b, 1e-9, 1e-9 / len(rows))


@relation("numbers", "voronoi", "points permuted and rotated", "1e-10")
def _(context):
    rows = points(context, "random", "-n", "100", "--domain", "sphere")
    order = random.Random(6).sample(range(len(rows)), len(rows))
    write_points("a.csv", rows)
    write_points("b.csv", [turn(rows[i]) for i in order])
    a, b = (context.table("voronoi", name, "--domain", "sphere") for name in ("a.csv", "b.csv"))
    assert [a[i]["sides"] for i in order] == [row["sides"] for row in b], "other sides"
    return nearly_equal([a[i]["steradians"] for i in order], [row["steradians"] for row in b], 1e-10)


@relation("numbers", "points", "parts or the whole, any number of points first", "the same bits")
def _(context):
    for options in (("sobol", "--scramble", "owen"), ("halton", "--dim", "4"), ("spherical-fibonacci", "--domain", "sphere"), ("faure",)):
        whole = points(context, *options, "-n", "100")
        parts = points(context, *options, "-n", "100", "--count", "37") + points(context, *options, "-n", "100", "--first", "37")
        assert whole == parts, f"{options}: other points"
    return "the same bits"


# --- light


def room_scene(model, path, factor=1.0):
    for surface in model.surfaces:
        surface.emission *= factor
    models.write_xml(model, Path(path))
    models.write_sensors(model, Path("room.pts"))
    return path


@relation("numbers", "irradiance", "light sources twice as bright", "twice, to the bit")
def _(context):
    once = context.irradiance(room_scene(models.room(), "one.xml"), "room.pts")
    twice = context.irradiance(room_scene(models.room(), "two.xml", 2.0), "room.pts")
    assert [2 * v for v in once] == twice, f"{once} and {twice}"
    return "twice, to the bit"


@relation("numbers", "render", "light sources four times as bright", "four times, to the bit")
def _(context):
    from runs import read_pfm
    values = []
    for name, factor in (("one.xml", 1.0), ("four.xml", 4.0)):
        context.image_bytes(room_scene(models.room(), name, factor), "--spp", "8")
        values.append(read_pfm(Path("bytes.pfm"))[2])
    assert [4 * v for v in values[0]] == list(values[1]), "other pixels"
    return "four times, to the bit"


@relation("numbers", "irradiance --weather", "line ends of the weather file", "the same bits")
def _(context):
    import subprocess
    epw = subprocess.run(["bash", str(context.source / "scripts/weather.sh")], capture_output=True, check=True).stdout
    models.write_rad(models.street().with_surfaces(models.street().surfaces), Path("street.rad"))
    text = Path("street.rad").read_text().split("\n", 2)[2]  # without its sky
    Path("street.rad").write_text(text)
    models.write_sensors(models.street(), Path("street.pts"))
    answers = []
    for name, data in (("lf.epw", epw.replace(b"\r\n", b"\n")), ("crlf.epw", epw.replace(b"\r\n", b"\n").replace(b"\n", b"\r\n"))):
        Path(name).write_bytes(data)
        answers.append(context.run("irradiance", "street.rad", "--sensors", "street.pts", "--weather", name, "-n", "256", "-q"))
    return equal_bytes(*answers)

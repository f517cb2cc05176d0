"""How the same model is written: formats, order, corners, comments, what is unused."""

import random
from pathlib import Path

import models
from relations import relation
from runs import equal_bytes, nearly_equal, same_means


def irradiances(context, scene, sensors, seeds):
    return [context.irradiance(scene, sensors, seed) for seed in seeds]


def room_against(context, scene):
    """Irradiances of a scene against those of the room as polygons in XML, with other seeds."""
    room = models.room()
    sensors = models.write_sensors(room, Path("room.pts"))
    models.write_xml(room, Path("room.xml"))
    return same_means(irradiances(context, "room.xml", sensors, range(context.seeds)),
                      irradiances(context, scene, sensors, range(100, 100 + context.seeds)))


def ply(form):
    return lambda model, path: models.write_ply(model, path, form)


MESHES = {"OBJ": ("obj", models.write_obj), "PLY, text": ("ply", ply("ascii")), "PLY, little-endian": ("ply", ply("binary_little_endian")),
          "PLY, big-endian": ("ply", ply("binary_big_endian")), "STL": ("stl", models.write_stl), "OFF": ("off", models.write_off)}
for _name, (_kind, _writer) in MESHES.items():
    @relation("writing", "irradiance", f"room as XML polygons or as {_name} in XML", "intervals")
    def _(context, kind=_kind, writer=_writer):
        return room_against(context, models.write_xml_of(models.room(), Path("meshes.xml"), writer, kind))

    @relation("writing", "viewfactors", f"triangles as OBJ or as {_name}", "1e-12")
    def _(context, kind=_kind, writer=_writer):
        plates = models.plates().triangulated()
        models.write_obj(plates, Path("reference.obj"))
        writer(plates, Path(f"other.{kind}"))
        return same_factors(context, "reference.obj", f"other.{kind}")


def same_factors(context, first, second, *options):
    a, b = context.factors(first, 0, *options), context.factors(second, 0, *options)
    assert sorted(a) == sorted(b), f"{len(a)} entries and {len(b)}"
    return nearly_equal([a[k][0] for k in sorted(a)], [b[k][0] for k in sorted(a)], 0.0, 1e-12)


@relation("writing", "irradiance", "room as XML or as .rad", "intervals")
def _(context):
    return room_against(context, models.write_rad(models.room(), Path("room.rad")))


@relation("writing", "viewfactors", "triangles as OBJ, XML, .rad or glTF", "1e-7 (glTF has floats)")
def _(context):
    plates = models.plates().triangulated()
    models.write_obj(plates, Path("reference.obj"))
    models.write_xml(plates, Path("other.xml"))
    models.write_rad(plates, Path("other.rad"))
    models.write_gltf(plates, Path("other.gltf"))
    a = context.factors("reference.obj")
    for other in ("other.xml", "other.rad", "other.gltf"):
        b = context.factors(other)
        assert sorted(a) == sorted(b), f"{other}: {len(a)} entries and {len(b)}"
        seen = nearly_equal([a[k][0] for k in sorted(a)], [b[k][0] for k in sorted(a)], 0.0, 1e-7)
    return seen


# --- corners


@relation("writing", "irradiance", "every first corner of every polygon, in OBJ, XML and .rad", "intervals")
def _(context):
    seen = ""
    for shift in range(1, 6 if context.full else 3):
        room = models.room().first_corner(shift)
        for scene in (models.write_xml(room, Path("corner.xml")), models.write_rad(room, Path("corner.rad")),
                      models.write_xml_of(room, Path("corners.xml"), models.write_obj, "obj")):
            seen = room_against(context, scene)
    return seen


L_ROOM = 2.0  # 1 / (1 - .5)


@relation("writing", "viewfactors --radiosity", "first corner of every face of a closed L-shaped room", "2, within intervals")
def _(context):
    room = models.room()
    shell = room.with_surfaces([s for s in room.surfaces if s.name in ("floor", "ceiling", "walls")])
    worst = 0.0
    for shift in range(6):
        models.write_obj(shell.first_corner(shift), Path("shell.obj"))
        for area, sky, value in context.radiosity("shell.obj", shift, "--radiosity", ".5", "--sky", "0", "--emission", "1", "--rays", "256"):
            assert abs(value - L_ROOM) < 1e-9 and abs(sky) < 1e-12, f"first corner {shift}: area {area}, sky {sky}, radiosity {value}"
            worst = max(worst, abs(value - L_ROOM))
    return f"{worst:.1e} apart"


@relation("writing", "viewfactors", "areas of concave facets by any first corner", "1e-12")
def _(context):
    for shift in range(6):
        models.write_obj(models.room().first_corner(shift), Path("room.obj"))
        areas = [row[0] for row in context.radiosity("room.obj", 0, "--group", "--radiosity", ".5", "--sky", "0", "--emission", "1", "--rays", "64")]
        seen = nearly_equal(areas[:2], [4 * 1.5 + 1.75 * 2.0] * 2, 1e-12)
    return seen


# --- order


@relation("writing", "irradiance", "order of surfaces, polygons and files", "intervals")
def _(context):
    room = models.room().shuffled(3)
    names = []
    for i, surface in enumerate(room.surfaces):
        names.append(f"part{i}.rad")
        models.write_rad(room.with_surfaces([surface]), Path(names[-1]))
    return room_against(context, names)


@relation("writing", "viewfactors", "order of facets: closed forms", "1e-12")
def _(context):
    plates = models.plates().triangulated()
    plates = plates.with_surfaces([models.Surface(f"t{i}", [p]) for i, p in enumerate(p for s in plates.surfaces for p in s.polygons)])
    models.write_obj(plates, Path("plates.obj"))
    models.write_obj(plates.with_surfaces(plates.surfaces[::-1]), Path("reversed.obj"))
    a, b, last = context.factors("plates.obj"), context.factors("reversed.obj"), plates.polygon_count() - 1
    turned = {(last - i, last - j if j >= 0 else -1): v for (i, j), v in b.items()}
    assert sorted(a) == sorted(turned), f"{sorted(a)} and {sorted(turned)}"
    return nearly_equal([a[k][0] for k in sorted(a)], [turned[k][0] for k in sorted(a)], 0.0, 1e-12)


@relation("writing", "viewfactors", "order of vertices in PLY", "the same bits")
def _(context):
    plates = models.plates().triangulated()
    corners = [c for s in plates.surfaces for p in s.polygons for c in p]
    order = random.Random(5).sample(range(len(corners)), len(corners))
    place = {old: new for new, old in enumerate(order)}
    head = (f"ply\nformat ascii 1.0\nelement vertex {len(corners)}\nproperty double x\nproperty double y\nproperty double z\n"
            f"element face {len(corners) // 3}\nproperty list uchar int vertex_indices\nend_header\n")
    rows = [models.numbers(corners[old]) for old in order] + [
        f"3 {place[i]} {place[i + 1]} {place[i + 2]}" for i in range(0, len(corners), 3)]
    Path("other.ply").write_text(head + "\n".join(rows) + "\n")
    models.write_ply(plates, Path("plates.ply"))
    return equal_bytes(context.factors("plates.ply"), context.factors("other.ply"))


# --- spelling


@relation("writing", "viewfactors", "OBJ with CRLF, CR, a byte order mark, comments, negative indices", "the same bits")
def _(context):
    plates = models.plates()
    models.write_obj(plates, Path("plates.obj"))
    reference = context.factors("plates.obj")
    text = Path("plates.obj").read_text()
    count = text.count("v ")
    negative = "\n".join(line if not line.startswith("f") else "f " + " ".join(str(int(i) - 1 - text[:text.index(line)].count("v ")) for i in line.split()[1:])
                         for line in text.splitlines()) + "\n"
    spellings = {"CRLF": text.replace("\n", "\r\n"), "CR": text.replace("\n", "\r"), "BOM": "\ufeff" + text,
                 "comments": text.replace("\n", " # a note\n"), "tabs": text.replace(" ", "\t"), "no last newline": text.rstrip("\n"),
                 "empty references": "\n".join(line if not line.startswith("f") else " ".join(w if w == "f" else w + "//" for w in line.split())
                                               for line in text.splitlines()),
                 "negative": negative, "vt of one number": "vt 0.5\n" + text}
    assert count == plates.polygon_count() * 4
    for name, spelled in spellings.items():
        Path("spelled.obj").write_bytes(spelled.encode())
        assert context.factors("spelled.obj") == reference, f"{name}: other factors"
    return "the same bits"


@relation("writing", "irradiance", "sensors as .pts, CSV and NPY", "the same bits")
def _(context):
    import struct
    room = models.room()
    models.write_xml(room, Path("room.xml"))
    models.write_sensors(room, Path("room.pts"))
    rows = [(*p, *n) for p, n in room.sensors]
    Path("room.csv").write_text("x,y,z,nx,ny,nz\n" + "".join(",".join(repr(v) for v in row) + "\n" for row in rows))
    header = str({"descr": "<f8", "fortran_order": False, "shape": (len(rows), 6)}).encode().ljust(117) + b"\n"
    Path("room.npy").write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + b"".join(struct.pack("<6d", *row) for row in rows))
    answers = [context.irradiance("room.xml", name) for name in ("room.pts", "room.csv", "room.npy")]
    assert answers[0] == answers[1] == answers[2], f"{answers}"
    return "the same bits"


@relation("writing", "irradiance", "an unused material is added, in .rad and XML", "the same bits")
def _(context):
    room = models.room()
    sensors = models.write_sensors(room, Path("room.pts"))
    models.write_rad(room, Path("room.rad"))
    models.write_xml(room, Path("room.xml"))
    for name, extra in (("room.rad", "void plastic unused 0 0 5 .2 .2 .2 .1 .2\nvoid metal unused2 0 0 5 .9 .9 .9 .9 .05\nvoid trans unused3 0 0 7 1 1 1 0 0 .5 .5\n"),
                        ("room.xml", '<bsdf type="roughconductor" id="unused"/>')):
        before = context.irradiance(name, sensors)
        text = Path(name).read_text()
        Path(name).write_text(text.replace("</scene>", extra + "</scene>") if name.endswith("xml") else extra + text)
        assert context.irradiance(name, sensors) == before, f"{name}: other irradiances"
    return "the same bits"


@relation("writing", "render", "order of keys, comments and white space in XML", "the same bits")
def _(context):
    models.write_xml(models.room(), Path("room.xml"))
    before = context.image_bytes("room.xml", "--spp", "4")
    text = Path("room.xml").read_text()
    first = '<float name="fov" value="70"/>'
    assert first in text
    spelled = text.replace(first, "").replace("</sensor>", '<float value="70" name="fov"/></sensor>')
    Path("spelled.xml").write_text("<?xml version='1.0'?>\n" + spelled.replace("><", ">\n<!-- a comment -->\n  <"))
    return equal_bytes(before, context.image_bytes("spelled.xml", "--spp", "4"))


# --- facets


@relation("writing", "viewfactors --group", "facets subdivided", "intervals")
def _(context):
    def answers(model, seeds):
        models.write_obj(model, Path("facets.obj"))
        found = [context.factors("facets.obj", seed, "--group", "--rays", "256") for seed in seeds]
        keys = [(i, j) for i in range(len(model.surfaces)) for j in range(-1, len(model.surfaces))]
        return [[f.get(k, (0.0, 0.0))[0] for k in keys] for f in found]

    room = models.room()
    return same_means(answers(room, range(context.seeds)), answers(room.subdivided(), range(100, 100 + context.seeds)), 1e-8)


@relation("writing", "irradiance", "facets subdivided", "intervals")
def _(context):
    return room_against(context, models.write_rad(models.room().subdivided(), Path("room.rad")))


@relation("writing", "convert", "an image as EXR and PFM", "the same bits")
def _(context):
    scene = context.source / "scenes/cornell-box/cornell-box.xml"
    context.run("render", scene, "--spp", "4", "--width", "24", "-q", "-o", "a.exr")
    context.run("convert", "a.exr", "a.pfm")
    context.run("convert", "a.pfm", "b.exr")
    context.run("convert", "b.exr", "b.pfm")
    return equal_bytes(Path("a.pfm").read_bytes(), Path("b.pfm").read_bytes())

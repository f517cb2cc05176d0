"""Small models that the relations move, rewrite and render. A model is a list of named surfaces of polygons, in doubles."""

import base64
import json
import math
import random
import struct


class Surface:
    """Polygons of one material. `reflectance` and `emission` are grey."""

    def __init__(self, name, polygons, reflectance=0.5, emission=0.0):
        self.name, self.polygons, self.reflectance, self.emission = name, polygons, reflectance, emission


class Model:
    """Surfaces, sensors (position and normal) and a camera (origin, target, up)."""

    def __init__(self, surfaces, sensors=(), camera=None, sky=0.0):
        self.surfaces, self.sensors, self.camera, self.sky = surfaces, list(sensors), camera, sky

    def mapped(self, point, normal, flip=False):
        """Every position through `point`, every direction through `normal`; `flip` reverses corners, for mirrors."""
        order = (lambda corners: corners[::-1]) if flip else (lambda corners: corners)
        surfaces = [Surface(s.name, [order([point(p) for p in polygon]) for polygon in s.polygons], s.reflectance, s.emission)
                    for s in self.surfaces]
        sensors = [(point(p), normal(n)) for p, n in self.sensors]
        camera = self.camera and (point(self.camera[0]), point(self.camera[1]), normal(self.camera[2]))
        return Model(surfaces, sensors, camera, self.sky)

    def moved(self, offset):
        return self.mapped(lambda p: tuple(a + b for a, b in zip(p, offset)), lambda n: n)

    def scaled(self, factor):
        return self.mapped(lambda p: tuple(factor * a for a in p), lambda n: n)

    def mirrored(self):
        return self.mapped(lambda p: (-p[0], p[1], p[2]), lambda n: (-n[0], n[1], n[2]), flip=True)

    def turned(self, degrees=(40.0, 25.0)):
        """About z and then about x."""
        a, b = (math.radians(d) for d in degrees)

        def turn(p):
            x, y, z = p
            x, y = x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a)
            return x, y * math.cos(b) - z * math.sin(b), y * math.sin(b) + z * math.cos(b)

        return self.mapped(turn, turn)

    def with_surfaces(self, surfaces):
        return Model(surfaces, self.sensors, self.camera, self.sky)

    def each_polygon(self, change):
        """Polygons replaced by the polygons that `change` returns for each."""
        return self.with_surfaces([Surface(s.name, [q for p in s.polygons for q in change(p)], s.reflectance, s.emission)
                                   for s in self.surfaces])

    def first_corner(self, shift):
        return self.each_polygon(lambda p: [p[shift % len(p):] + p[:shift % len(p)]])

    def shuffled(self, seed=1):
        surfaces = [Surface(s.name, random.Random(seed).sample(s.polygons, len(s.polygons)), s.reflectance, s.emission) for s in self.surfaces]
        random.Random(seed).shuffle(surfaces)
        return self.with_surfaces(surfaces)

    def triangulated(self):
        return self.each_polygon(triangles)

    def subdivided(self):
        """Each triangle in four, by the middles of its edges."""

        def quarter(t):
            a, b, c = t
            ab, bc, ca = (tuple((u + v) / 2 for u, v in zip(p, q)) for p, q in ((a, b), (b, c), (c, a)))
            return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]

        return self.triangulated().each_polygon(quarter)

    def polygon_count(self):
        return sum(len(s.polygons) for s in self.surfaces)


def triangles(polygon):
    """Ear clipping of a plane simple polygon, by its Newell normal."""
    normal = [0.0, 0.0, 0.0]
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            normal[k] += (p[i] - polygon[0][i]) * (q[j] - polygon[0][j]) - (p[j] - polygon[0][j]) * (q[i] - polygon[0][i])
    k = max(range(3), key=lambda axis: abs(normal[axis]))
    i, j = ((k + 1) % 3, (k + 2) % 3) if normal[k] > 0 else ((k + 2) % 3, (k + 1) % 3)

    def side(a, b, c):
        return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i])

    rest, found = list(polygon), []
    while len(rest) > 3:
        for at in range(len(rest)):
            a, b, c = rest[at - 1], rest[at], rest[(at + 1) % len(rest)]
            others = [p for p in rest if p not in (a, b, c)]
            if side(a, b, c) > 0 and not any(side(a, b, p) >= 0 and side(b, c, p) >= 0 and side(c, a, p) >= 0 for p in others):
                found.append([a, b, c])
                del rest[at]
                break
        else:
            raise ValueError("not a simple polygon")
    return found + [rest]


def box(x0, y0, z0, x1, y1, z1, sides="xXyYZ"):
    """The outer sides of a box: x is that of least x, X of largest; z, the bottom, only where it is named."""
    a, b, c, d = (x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0)
    e, f, g, h = (x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)
    faces = {"x": [a, e, h, d], "X": [b, c, g, f], "y": [a, b, f, e], "Y": [d, h, g, c], "z": [a, d, c, b], "Z": [e, f, g, h]}
    return [faces[s] for s in sides]


def room():
    """An L-shaped closed room of 4 by 3.5 by 2.5 with a table on a foot and a light source below the ceiling."""
    outline = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.5), (1.75, 1.5), (1.75, 3.5), (0.0, 3.5)]
    height = 2.5
    walls = [[(x0, y0, 0.0), (x0, y0, height), (x1, y1, height), (x1, y1, 0.0)]
             for (x0, y0), (x1, y1) in zip(outline, outline[1:] + outline[:1])]
    return Model([
        Surface("floor", [[(x, y, 0.0) for x, y in outline]], 0.3),
        Surface("ceiling", [[(x, y, height) for x, y in outline[::-1]]], 0.7),
        Surface("walls", walls, 0.5),
        Surface("table", box(2.25, 0.375, 0.75, 3.375, 1.125, 0.8125, "xXyYzZ") + box(2.75, 0.625, 0.0, 2.875, 0.75, 0.75, "xXyY"), 0.4),
        Surface("housing", box(0.75, 0.5, 2.25, 1.5, 1.25, 2.3125), 0.2),
        Surface("source", box(0.75, 0.5, 2.25, 1.5, 1.25, 2.3125, "z"), 0.0, 10.0),
    ], sensors=[((2.75, 1.0, 0.8125 + 0.125), (0.0, 0.0, 1.0)), ((0.875, 2.75, 1.25), (0.0, -1.0, 0.0)), ((3.5, 1.25, 1.0), (-1.0, 0.0, 0.0))],
        camera=((0.5, 3.25, 1.5), (2.0, 0.5, 1.0), (0.0, 0.0, 1.0)))


def street():
    """Two blocks of 10 m beside a street of 6 m, on the ground, under a uniform sky."""
    return Model([
        Surface("ground", [[(-20.0, -20.0, 0.0), (20.0, -20.0, 0.0), (20.0, 20.0, 0.0), (-20.0, 20.0, 0.0)]], 0.2),
        Surface("west", box(-13.0, -12.0, 0.0, -3.0, 12.0, 10.0), 0.4),
        Surface("east", box(3.0, -9.0, 0.0, 12.0, 14.0, 10.0), 0.6),
    ], sensors=[((0.0, 0.0, 1.0), (0.0, 0.0, 1.0)), ((-2.0, 3.0, 1.5), (1.0, 0.0, 0.0)), ((2.5, -8.0, 4.0), (-0.6, 0.0, 0.8))],
        camera=((0.0, -18.0, 2.0), (0.0, 10.0, 5.0), (0.0, 0.0, 1.0)), sky=1.0)


def plates():
    """Facets all of whose pairs have closed forms: two parallel squares, one tilted, one perpendicular."""
    return Model([
        Surface("below", [[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]]),
        Surface("above", [[(0.25, 0.0, 1.5), (0.25, 1.0, 1.5), (1.25, 1.0, 1.5), (1.25, 0.0, 1.5)]]),
        Surface("beside", [[(3.0, -1.0, 0.0), (3.0, -1.0, 1.0), (3.0, 2.0, 1.0), (3.0, 2.0, 0.0)]]),
    ])


def rug(gap):
    """A floor and a plate of .4 of its area that far above it."""
    under = [(0.1, 0.1, gap), (0.1, 0.9, gap), (0.6, 0.9, gap), (0.6, 0.1, gap)]
    return Model([Surface("floor", [[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]]), Surface("under", [under]),
                  Surface("top", [[(x, y, gap + 0.01) for x, y, _ in under[::-1]]])])


def numbers(values):
    return " ".join(repr(float(v)) for v in values)


def xml(model, shape, samples=4, far_clip=1e5, near_clip=1e-3, extra=""):
    """A Mitsuba scene; `shape` writes a surface's geometry and returns the elements that stand for it."""
    parts = ['<scene version="3.0.0">', '<integrator type="path"/>']
    if model.camera:
        eye, target, up = (", ".join(repr(float(v)) for v in p) for p in model.camera)
        parts.append(f'<sensor type="perspective"><float name="fov" value="70"/><float name="near_clip" value="{near_clip!r}"/>'
                     f'<float name="far_clip" value="{far_clip!r}"/>'
                     f'<transform name="to_world"><lookat origin="{eye}" target="{target}" up="{up}"/></transform>'
                     f'<sampler type="independent"><integer name="sample_count" value="{samples}"/></sampler>'
                     '<film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="12"/>'
                     '<rfilter type="box"/></film></sensor>')
    if model.sky:
        parts.append(f'<emitter type="constant"><rgb name="radiance" value="{model.sky}"/></emitter>')
    for surface in model.surfaces:
        inside = f'<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="{surface.reflectance}"/></bsdf></bsdf>'
        if surface.emission:
            inside += f'<emitter type="area"><rgb name="radiance" value="{surface.emission}"/></emitter>'
        parts += [f'<shape type="{kind}" id="{surface.name}{i}">{geometry}{inside}</shape>'
                  for i, (kind, geometry) in enumerate(shape(surface))]
    return "\n".join(parts + [extra, "</scene>", ""])


def write_xml(model, path, **options):
    def polygons(surface):
        return [("polygon", f'<string name="vertices" value="{numbers(v for p in polygon for v in p)}"/>') for polygon in surface.polygons]

    path.write_text(xml(model, polygons, **options))
    return path


def write_xml_of(model, path, writer, kind, **options):
    """A scene whose surfaces are files that `writer` makes."""

    def meshes(surface):
        name = f"{path.stem}-{surface.name}.{kind}"
        writer(model.with_surfaces([surface]), path.with_name(name))
        return [(kind, f'<string name="filename" value="{name}"/>')]

    path.write_text(xml(model, meshes, **options))
    return path


def write_obj(model, path, groups=True, end="\n"):
    lines, count = [], 0
    for surface in model.surfaces:
        lines += [f"g {surface.name}"] if groups else []
        for polygon in surface.polygons:
            lines += [f"v {numbers(p)}" for p in polygon]
            lines.append("f " + " ".join(str(count + i + 1) for i in range(len(polygon))))
            count += len(polygon)
    path.write_bytes((end.join(lines) + end).encode())
    return path


def write_ply(model, path, form="ascii"):
    polygons = [p for s in model.surfaces for p in s.polygons]
    corners = [c for p in polygons for c in p]
    head = (f"ply\nformat {form} 1.0\nelement vertex {len(corners)}\nproperty double x\nproperty double y\nproperty double z\n"
            f"element face {len(polygons)}\nproperty list uchar int vertex_indices\nend_header\n").encode()
    body, first, order = b"", 0, ">" if "big" in form else "<"
    for c in corners:
        body += (numbers(c) + "\n").encode() if form == "ascii" else struct.pack(order + "3d", *c)
    for p in polygons:
        indices = range(first, first + len(p))
        body += (f"{len(p)} {' '.join(map(str, indices))}\n").encode() if form == "ascii" else struct.pack(f"{order}B{len(p)}i", len(p), *indices)
        first += len(p)
    path.write_bytes(head + body)
    return path


def write_off(model, path):
    polygons = [p for s in model.surfaces for p in s.polygons]
    corners, first, faces = [c for p in polygons for c in p], 0, []
    for p in polygons:
        faces.append(f"{len(p)} " + " ".join(str(first + i) for i in range(len(p))))
        first += len(p)
    path.write_text("\n".join(["OFF", f"{len(corners)} {len(faces)} 0"] + [numbers(c) for c in corners] + faces) + "\n")
    return path


def write_stl(model, path):
    """Text, which has doubles; binary STL has floats."""
    lines = ["solid model"]
    for t in (t for s in model.surfaces for p in s.polygons for t in triangles(p)):
        lines += ["facet normal 0 0 0", "outer loop"] + [f"vertex {numbers(c)}" for c in t] + ["endloop", "endfacet"]
    path.write_text("\n".join(lines + ["endsolid model"]) + "\n")
    return path


def write_rad(model, path):
    lines = []
    if model.sky:
        lines += [f"void glow sky 0 0 4 {model.sky} {model.sky} {model.sky} 0", "sky source everywhere 0 0 4 0 0 1 360"]
    for s in model.surfaces:
        color = " ".join(3 * [repr(s.emission or s.reflectance)])
        lines.append(f"void light m_{s.name} 0 0 3 {color}" if s.emission else f"void plastic m_{s.name} 0 0 5 {color} 0 0")
        lines += [f"m_{s.name} polygon {s.name}{i} 0 0 {3 * len(p)} {numbers(v for c in p for v in c)}" for i, p in enumerate(s.polygons)]
    path.write_text("\n".join(lines) + "\n")
    return path


def write_gltf(model, path, offset=(0.0, 0.0, 0.0)):
    """glTF has floats and turns z up into y up; `offset` is the node's translation."""
    data, views, accessors, meshes = b"", [], [], []
    for s in model.surfaces:
        corners = [c for p in s.polygons for t in triangles(p) for c in t]
        turned = [(x, z, -y) for x, y, z in corners]
        packed = b"".join(struct.pack("<3f", *c) for c in turned)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": len(turned), "type": "VEC3",
                          "min": [min(c[k] for c in turned) for k in range(3)], "max": [max(c[k] for c in turned) for k in range(3)]})
        meshes.append({"name": s.name, "primitives": [{"attributes": {"POSITION": len(accessors) - 1}}]})
        data += packed
    x, y, z = offset
    nodes = [{"mesh": i, "name": m["name"], "translation": [x, z, -y]} for i, m in enumerate(meshes)]
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
        "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}))
    return path


def write_sensors(model, path):
    path.write_text("".join(numbers(p) + " " + numbers(n) + "\n" for p, n in model.sensors))
    return path

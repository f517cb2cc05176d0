#!/usr/bin/env python3
"""Compares view factors of Aureole with closed forms (Howell), pyviewfactor and raystrack, and measures a city.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install numpy scipy pyviewfactor raystrack
    /tmp/peers/bin/python bench/peers/view_factors.py build/release/aureole [rectangles] [curved] [box] [city] [growth] [coverage]

Without names all are run. CPU seconds are those of the process and its threads. pyviewfactor and raystrack are skipped
if they are not installed. View3D is neither in Debian nor on PyPI; `aureole viewfactors MESH -o MESH.vs3` writes its input.
"""
import math
import os
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy.sparse as sparse

HERE = os.path.dirname(os.path.abspath(__file__))
PI = math.pi


def parallel(a, b, c):
    """Howell C-11: opposed rectangles a x b at distance c."""
    x, y = a / c, b / c
    p, q = 1 + x * x, 1 + y * y
    return 2 / (PI * x * y) * (0.5 * math.log(p * q / (x * x + q)) + x * math.sqrt(q) * math.atan(x / math.sqrt(q))
                               + y * math.sqrt(p) * math.atan(y / math.sqrt(p)) - x * math.atan(x) - y * math.atan(y))


def perpendicular(h, w, l):
    """Howell C-14: rectangles with the common edge l, from the one of width w to that of height h."""
    H, W = h / l, w / l
    h2, w2 = H * H, W * W
    s = h2 + w2
    logs = (math.log((1 + w2) * (1 + h2) / (1 + s)) + w2 * math.log(w2 * (1 + s) / ((1 + w2) * s))
            + h2 * math.log(h2 * (1 + s) / ((1 + h2) * s)))
    return (W * math.atan(1 / W) + H * math.atan(1 / H) - math.sqrt(s) * math.atan(1 / math.sqrt(s)) + logs / 4) / (PI * W)


def write_obj(path, groups):
    """groups: {name: [polygon, ..]}, a polygon a list of corners."""
    count = 0
    with open(path, "w") as out:
        for name, polygons in groups.items():
            out.write(f"g {name}\n")
            for polygon in polygons:
                for corner in polygon:
                    out.write("v {:.9g} {:.9g} {:.9g}\n".format(*corner))
                out.write("f " + " ".join(str(count + i + 1) for i in range(len(polygon))) + "\n")
                count += len(polygon)


def run(program, *arguments):
    """CPU seconds of the program, and its peak memory in megabytes. A small process starts it, because a child's peak includes
    its parent's memory."""
    code = ("import resource, subprocess, sys\nstatus = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode\n"
            "used = resource.getrusage(resource.RUSAGE_CHILDREN)\n"
            "print(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)\nsys.exit(status)")
    command = [sys.executable, "-S", "-c", code, program, "viewfactors", "-q", *map(str, arguments)]
    return tuple(map(float, subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.split()))


def load(path):
    with np.load(path) as data:
        return sparse.load_npz(path), data["areas"], data["sky"], data["half_widths"]


def box(low, high, inside):
    corner = [[(low, high)[i >> d & 1][d] for d in range(3)] for i in range(8)]
    faces = [(0, 4, 6, 2), (0, 1, 5, 4), (0, 2, 3, 1), (1, 3, 7, 5), (2, 6, 7, 3), (4, 5, 7, 6)]
    return [[corner[i] for i in (reversed(face) if inside else face)] for face in faces]


def rectangles(program, folder):
    try:
        import pyvista
        import pyviewfactor
    except ImportError:
        pyviewfactor = None
    print("| pair | closed form | Aureole, relative error | pyviewfactor, relative error |\n|---|---|---|---|")
    # Sides that are exact in single precision.
    cases = [("opposed 1 x 1 at 1", parallel(1, 1, 1), ([0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]),
              ([0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1])),
             ("opposed 4 x 2 at .03125", parallel(4, 2, 1 / 32), ([0, 0, 0], [4, 0, 0], [4, 2, 0], [0, 2, 0]),
              ([0, 0, 1 / 32], [0, 2, 1 / 32], [4, 2, 1 / 32], [4, 0, 1 / 32])),
             ("opposed 1 x 1 at 32", parallel(1, 1, 32), ([0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]),
              ([0, 0, 32], [0, 1, 32], [1, 1, 32], [1, 0, 32])),
             ("common edge 1, 1 and 1", perpendicular(1, 1, 1), ([0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]),
              ([0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1])),
             ("common edge 2, .125 and 4", perpendicular(4, 0.125, 2), ([0, 0, 0], [0.125, 0, 0], [0.125, 2, 0], [0, 2, 0]),
              ([0, 0, 0], [0, 2, 0], [0, 2, 4], [0, 0, 4]))]
    path, out = os.path.join(folder, "pair.obj"), os.path.join(folder, "pair.npz")
    for name, exact, first, second in cases:
        write_obj(path, {"first": [first], "second": [second]})
        run(program, path, "--group", "-o", out)
        ours = load(out)[0][0, 1]
        theirs = ""
        if pyviewfactor is not None:
            # Its function returns the factor from the second cell to the first.
            a, b = (pyvista.PolyData(np.array(c, float), faces=[4, 0, 1, 2, 3]) for c in (first, second))
            theirs = f"{pyviewfactor.compute_viewfactor(b, a) / exact - 1:.1e}"
        print(f"| {name} | {exact:.12g} | {ours / exact - 1:.1e} | {theirs} |")


def ring(radius, z, n):
    """A polygon of n corners with the area of a circle."""
    wide = radius * math.sqrt(2 * PI / n / math.sin(2 * PI / n))
    return [(wide * math.cos(2 * PI * k / n), wide * math.sin(2 * PI * k / n), z) for k in range(n)]


def sphere(center, radius, rows, opening=0.0, inside=False):
    """Rows of quadrilaterals, from the polar angle of an opening downwards."""
    polar = [opening + (PI - opening) * i / rows for i in range(rows + 1)]
    corner = lambda i, k: tuple(c + radius * x for c, x in zip(center, (
        math.sin(polar[i]) * math.cos(PI * k / rows), math.sin(polar[i]) * math.sin(PI * k / rows), math.cos(polar[i]))))
    faces = []
    for i in range(rows):
        for k in range(2 * rows):
            face = [corner(i, k), corner(i + 1, k), corner(i + 1, (k + 1) % (2 * rows)), corner(i, (k + 1) % (2 * rows))]
            if i == rows - 1:
                face = face[:2] + face[3:]
            if i == 0 and opening == 0:
                face = face[:-1]
            faces.append(face[::-1] if inside else face)
    return faces


def cylinders(x, y):
    """Howell C-91 and C-92: from the outer coaxial cylinder (radius x, length y) to the inner one (radius 1), and to itself."""
    a, b, root = y * y + x * x - 1, y * y - x * x + 1, math.sqrt(4 * x * x + y * y)
    inwards = 1 / x * (1 - 1 / PI * (math.acos(b / a) - 0.5 / y * (math.sqrt((a + 2) ** 2 - 4 * x * x) * math.acos(b / (x * a))
                                                                   + b * math.asin(1 / x) - 0.5 * PI * a)))
    itself = 1 - 1 / x + 2 / (PI * x) * math.atan(2 * math.sqrt(x * x - 1) / y) - y / (2 * PI * x) * (
        root / y * math.asin((4 * (x * x - 1) + y * y / (x * x) * (x * x - 2)) / (y * y + 4 * (x * x - 1)))
        - math.asin((x * x - 2) / (x * x)) + 0.5 * PI * (root / y - 1))
    return inwards, itself


def curved(program, folder):
    """Howell's disks, cylinders and sphere, and Sparrow's cavity, as polygons with an increasing number of corners."""
    path, out = os.path.join(folder, "curved.obj"), os.path.join(folder, "curved.npz")
    print("\n| surfaces | corners | facets | exact | relative error | CPU s |\n|---|---|---|---|---|---|")

    def row(name, corners, groups, known, found, *options):
        write_obj(path, groups)
        cpu, _ = run(program, path, *options, "-o", out)
        matrix, areas, _, _ = load(out)
        value = found(matrix, areas)
        facets = sum(len(polygon) - 2 for polygons in groups.values() for polygon in polygons)
        print(f"| {name} | {corners} | {facets} | {known(areas):.9g} | {value / known(areas) - 1:.1e} | {cpu:.1f} |", flush=True)

    x = 1 + (1 + 1) / 1  # radii 1 and 1 at distance 1
    disks = 0.5 * (x - math.sqrt(x * x - 4))
    inwards, itself = cylinders(2, 3)
    for n in (24, 48, 96):
        row("disks 1 and 1 at 1 (C-41)", n, {"low": [ring(1, 0, n)], "high": [ring(1, 1, n)[::-1]]}, lambda _: disks,
            lambda m, _: m[0, 1], "--group")
        walls = {}
        for name, radius in (("outer", 2), ("inner", 1)):
            low, high = ring(radius, 0, n), ring(radius, 3, n)
            quads = [[low[k], low[(k + 1) % n], high[(k + 1) % n], high[k]] for k in range(n)]
            walls[name] = [q[::-1] if name == "outer" else q for q in quads]
        row("cylinders 2 and 1, outer to inner (C-91)", n, walls, lambda _: inwards, lambda m, _: m[0, 1], "--group")
        row("the outer one to itself (C-92)", n, walls, lambda _: itself, lambda m, _: m[0, 0], "--group")
    ball = {"room": box((-1, -1, -1), (1, 2, 1), True), "ball": sphere((0.1, 0.2, -0.1), 0.6, 8)}
    row("sphere in a box, box to sphere", 16, ball, lambda areas: areas[1] / areas[0], lambda m, _: m[0, 1], "--group")
    opening, emittance = PI / 4, 0.5
    cavity = emittance / (1 - (1 - emittance) * 0.5 * (1 + math.cos(opening)))

    def mean(matrix, areas):
        light = total = np.full(len(areas), emittance)
        for _ in range(80):
            light = (1 - emittance) * (matrix @ light)
            total = total + light
        return (areas * total).sum() / areas.sum()
    for rows in (6, 12):
        row("Sparrow's cavity, open to 45 degrees: radiosity at emittance .5", 2 * rows,
            {"cavity": sphere((0, 0, 0), 1, rows, opening, True)}, lambda _: cavity, mean)


def enclosed(program, folder):
    """A box in a box: the inner one sees only the outer one, which determines two factors."""
    outer, inner = box((-1, -1, -1), (1, 2, 1), True), box((-0.25, 0, -0.5), (0.5, 0.75, 0.25), False)
    areas = 32.0, 6 * 0.75 ** 2
    exact = areas[1] / areas[0]
    path, out = os.path.join(folder, "box.obj"), os.path.join(folder, "box.npz")
    write_obj(path, {"outer": outer, "inner": inner})
    print("\n| box in a box, outer to inner | rays | CPU s | relative error | row sum - 1 |\n|---|---|---|---|---|")
    for rays in (256, 2048):
        cpu, _ = run(program, path, "--group", "--rays-only", "--rays", rays, "-o", out)
        matrix, _, sky, _ = load(out)
        print(f"| Aureole, rays only, a facet {rays} | {24 * rays} | {cpu:.2f} | {matrix[0, 1] / exact - 1:.1e} | "
              f"{matrix[0].sum() + sky[0] - 1:.1e} |")
    cpu, _ = run(program, path, "--group", "-o", out)
    matrix, _, sky, _ = load(out)
    print(f"| Aureole, with closed forms | {24 * 2048} | {cpu:.2f} | {matrix[0, 1] / exact - 1:.1e} | "
          f"{matrix[0].sum() + sky[0] - 1:.1e} |")
    try:
        import raystrack
    except ImportError:
        return
    def mesh(polygons):
        vertices = np.array([c for p in polygons for c in p], np.float32)
        faces = np.array([[4 * i, 4 * i + 1 + k, 4 * i + 2 + k] for i in range(len(polygons)) for k in range(2)], np.int32)
        return raystrack.Mesh(vertices, faces)
    scene = raystrack.Scene([raystrack.Surface("outer", mesh(outer)), raystrack.Surface("inner", mesh(inner))])
    solver = raystrack.Solver(scene, device="cpu")
    for replicates in (1, 8, 32):
        options = raystrack.SolveOptions(accuracy=raystrack.Accuracy(max_replicates=replicates, min_replicates=1, tolerance=0.0))
        solver.solve(raystrack.Query(), options)  # the first call compiles
        start = time.process_time()
        result = solver.solve(raystrack.Query(), options)
        cpu = time.process_time() - start
        row = result.data.row_indices == result.sender_ids.index("outer")
        values = result.data.estimates[row]
        channels = [result.channels[i] for i in result.data.channel_indices[row]]
        factor = sum(v for v, c in zip(values, channels) if c.surface_id == "inner" and c.side == "front")
        print(f"| raystrack, {replicates} replicates | {result.rays_used} | {cpu:.2f} | {factor / exact - 1:.1e} | "
              f"{values.sum() - 1:.1e} |")


def radiosities(matrix, areas, light, reflectance=0.3):
    """The initial emission of the facets for `light`."""
    total = light.copy()
    for _ in range(80):
        light = reflectance * (matrix @ light)
        total += light
    return total


def make_city(folder, facets):
    path = os.path.join(folder, f"city-{facets}.obj")
    subprocess.run([sys.executable, os.path.join(HERE, "city.py"), path, "--facets", str(facets)], check=True)
    return path


def difference(areas, a, b):
    """The error of one seed: the area-weighted root mean square difference of two, divided by the root of 2 and the mean; and the largest."""
    mean = (areas * a).sum() / areas.sum()
    return (math.sqrt((areas * (a - b) ** 2).sum() / areas.sum() / 2) / mean, abs(a - b).max() / math.sqrt(2) / mean)


def sun(program, path, folder, arguments):
    """CPU seconds, error and largest error of radiosities under the sun alone, from two seeds."""
    outs = [os.path.join(folder, f"sun-{seed}.csv") for seed in (1, 2)]
    cpu = np.mean([run(program, path, "--radiosity", 0.3, "--sun", "1,2,3", "--seed", seed, *arguments, "-o", outs[seed - 1])[0]
                   for seed in (1, 2)])
    rows = [np.loadtxt(out, delimiter=",", skiprows=1) for out in outs]
    return cpu, *difference(rows[0][:, 1], rows[0][:, 3], rows[1][:, 3])


def city(program, folder, settings=([], ["--rays", 4096, "--half-planes", 2048]),
         suns=([], ["--rays", 4096, "--half-planes", 1024])):
    path = make_city(folder, 22000)
    print("\n| city of 22,160 facets | CPU s | entries | closed share | rows - 1 | asymmetry |\n|---|---|---|---|---|---|")
    table = "\n| light, reflectance .3 | how | CPU s | error | worst facet |\n|---|---|---|---|---|\n"
    line = "| {} | {} | {:.0f} | {:.3f} % | {:.1f} % |\n"
    for arguments in settings:
        out = [os.path.join(folder, f"city-{seed}.npz") for seed in (1, 2)]
        cpu = np.mean([run(program, path, "--seed", seed, *arguments, "-o", out[seed - 1])[0] for seed in (1, 2)])
        loaded = [load(o) for o in out]
        matrix, areas, sky, widths = loaded[0]
        with np.load(out[0]) as data:
            back = data["back"]
        light = matrix.data * np.repeat(areas, np.diff(matrix.indptr))
        exchange = sparse.diags(areas) @ matrix
        rows = abs(np.asarray(matrix.sum(axis=1)).ravel() + sky + back - 1).max()
        how = " ".join(map(str, arguments)) or "defaults"
        print(f"| {how} | {cpu:.0f} | {matrix.nnz:,} | {light[widths == 0].sum() / light.sum():.2f} | {rows:.0e} | "
              f"{abs(exchange - exchange.T).max() / abs(exchange).max():.0e} |", flush=True)
        first = {"sky": [0.3 * l[2] for l in loaded], "emission": [np.ones(len(areas))] * 2}
        for name, lights in first.items():
            error, worst = difference(areas, *(radiosities(l[0], areas, light) for l, light in zip(loaded, lights)))
            table += line.format(name, how, cpu, 100 * error, 100 * worst)
    for arguments in suns:
        cpu, error, worst = sun(program, path, folder, arguments)
        table += line.format("sun", " ".join(map(str, arguments)) or "defaults", cpu, 100 * error, 100 * worst)
    print(table)


def growth(program, folder):
    """CPU seconds and peak memory of each; the error of the radiosities that --matrix-free reports."""
    print("\n| facets | matrix: CPU s | entries | memory | matrix-free, 64 rays: CPU s | memory | reported error |\n|---|---|---|---|---|---|---|")
    for facets in (1000, 5000, 22000, 100000, 1000000):
        path, out, table = make_city(folder, facets), os.path.join(folder, "grown.npz"), os.path.join(folder, "b.csv")
        with_matrix, entries, memory = "", "", ""
        if facets <= 22000:
            cpu, peak = run(program, path, "-o", out)
            with_matrix, entries, memory = f"{cpu:.1f}", f"{load(out)[0].nnz:,}", f"{peak:.0f} MB"
        free, peak = run(program, path, "--radiosity", 0.3, "--matrix-free", "--rays", 64, "-o", table)
        rows = np.loadtxt(table, delimiter=",", skiprows=1)
        # Student's t of 95 % for 8 randomizations.
        error = math.sqrt((rows[:, 1] * (rows[:, 4] / 2.3646) ** 2).sum() / rows[:, 1].sum()) / ((rows[:, 1] * rows[:, 3]).sum() / rows[:, 1].sum())
        print(f"| {len(rows):,} | {with_matrix} | {entries} | {memory} | {free:.1f} | {peak:.0f} MB | {100 * error:.1f} % |", flush=True)


def coverage(program, folder):
    """Coverage of 95 % intervals of the factor over 1,000 seeds: facets of a room, and its groups."""
    path, out = os.path.join(folder, "room.obj"), os.path.join(folder, "room.npz")
    write_obj(path, {f"side-{i}": [p] for i, p in enumerate(box((0, 0, 0), (3, 4, 2.5), True))})
    print("\n| 1,000 seeds, rays only | factors | held by their intervals of 95 % |\n|---|---|---|")
    for group in ([], ["--group"]):
        run(program, path, *group, "-o", out)
        exact = load(out)[0].toarray()
        for rays in (64, 1024):
            held = known = 0
            for seed in range(1000):
                run(program, path, *group, "--rays-only", "--rays", rays, "--seed", seed, "-o", out)
                matrix, _, _, widths = load(out)
                found = matrix.toarray()
                matrix.data = widths
                width = matrix.toarray()
                upper = np.triu(np.ones_like(exact, bool), 1) & (exact > 0)
                held += (abs(found - exact) <= width)[upper].sum()
                known += upper.sum()
            print(f"| {'groups' if group else 'facets'}, {rays} rays a facet | {known // 1000} | {100 * held / known:.1f} % |", flush=True)


def main():
    program = os.path.abspath(sys.argv[1])
    parts = {"rectangles": rectangles, "curved": curved, "box": enclosed, "city": city, "growth": growth, "coverage": coverage}
    with tempfile.TemporaryDirectory() as folder:
        for name in sys.argv[2:] or parts:
            parts[name](program, folder)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Compares view factors of Aureole with closed forms (Howell), pyviewfactor and raystrack, and measures a city.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install numpy scipy pyviewfactor raystrack
    /tmp/peers/bin/python bench/peers/view_factors.py build/release/aureole [rectangles] [box] [city] [growth] [coverage]

Without names all are run. CPU seconds are those of the process and its threads. pyviewfactor and raystrack are left out
where they are not installed. View3D is neither in Debian nor on PyPI; `aureole viewfactors MESH -o MESH.vs3` writes its input.
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
    """Howell C-11: opposed rectangles a x b at the distance c."""
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
    """CPU seconds of the program, and the most megabytes that it has had."""
    child = subprocess.Popen([program, "viewfactors", "-q", *map(str, arguments)])
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"viewfactors {arguments} ended with status {child.returncode}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


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
    # Sides that floats hold exactly.
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
            # Its function gives the factor from the second cell to the first.
            a, b = (pyvista.PolyData(np.array(c, float), faces=[4, 0, 1, 2, 3]) for c in (first, second))
            theirs = f"{pyviewfactor.compute_viewfactor(b, a) / exact - 1:.1e}"
        print(f"| {name} | {exact:.12g} | {ours / exact - 1:.1e} | {theirs} |")


def enclosed(program, folder):
    """A box in a box: the inner one sees the outer one only, so that two factors are known."""
    outer, inner = box((-1, -1, -1), (1, 2, 1), True), box((-0.25, 0, -0.5), (0.5, 0.75, 0.25), False)
    areas = 32.0, 6 * 0.75 ** 2
    exact = areas[1] / areas[0]
    path, out = os.path.join(folder, "box.obj"), os.path.join(folder, "box.npz")
    write_obj(path, {"outer": outer, "inner": inner})
    print("\n| box in a box, outer to inner | rays | CPU s | relative error | row sum - 1 |\n|---|---|---|---|---|")
    for rays in (256, 4096):
        cpu, _ = run(program, path, "--group", "--rays-only", "--rays", rays, "-o", out)
        matrix, _, sky, _ = load(out)
        print(f"| Aureole, rays only, a facet {rays} | {24 * rays} | {cpu:.2f} | {matrix[0, 1] / exact - 1:.1e} | "
              f"{matrix[0].sum() + sky[0] - 1:.1e} |")
    cpu, _ = run(program, path, "--group", "-o", out)
    matrix, _, sky, _ = load(out)
    print(f"| Aureole, with closed forms | {24 * 4096} | {cpu:.2f} | {matrix[0, 1] / exact - 1:.1e} | "
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
        solver.solve(raystrack.Query(), options)  # compiled once
        start = time.process_time()
        result = solver.solve(raystrack.Query(), options)
        cpu = time.process_time() - start
        row = result.data.row_indices == result.sender_ids.index("outer")
        values = result.data.estimates[row]
        channels = [result.channels[i] for i in result.data.channel_indices[row]]
        factor = sum(v for v, c in zip(values, channels) if c.surface_id == "inner" and c.side == "front")
        print(f"| raystrack, {replicates} replicates | {result.rays_used} | {cpu:.2f} | {factor / exact - 1:.1e} | "
              f"{values.sum() - 1:.1e} |")


def radiosities(path):
    """Areas and radiosities of what --radiosity has written."""
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    return table[:, 1], table[:, 3]


def make_city(folder, facets):
    path = os.path.join(folder, f"city-{facets}.obj")
    subprocess.run([sys.executable, os.path.join(HERE, "city.py"), path, "--facets", str(facets)], check=True)
    return path


def difference(paths):
    """The error of one seed: the root mean square difference of two over the root of 2, by area, over the mean; and the worst."""
    (areas, a), (_, b) = (radiosities(path) for path in paths)
    mean = (areas * a).sum() / areas.sum()
    return (math.sqrt((areas * (a - b) ** 2).sum() / areas.sum() / 2) / mean, abs(a - b).max() / math.sqrt(2) / mean)


LIGHTS = {"sky": [], "sun": ["--sun", "1,2,3"], "emission": ["--emission", 1]}


def city(program, folder):
    path = make_city(folder, 22000)
    out = os.path.join(folder, "city.npz")
    print("\n| city of 22,160 facets | CPU s | entries | closed share | rows - 1 | asymmetry |\n|---|---|---|---|---|---|")
    cpu, _ = run(program, path, "-o", out)
    matrix, areas, sky, widths = load(out)
    with np.load(out) as data:
        back = data["back"]
    light = matrix.data * np.repeat(areas, np.diff(matrix.indptr))
    exchange = sparse.diags(areas) @ matrix
    rows = abs(np.asarray(matrix.sum(axis=1)).ravel() + sky + back - 1).max()
    print(f"| defaults | {cpu:.0f} | {matrix.nnz:,} | {light[widths == 0].sum() / light.sum():.2f} | {rows:.0e} | "
          f"{abs(exchange - exchange.T).max() / abs(exchange).max():.0e} |")
    print("\n| light, reflectance .3 | how | CPU s | error | worst facet |\n|---|---|---|---|---|", flush=True)
    for arguments in ([], ["--rays", 8192, "--randomizations", 4], ["--matrix-free"],
                      ["--matrix-free", "--rays", 16384, "--randomizations", 4]):
        for name, source in LIGHTS.items():
            paths = [os.path.join(folder, f"city-{seed}.csv") for seed in (1, 2)]
            cpu = np.mean([run(program, path, "--radiosity", 0.3, *source, *arguments, "--seed", seed, "-o", paths[seed - 1])[0]
                           for seed in (1, 2)])
            error, worst = difference(paths)
            print(f"| {name} | {' '.join(map(str, arguments)) or 'defaults'} | {cpu:.0f} | {100 * error:.3f} % | {100 * worst:.1f} % |",
                  flush=True)


def growth(program, folder):
    """CPU seconds and the most memory of each; the error of the radiosities that --matrix-free tells itself."""
    print("\n| facets | matrix: CPU s | entries | memory | matrix-free, 64 rays: CPU s | memory | error told |\n|---|---|---|---|---|---|---|")
    for facets in (1000, 5000, 22000, 100000, 1000000):
        path, out, table = make_city(folder, facets), os.path.join(folder, "grown.npz"), os.path.join(folder, "b.csv")
        with_matrix, entries, memory = "", "", ""
        if facets <= 22000:
            cpu, peak = run(program, path, "-o", out)
            with_matrix, entries, memory = f"{cpu:.1f}", f"{load(out)[0].nnz:,}", f"{peak:.0f} MB"
        free, peak = run(program, path, "--radiosity", 0.3, "--matrix-free", "--rays", 64, "-o", table)
        rows = np.loadtxt(table, delimiter=",", skiprows=1)
        # Student's t of 95 % for 8 randomisations.
        error = math.sqrt((rows[:, 1] * (rows[:, 4] / 2.3646) ** 2).sum() / rows[:, 1].sum()) / ((rows[:, 1] * rows[:, 3]).sum() / rows[:, 1].sum())
        print(f"| {len(rows):,} | {with_matrix} | {entries} | {memory} | {free:.1f} | {peak:.0f} MB | {100 * error:.1f} % |", flush=True)


def coverage(program, folder):
    """How often intervals of 95 % hold the factor, over 1,000 seeds: facets of a room, and its groups."""
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
    parts = {"rectangles": rectangles, "box": enclosed, "city": city, "growth": growth, "coverage": coverage}
    with tempfile.TemporaryDirectory() as folder:
        for name in sys.argv[2:] or parts:
            parts[name](program, folder)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Time to the first pixel and peak memory of large scenes, compared with Mitsuba 3 and Embree alone
(needs `pip install mitsuba`; Embree from its shared library).

    large.py PROGRAM [CASE...] [--triangles 30e6] [--folder FOLDER] [--variants llvm_ad_rgb,scalar_rgb] [--limit 600]

Cases: triangles, instances, textures, lights, materials; by default all. Each program renders one sample of 64 x 48 pixels on one
thread in a separate process; a row has its CPU seconds (user and system) and peak resident memory. Embree alone
builds the same triangles or instances from arrays in memory. FOLDER stores the scenes.
"""
import argparse
import ctypes
import os
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

HEAD = """<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="4"/></integrator>
<sensor type="perspective"><float name="fov" value="45"/><transform name="to_world"><lookat origin="0,-3,2" target="0,0,0" up="0,0,1"/></transform>
<film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="48"/><rfilter type="box"/></film>
<sampler type="independent"><integer name="sample_count" value="1"/></sampler></sensor>
"""
SKY = '<emitter type="constant"/>\n'


def grid(count, phase=0.0):
    """A wavy square of at least `count` triangles: vertices and indices."""
    n = int(np.ceil(np.sqrt(count / 2)))
    x, y = np.meshgrid(np.linspace(-1, 1, n + 1, dtype=np.float32), np.linspace(-1, 1, n + 1, dtype=np.float32))
    z = (0.1 * np.sin(9 * x + phase) * np.cos(7 * y)).astype(np.float32)
    corners = np.stack([x, y, z], -1).reshape(-1, 3)
    i = (np.arange(n, dtype=np.int32)[:, None] * (n + 1) + np.arange(n, dtype=np.int32)).reshape(-1, 1)
    triples = np.concatenate([i + [0, 1, n + 1], i + [1, n + 2, n + 1]]).astype(np.int32)
    return corners, triples


def write_ply(path, corners, triples):
    faces = np.empty(len(triples), dtype=[("count", "u1"), ("index", "<i4", 3)])
    faces["count"], faces["index"] = 3, triples
    with open(path, "wb") as out:
        out.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(corners)}\nproperty float x\nproperty float y\n"
                  f"property float z\nelement face {len(triples)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        corners.tofile(out)
        faces.tofile(out)


def shape(kind, inside="", transform=""):
    placed = f'<transform name="to_world">{transform}</transform>' if transform else ""
    return f'<shape type="{kind}">{placed}{inside}</shape>\n'


def text(name, value):
    return f'<string name="{name}" value="{value}"/>'


def grey(value):
    return f'<bsdf type="diffuse"><rgb name="reflectance" value="{value}"/></bsdf>'


def make_triangles(given):
    """Four meshes."""
    for k in range(4):
        write_ply(f"mesh{k}.ply", *grid(given.triangles / 4, k))
    return HEAD + SKY + "".join(
        shape("ply", text("filename", f"mesh{k}.ply") + '<boolean name="face_normals" value="true"/>' + grey(0.5),
              f'<translate z="{-0.1 * k}"/>') for k in range(4))


def make_instances(given):
    """A hundred thousand of a mesh of 5,000 triangles."""
    write_ply("small.ply", *grid(5000))
    group = f'<shape type="shapegroup" id="g">{shape("ply", text("filename", "small.ply") + grey(0.5))}</shape>\n'
    return HEAD + SKY + group + "".join(
        shape("instance", '<ref id="g"/>', f'<scale value=".003"/><translate x="{(i % 316) / 158 - 1:.5f}" y="{(i // 316) / 158 - 1:.5f}"/>')
        for i in range(100000))


def make_textures(given):
    """Twelve of 4096 x 4096, eight PNG and four JPEG."""
    import mitsuba as mi
    mi.set_variant("scalar_rgb")
    body = ""
    for k in range(12):
        name = f"t{k}.{'png' if k < 8 else 'jpg'}"
        x = np.linspace(0, 1, 4096)
        wave = 0.5 + 0.4 * np.sin(20 * (k + 1) * x[:, None] + np.stack([9 * x, 7 * x, 5 * x], -1)[None, :, :].transpose(2, 0, 1))
        mi.Bitmap((255 * wave.transpose(1, 2, 0)).astype(np.uint8)).write(name)
        bitmap = f'<texture type="bitmap" name="reflectance">{text("filename", name)}</texture>'
        body += shape("rectangle", f'<bsdf type="twosided"><bsdf type="diffuse">{bitmap}</bsdf></bsdf>',
                      f'<scale value=".2"/><translate x="{(k % 4 - 1.5) / 2}" y="{(k // 4 - 1) / 2}"/>')
    return HEAD + SKY + body


def make_lights(given):
    """Ten thousand small emitting squares over a floor."""
    lights = "".join(
        shape("rectangle", '<emitter type="area"><rgb name="radiance" value="9"/></emitter>',
              f'<scale value=".002"/><rotate x="1" angle="180"/><translate x="{(i % 100) / 50 - 1}" y="{(i // 100) / 50 - 1}" z=".3"/>')
        for i in range(10000))
    return HEAD + shape("rectangle", grey(0.5)) + lights


def make_materials(given):
    """A thousand objects of twenty materials, and a thousand rough plastics that nothing uses."""
    rough = '<float name="alpha" value="{}"/><rgb name="diffuse_reflectance" value=".4"/>'
    unused = "".join(f'<bsdf type="roughplastic" id="m{k}">{rough.format(0.05 + k * 1e-4)}</bsdf>\n' for k in range(1000))
    used = "".join(f'<bsdf type="roughplastic" id="u{k}">{rough.format(0.1 + k * 1e-2)}</bsdf>\n' for k in range(20))
    return HEAD + SKY + unused + used + "".join(
        shape("sphere", f'<ref id="u{i % 20}"/>', f'<scale value=".02"/><translate x="{(i % 32) / 16 - 1}" y="{(i // 32) / 16 - 1}"/>') for i in range(1000))


CASES = {"triangles": make_triangles, "instances": make_instances, "textures": make_textures, "lights": make_lights,
         "materials": make_materials}

# The image is not written as EXR, because writing never ends in a pool of one thread.
MITSUBA = """import sys, mitsuba as mi, numpy as np
mi.set_variant(sys.argv[1])
if "llvm" in sys.argv[1]:
    import drjit as dr
    dr.set_thread_count(1)
scene = mi.load_file(sys.argv[2], parallel=False)
np.save(sys.argv[3], np.array(mi.render(scene, spp=1)))
"""


class Embree:
    """The part of Embree's interface for triangles and instances."""

    def __init__(self):
        for name in ("libembree4.so.4", "libembree3.so.3"):
            try:
                self.library = ctypes.CDLL(name)
                break
            except OSError:
                continue
        pointer, size, number = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_uint
        self.call("rtcNewDevice", pointer, ctypes.c_char_p)
        self.device = self.library.rtcNewDevice(b"threads=1")
        for name, result, *arguments in (("rtcNewScene", pointer, pointer), ("rtcNewGeometry", pointer, pointer, ctypes.c_int),
                                         ("rtcCommitGeometry", None, pointer), ("rtcAttachGeometry", number, pointer, pointer),
                                         ("rtcCommitScene", None, pointer), ("rtcSetGeometryInstancedScene", None, pointer, pointer),
                                         ("rtcSetSharedGeometryBuffer", None, pointer, ctypes.c_int, number, ctypes.c_int, pointer, size, size, size),
                                         ("rtcSetGeometryTransform", None, pointer, number, ctypes.c_int, pointer)):
            self.call(name, result, *arguments)

    def call(self, name, result, *arguments):
        function = getattr(self.library, name)
        function.restype, function.argtypes = result, arguments

    def mesh(self, scene, corners, triples):
        library = self.library
        geometry = library.rtcNewGeometry(self.device, 0)
        library.rtcSetSharedGeometryBuffer(geometry, 1, 0, 0x9003, corners.ctypes.data, 0, 12, len(corners) - 1)
        library.rtcSetSharedGeometryBuffer(geometry, 0, 0, 0x5003, triples.ctypes.data, 0, 12, len(triples))
        library.rtcCommitGeometry(geometry)
        library.rtcAttachGeometry(scene, geometry)

    def build(self, case, triangles):
        library, scene = self.library, self.library.rtcNewScene(self.device)
        if case == "triangles":
            meshes = [grid(triangles / 4, k) for k in range(4)]
            begin = time.process_time()
            for corners, triples in meshes:
                self.mesh(scene, corners, triples)
        else:
            corners, triples = grid(5000)
            inner = library.rtcNewScene(self.device)
            begin = time.process_time()
            self.mesh(inner, corners, triples)
            library.rtcCommitScene(inner)
            for i in range(100000):
                matrix = (ctypes.c_float * 12)(.003, 0, 0, 0, .003, 0, 0, 0, .003, (i % 316) / 158 - 1, (i // 316) / 158 - 1, 0)
                geometry = library.rtcNewGeometry(self.device, 121)
                library.rtcSetGeometryInstancedScene(geometry, inner)
                library.rtcSetGeometryTransform(geometry, 0, 0x9234, matrix)
                library.rtcCommitGeometry(geometry)
                library.rtcAttachGeometry(scene, geometry)
        library.rtcCommitScene(scene)
        return time.process_time() - begin


def run(command, limit):
    """CPU seconds and MB of a process; None where it fails or needs more than `limit` CPU seconds."""
    code = (f"import resource, subprocess, sys\nresource.setrlimit(resource.RLIMIT_CPU, ({limit}, {limit}))\nstatus = subprocess.call(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)\n"
            "used = resource.getrusage(resource.RUSAGE_CHILDREN)\nprint(status, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)")
    status, seconds, peak = subprocess.check_output([sys.executable, "-c", code, *command], text=True).split()
    return (float(seconds), float(peak)) if status == "0" else None


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("cases", nargs="*", metavar="CASE")
    options.add_argument("--triangles", type=float, default=30e6)
    options.add_argument("--folder", default=None)
    options.add_argument("--variants", default="llvm_ad_rgb,scalar_rgb")
    options.add_argument("--limit", type=int, default=600, help="CPU seconds of a process")
    options.add_argument("--embree", help=argparse.SUPPRESS)
    given = options.parse_args()
    if given.embree:
        print(Embree().build(given.embree, given.triangles), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
        return
    program, script = os.path.abspath(given.program), os.path.abspath(__file__)
    folder = given.folder or tempfile.mkdtemp(prefix="aureole-large-")
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    print(f"{'case':10} {'program':24} {'CPU s':>8} {'MB':>8}")
    for case in given.cases or CASES:
        scene = f"{case}.xml"
        if not os.path.exists(scene):
            body = CASES[case](given)
            with open(scene, "w", encoding="utf-8") as out:
                out.write(body + "</scene>\n")
        ours = [program, "render", scene, "-q", "--no-cache", "-t", "1", "--spp", "1", "-o", "ours.exr"]
        rows = [("aureole", ours)]
        if case == "textures":
            rows.append(("aureole, 64 MB of texels", [*ours, "--texture-memory", "64M"]))
        rows += [(variant, [sys.executable, "-c", MITSUBA, variant, scene, "theirs.exr"]) for variant in given.variants.split(",") if variant]
        for name, command in rows:
            used = run(command, given.limit)
            print(f"{case:10} {name:24} " + (f"{used[0]:8.1f} {used[1]:8.0f}" if used else "    fails"), flush=True)
        if case in ("triangles", "instances"):
            line = subprocess.check_output([sys.executable, script, program, "--embree", case, "--triangles", str(given.triangles)], text=True)
            print(f"{case:10} {'embree alone':24} {float(line.split()[0]):8.1f} {float(line.split()[1]):8.0f}", flush=True)


if __name__ == "__main__":
    main()

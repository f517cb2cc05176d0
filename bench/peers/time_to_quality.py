#!/usr/bin/env python3
"""CPU seconds that Mitsuba 3, Blender's Cycles and Aureole's path tracer take to a relative RMSE on the same scenes.

    python3.11 -m venv /tmp/peers && /tmp/peers/bin/pip install 'mitsuba==3.*' numpy bpy==4.2.0
    /tmp/peers/bin/python bench/peers/time_to_quality.py build/release/aureole [--threads N] [--only TEXT] [--equal-samples]

The glossy box and the room use meshes that scripts/scenes.sh generates. llvm_ad_rgb requires LLVM 19 (Debian's libllvm19,
DRJIT_LIBLLVM_PATH=.../libLLVM.so.19.1): 14 is rejected, and 15 and 16 stop at "Cannot select: fminimum".

Renderers that are not installed are skipped with a message. All of them are unbiased, so the RMSE of an image is measured from two
images with different seeds: the root of half their mean squared difference, relative to the mean. It is measured at two numbers
of samples per pixel and extrapolated with a power law for the error and a line for the time. The time is user + system seconds of all
threads in the render call: imports, loading and the first compilation of kernels (llvm_ad_rgb) are excluded, which
favors the other renderers; Aureole's time includes the whole process. Cycles gets the scene's triangles, normals and texture from Mitsuba and
its Principled BSDF for rough plastic (with the same base color, index and roughness), so its image is similar,
not identical.

--equal-samples compares `path` with Mitsuba's at equal samples instead, on more scenes, in alternating pairs: the render call
(except for the first, which compiles) over Aureole's rendering (the whole process minus one with a single sample, rescaled), and a new
process of Mitsuba without cached kernels, which loads, compiles and renders, over Aureole's whole process.
"""
import argparse
import json
import math
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile

import interior
from mitsuba_scene import change, cpu_seconds, read

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PUBLIC = os.path.join(ROOT, "..", "shared", "scenes", "cornell-box", "scene.xml")
SCENES = {
    "cornell-box": (PUBLIC if os.path.exists(PUBLIC) else os.path.join(ROOT, "scenes/cornell-box/cornell-box.xml"), 256, 256, {}),
    "glossy-box": (os.path.join(ROOT, "scenes/cornell-box/figure.xml"), 256, 256, {"materials": "rough"}),
    "room": (os.path.join(ROOT, "scenes/room/room.xml"), 240, 160, {"materials": "rough"}),
}
BUNDLED = {name: (os.path.join(ROOT, "scenes", name, name + ".xml"), 240, 160, {"materials": "rough"})
           for name in ("plates", "sphere", "statue", "parade", "occlusion")}
ERRORS = (0.02, 0.005)
# Samples per pixel at which error and time are measured: squares for multi-jittered samples and powers of 2 for Sobol'.
SAMPLES = {"cornell-box": (16, 64), "glossy-box": (64, 256), "room": (64, 256)} | {name: (16, 64) for name in BUNDLED}


def name_of(path):
    """The name of the scene from the path of its copy."""
    return os.path.splitext(os.path.basename(path))[0]


# --- renderers: each returns a function (samples, seed) -> (image, CPU seconds)


def mitsuba(variant, sampler, path, threads):
    import mitsuba as mi
    import numpy as np
    mi.set_variant(variant)
    with open(path, encoding="utf-8") as file:
        scene = mi.load_string(change(file.read(), sampler=sampler))
    if variant.startswith("llvm"):
        import drjit as dr  # after loading: its threads read textures, and a single one would deadlock
        dr.set_thread_count(threads)
    else:
        mi.Thread.set_thread_count(threads) if hasattr(mi.Thread, "set_thread_count") else None
    # each number of samples compiles a kernel
    for samples in SAMPLES.get(name_of(path), ()) if variant.startswith("llvm") else (1,):
        np.array(mi.render(scene, spp=samples, seed=999))

    def render(samples, seed):
        start = cpu_seconds()
        image = np.array(mi.render(scene, spp=samples, seed=seed), dtype=np.float64)[:, :, :3]
        return image, cpu_seconds() - start
    return render


def triangles(mi, shape):
    """Vertices and faces of a Mitsuba shape, or None."""
    import numpy as np
    parameters = mi.traverse(shape)
    if "vertex_positions" in parameters:
        return (np.array(parameters["vertex_positions"]).reshape(-1, 3), np.array(parameters["faces"]).reshape(-1, 3))
    if "to_world" not in parameters:
        return None
    matrix = np.array(parameters["to_world"].matrix, dtype=np.float64).reshape(4, 4)
    corners = np.array([[-1, -1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]], dtype=np.float64)
    return (corners @ matrix.T)[:, :3], np.array([[0, 1, 2], [0, 2, 3]])


def normals(mi, shape):
    """Normals of the vertices, or None."""
    import numpy as np
    parameters = mi.traverse(shape)
    found = np.array(parameters["vertex_normals"]).reshape(-1, 3) if "vertex_normals" in parameters else ()
    return found if len(found) > 0 else None


def bsdf_values(text, name):
    """Parameters of a BSDF for Cycles from its XML: base color, roughness of a plastic or None, file of a texture or None."""
    found = re.search(rf'<bsdf type="[^"]*" id="{re.escape(name)}">(.*?)</bsdf>\s*</bsdf>', text, re.S)
    inner = found[1] if found else ""
    base = re.search(r'name="(?:diffuse_)?reflectance" value="([^"]*)"', inner)
    values = [float(v) for v in base[1].split(",")] if base else [0.5]
    alpha = re.search(r'name="alpha" value="([^"]*)"', inner)
    image = re.search(r'name="filename" value="([^"]*)"', inner)
    return (values * 3)[:3], float(alpha[1]) if alpha and "roughplastic" in inner else None, image[1] if image else None


def add_texture(bpy, mesh, nodes, links, image, color):
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = bpy.data.images.load(image)
    texture.image.colorspace_settings.name = "Non-Color"
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    layer = mesh.uv_layers.new()
    for loop, place in zip(mesh.loops, layer.data):
        place.uv = corners[loop.vertex_index]
    links.new(texture.outputs["Color"], color)


def cycles(path, threads):
    import bpy
    import mitsuba as mi
    import numpy as np
    mi.set_variant("scalar_rgb")
    source = mi.load_file(path)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    for shape in source.shapes():
        geometry = triangles(mi, shape)
        if geometry is None:
            raise RuntimeError("a shape that is no mesh")
        mesh = bpy.data.meshes.new("mesh")
        mesh.from_pydata(geometry[0].tolist(), [], geometry[1].tolist())
        smooth = normals(mi, shape)
        if smooth is not None:
            mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
            mesh.normals_split_custom_set_from_vertices(smooth.tolist())
        material = bpy.data.materials.new("material")
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        nodes.clear()
        out = nodes.new("ShaderNodeOutputMaterial")
        if shape.is_emitter():
            shader = nodes.new("ShaderNodeEmission")
            radiance = np.array(mi.traverse(shape.emitter())["radiance.value"]).ravel()
            shader.inputs["Color"].default_value = (*[float(v) for v in radiance[:3]], 1)
            facing = nodes.new("ShaderNodeNewGeometry")  # mesh lights emit on both sides by default
            front = nodes.new("ShaderNodeMath")
            front.operation = "SUBTRACT"
            front.inputs[0].default_value = 1
            links.new(facing.outputs["Backfacing"], front.inputs[1])
            links.new(front.outputs[0], shader.inputs["Strength"])
        else:
            base, alpha, image = bsdf_values(text, shape.bsdf().id())
            if alpha is None:
                shader = nodes.new("ShaderNodeBsdfDiffuse")
                shader.inputs["Color"].default_value = (*base, 1)
                if image is not None:  # rectangles only
                    add_texture(bpy, mesh, nodes, links, image, shader.inputs["Color"])
            else:
                shader = nodes.new("ShaderNodeBsdfPrincipled")
                shader.inputs["Base Color"].default_value = (*base, 1)
                shader.inputs["Roughness"].default_value = math.sqrt(alpha)
                shader.inputs["IOR"].default_value = 1.49
        links.new(shader.outputs[0], out.inputs["Surface"])
        mesh.materials.append(material)
        scene.collection.objects.link(bpy.data.objects.new("object", mesh))
    sensor = source.sensors()[0]
    camera = bpy.data.cameras.new("camera")
    thing = bpy.data.objects.new("camera", camera)
    scene.collection.objects.link(thing)
    scene.camera = thing
    parameters = mi.traverse(sensor)
    matrix = np.array(parameters["to_world"].matrix, dtype=np.float64).reshape(4, 4)
    # Mitsuba looks along +z with x to the left, Blender along -z with x to the right.
    import mathutils
    thing.matrix_world = mathutils.Matrix((matrix @ np.diag([-1.0, 1.0, -1.0, 1.0])).tolist())
    width, height = sensor.film().size()
    camera.sensor_fit = "HORIZONTAL"
    camera.angle = math.radians(float(np.array(parameters["x_fov"]).ravel()[0]))
    camera.clip_end = 1e6
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = int(width), int(height), 100
    render.threads_mode, render.threads = "FIXED", threads
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.view_settings.view_transform = "Raw"
    options = scene.cycles
    options.device, options.use_adaptive_sampling, options.use_denoising = "CPU", False, False
    options.sample_clamp_direct = options.sample_clamp_indirect = options.light_sampling_threshold = 0.0
    options.max_bounces = options.diffuse_bounces = options.glossy_bounces = 64
    options.pixel_filter_type, options.filter_width = "BOX", 1.0
    folder = tempfile.mkdtemp()

    def shoot(samples, seed):
        options.samples, options.seed = samples, seed
        render.filepath = os.path.join(folder, "out.exr")
        start = cpu_seconds()
        bpy.ops.render.render(write_still=True)
        seconds = cpu_seconds() - start
        bitmap = mi.Bitmap(render.filepath).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32)
        return np.array(bitmap, dtype=np.float64), seconds
    shoot(1, 999)
    return shoot


def ours(aureole, integrator, path, threads):
    import numpy as np
    out = os.path.join(os.path.dirname(path), "ours.pfm")

    def render(samples, seed):
        start = cpu_seconds(resource.RUSAGE_CHILDREN)
        subprocess.run([aureole, "render", path, "-q", "--sampler", "sobol", "--integrator", integrator, "--spp", str(samples), "--seed",
                        str(seed), "-t", str(threads), "-o", out], check=True)
        seconds = cpu_seconds(resource.RUSAGE_CHILDREN) - start
        with open(out, "rb") as file:  # Mitsuba reads images with its threads, and a single one would deadlock
            file.readline()
            width, height = (int(word) for word in file.readline().split())
            order = "<f4" if float(file.readline()) < 0 else ">f4"
            return np.frombuffer(file.read(), order).reshape(height, width, 3)[::-1].astype(np.float64), seconds
    return render


# --- measuring


def pair(render, samples):
    (a, first), (b, second) = render(samples, 1), render(samples, 2)
    mean = (a.mean() + b.mean()) / 2
    return math.sqrt(((a - b) ** 2).mean() / 2) / mean, (first + second) / 2, mean


KINDS = {
    "ours, path": lambda aureole, *rest: ours(aureole, "path", *rest),
    "ours, path:interleaved=true,rr_depth=4": lambda aureole, *rest: ours(aureole, "path:interleaved=true,rr_depth=4", *rest),
    "Mitsuba scalar_rgb, independent": lambda _, *rest: mitsuba("scalar_rgb", "independent", *rest),
    "Mitsuba scalar_rgb, multijitter": lambda _, *rest: mitsuba("scalar_rgb", "multijitter", *rest),
    "Mitsuba llvm_ad_rgb, independent": lambda _, *rest: mitsuba("llvm_ad_rgb", "independent", *rest),
    "Mitsuba llvm_ad_rgb, multijitter": lambda _, *rest: mitsuba("llvm_ad_rgb", "multijitter", *rest),
    "Cycles": lambda _, *rest: cycles(*rest),
}


def child(kind, aureole, path, threads, target_errors):
    """Extrapolates from two numbers of samples."""
    render = KINDS[kind](aureole, path, threads)
    (few, error, seconds, _), (many, less, more_seconds, mean) = found = [(n, *pair(render, n)) for n in SAMPLES[name_of(path)]]
    slope = math.log(less / error) / math.log(many / few)
    each = (more_seconds - seconds) / (many - few)
    counts = [many * (target / less) ** (1 / slope) for target in target_errors]
    times = [max(each, more_seconds + each * (count - many)) for count in counts]
    print(json.dumps({"times": times, "mean": mean, "samples": [round(count) for count in counts],
                      "errors": [row[1] for row in found], "slope": slope, "many": many}))


# --- equal samples


def equal_samples_child(given, path):
    """CPU seconds of pairs: Mitsuba's call, Aureole's process, and its process for one sample; and the means of both images."""
    theirs = mitsuba("llvm_ad_rgb", "independent", path, given.threads)
    own = ours(given.aureole, given.integrator, path, given.threads)
    theirs(given.samples, 999)
    rows = []
    for seed in range(1, given.pairs + 1):
        (a, call), (b, process), (_, least) = theirs(given.samples, seed), own(given.samples, seed), own(1, seed)
        rows.append((call, process, least, float(a.mean()), float(b.mean())))
    print(json.dumps(rows))


def compiling_child(given, path):
    """CPU seconds from loading to the first image."""
    import mitsuba as mi
    import numpy as np
    mi.set_variant("llvm_ad_rgb")
    start = cpu_seconds()
    scene = mi.load_file(path)
    import drjit as dr
    dr.set_thread_count(given.threads)
    np.array(mi.render(scene, spp=given.samples, seed=1))
    print(json.dumps(cpu_seconds() - start))


def run_child(arguments, **options):
    """Its last line of output, or None and the error."""
    done = subprocess.run([sys.executable, os.path.abspath(__file__), *arguments], capture_output=True, text=True, check=False, **options)
    lines = [line for line in done.stdout.splitlines() if line[:1] in "{[0123456789"]
    if done.returncode != 0 or not lines:
        return None, (done.stderr.strip().splitlines() or ["no output"])[-1]
    return json.loads(lines[-1]), ""


def spread(values):
    quarters = statistics.quantiles(values, n=4) if len(values) > 1 else 3 * values
    return f"{statistics.median(values):.2f} [{quarters[0]:.2f}, {quarters[2]:.2f}]"


def compare_equal_samples(given, folder):
    print(f"{given.integrator}, {given.samples} samples per pixel, {given.pairs} pairs, {given.threads} thread(s), CPU seconds; "
          "ratios above 1: ours is faster\n")
    print("| scene | llvm_ad_rgb | ours, rendering | llvm_ad_rgb / ours | it loads, compiles, renders | ours, all | ratio | means differ |")
    print("|---|---|---|---|---|---|---|---|")
    scenes = {name: (path, 240, 160, definitions) for name, (path, _, _, definitions) in SCENES.items()} | BUNDLED
    scenes["interior"] = (interior.write(folder)[0], 240, 160, {})
    for name, (path, width, height, definitions) in scenes.items():
        if given.only not in name:
            continue
        copy = os.path.join(folder, "equal-" + name + ".xml")
        with open(copy, "w", encoding="utf-8") as file:
            file.write(change(read(path, definitions), rfilter="box", width=width, height=height))
        arguments = [os.path.abspath(given.aureole), "--threads", str(given.threads), "--pairs", str(given.pairs), "--samples",
                     str(given.samples), "--integrator", given.integrator, "--child"]
        rows, reason = run_child([*arguments, "equal samples", copy])
        if rows is None:
            print(f"| {name} | not measured: {reason} | | | | | | |", flush=True)
            continue
        with tempfile.TemporaryDirectory() as home:  # without cached kernels
            compiling, _ = run_child([*arguments, "compiling", copy], env={**os.environ, "HOME": home})
        calls, processes, least, theirs, own = zip(*rows)
        part = given.samples / (given.samples - 1)
        render = [(a - b) * part for a, b in zip(processes, least)]
        ratios = spread([a / b for a, b in zip(calls, render)])
        call, rendering, process = (statistics.median(values) for values in (calls, render, processes))
        print(f"| {name} | {call:.2f} | {rendering:.2f} | {ratios} | {compiling:.1f} | {process:.2f} | {compiling / process:.2f} | "
              f"{100 * (sum(own) / sum(theirs) - 1):+.1f} % |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("aureole")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--equal-samples", action="store_true")
    parser.add_argument("--errors", type=lambda text: [float(word) for word in text.split(",")], default=list(ERRORS), help="relative ones")
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--samples", type=int, default=16, help="per pixel, where they are equal; more than 1")
    parser.add_argument("--integrator", default="path", help="ours, where samples are equal")
    parser.add_argument("--child", nargs=2, metavar=("RENDERER", "SCENE"))
    given = parser.parse_args()
    if given.child and given.child[0] == "equal samples":
        equal_samples_child(given, given.child[1])
        return
    if given.child and given.child[0] == "compiling":
        compiling_child(given, given.child[1])
        return
    if given.child:
        child(given.child[0], given.aureole, given.child[1], given.threads, given.errors)
        return
    if given.equal_samples:
        with tempfile.TemporaryDirectory() as folder:
            compare_equal_samples(given, folder)
        return
    aureole = os.path.abspath(given.aureole)
    print("| scene | renderer | " + " | ".join(f"CPU s to {100 * e:g} %" for e in given.errors) + f" | samples per pixel | mean | measured | error ~ samples^ |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, (path, width, height, definitions) in SCENES.items():
            copy = os.path.join(folder, name + ".xml")
            with open(copy, "w", encoding="utf-8") as file:
                file.write(change(read(path, definitions), rfilter="box", width=width, height=height))
            for kind in KINDS:
                if given.only not in f"{name} {kind}":
                    continue
                row, reason = run_child([aureole, "--threads", str(given.threads), "--errors", ",".join(map(str, given.errors)), "--child", kind, copy])
                if row is None:
                    print(f"| {name} | {kind} | not measured: {reason} | | | | | |", flush=True)
                    continue
                print(f"| {name} | {kind} | " + " | ".join(f"{t:.3g}" for t in row["times"]) +
                      f" | {', '.join(map(str, row['samples']))} | {row['mean']:.4f} | "
                      f"{100 * row['errors'][1]:.2f} % at {row['many']} | {row['slope']:.2f} |",
                      flush=True)


if __name__ == "__main__":
    main()

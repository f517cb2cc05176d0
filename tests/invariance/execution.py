"""How a command is run: threads, ranks, shards, instruction sets, caches, locales."""

import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import models
from relations import relation
from runs import equal_bytes, same_means

BOX = "scenes/cornell-box/glossy.xml"
SMALL = ("--width", "32", "--height", "24")
GATHER = "finalgather:photons=5000,diffuse_samples=16,glossy_samples=8"


def works(context):
    """Name and a function of the further options of a command that returns its bytes."""
    models.write_xml(models.room(), Path("room.xml"))
    models.write_sensors(models.room(), Path("room.pts"))
    models.write_obj(models.room(), Path("room.obj"))
    scene = context.source / BOX

    def render(*given):
        return lambda *options, **keys: context.image_bytes(scene, *SMALL, *given, *options, **keys)

    def text(*given):
        return lambda *options, **keys: context.run(*given, "-q", *options, **keys)

    return {
        "render, path": render("--spp", "8", "--integrator", "path"),
        "render, finalgather": render("--spp", "4", "--integrator", GATHER),
        "render --error": render("--error", "20%"),
        "render, radiosity": lambda *options, **keys: context.image_bytes(context.source / "scenes/keller/cube.xml", *SMALL, "--spp", "4",
                                                                          "--integrator", "radiosity", *options, **keys),
        "irradiance": text("irradiance", "room.xml", "--sensors", "room.pts", "-n", "512"),
        "irradiance --error": text("irradiance", "room.xml", "--sensors", "room.pts", "--error", "5%"),
        "viewfactors": text("viewfactors", "room.obj", "--rays", "256", "--radiosity", ".5", "--sky", "0", "--emission", "1"),
        "measure": text("measure", "spherical-fibonacci", "-n", "500", "-m", "energy,cap", "--domain", "sphere"),
        "weights": text("weights", "spherical-fibonacci", "-n", "200", "--method", "exact"),
        "voronoi": text("voronoi", "spherical-fibonacci", "-n", "300", "--domain", "sphere"),
    }


for _name in ("render, path", "render, finalgather", "render --error", "render, radiosity", "irradiance", "irradiance --error", "viewfactors", "measure", "weights",
              "voronoi"):
    @relation("execution", _name, "1, 2, 3 and 7 threads", "the same bits")
    def _(context, name=_name):
        work = works(context)[name]
        one = work("-t", "1")
        for threads in (2, 3, 7):
            equal_bytes(one, work("-t", threads))
        return "the same bits"

    @relation("execution", _name, "locale, time zone, folder, a filled heap", "the same bits")
    def _(context, name=_name):
        work = works(context)[name]
        return equal_bytes(work(), work(environment={"LC_ALL": "de_DE.UTF-8", "TZ": "Pacific/Apia", "MALLOC_PERTURB_": "85"}))


@relation("execution", "render, merge", "one render or three shards, in any order", "the same bits")
def _(context):
    scene = context.source / BOX
    whole = context.image_bytes(scene, *SMALL, "--spp", "8", "--integrator", "path")
    for i in (1, 2, 3):
        context.run("render", scene, *SMALL, "--spp", "8", "--integrator", "path", "-q", "--shard", f"{i}/3", "-o", f"{i}.part")
    context.run("merge", "3.part", "1.part", "2.part", "-o", "merged.pfm")
    return equal_bytes(whole, Path("merged.pfm").read_bytes())


@relation("execution", "render --checkpoint", "one render, or killed and resumed", "the same bits")
def _(context):
    scene, options = context.source / BOX, (*SMALL, "--spp", "256", "--integrator", "path", "-t", "1")
    whole = context.image_bytes(scene, *options)
    Path("kept").unlink(missing_ok=True)
    command = [context.program, "render", str(scene), *options, "-q", "-o", "bytes.pfm", "--checkpoint", "kept", "--checkpoint-every", ".02s", "--resume"]
    for _ in range(3):
        before = os.stat("kept").st_mtime_ns if os.path.exists("kept") else None
        process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
        for _ in range(500):
            if process.poll() is not None or (os.path.exists("kept") and os.stat("kept").st_mtime_ns != before):
                break
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
    subprocess.run(command, check=True)
    return equal_bytes(whole, Path("bytes.pfm").read_bytes())


@relation("execution", "render, weights, measure", "1, 2 and 3 ranks", "the same bits")
def _(context):
    module = Path(context.program).parent / "aureole-mpi.so"
    if not module.exists() or not shutil.which("mpirun"):
        return "not run: built without MPI"
    environment = {**os.environ, "AUREOLE_CACHE": "", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_rmaps_base_oversubscribe": "1", "ASAN_OPTIONS": "detect_leaks=0"}
    for work in (["render", str(context.source / BOX), *SMALL, "--spp", "4", "--integrator", "path", "-o", "ranks.pfm"],
                 ["weights", "spherical-fibonacci", "-n", "100", "--method", "exact"],
                 ["measure", "sobol", "-n", "256", "-m", "all", "--domain", "sphere"]):
        found = []
        for ranks in (1, 2, 3):
            done = subprocess.run(["mpirun", "-n", str(ranks), context.program, *work, "-q", "-t", "1"], env=environment, capture_output=True, timeout=300)
            assert done.returncode == 0, f"{ranks} ranks: {work}: {done.stderr.decode()[:300]}"
            found.append(Path(work[-1]).read_bytes() if "-o" in work else done.stdout)
        assert found[0] == found[1] == found[2], f"{work[0]}: other bits"
    return "the same bits"


ISAS = ("portable", "avx2", "avx512")


@relation("execution", "points, measure, weights, voronoi", "instruction sets", "the same bits")
def _(context):
    for name in ("measure", "weights", "voronoi"):
        work = works(context)[name]
        answers = {work(environment={"AUREOLE_ISA": isa}) for isa in ISAS}
        assert len(answers) == 1, f"{name}: other bits"
    for options in (("sobol", "-n", "256", "--scramble", "owen"), ("halton", "-n", "100", "--dim", "5"), ("spherical-fibonacci", "-n", "99"),
                    ("faure", "-n", "100", "--domain", "rotations")):
        assert len({context.run("points", *options, environment={"AUREOLE_ISA": isa}) for isa in ISAS}) == 1, f"{options}: other bits"
    return "the same bits"


@relation("execution", "render, irradiance", "instruction sets of rays", "intervals")
def _(context):
    models.write_xml(models.room(), Path("room.xml"))
    sensors = models.write_sensors(models.room(), Path("room.pts"))

    def answers(isa, seeds):
        os.environ["AUREOLE_ISA"] = isa
        try:
            return [context.irradiance("room.xml", sensors, seed) + context.image("room.xml", seed, 32) for seed in seeds]
        finally:
            del os.environ["AUREOLE_ISA"]

    return same_means(answers("portable", range(context.seeds)), answers("avx2", range(100, 100 + context.seeds)))


@relation("execution", "render", "an empty cache or a filled one", "the same bits")
def _(context):
    cache = {"AUREOLE_CACHE": str(Path("cache").absolute())}
    options = (context.source / BOX, *SMALL, "--spp", "1", "--integrator", "finalgather:photons=50000")
    first = context.image_bytes(*options, environment=cache)
    assert any(p.is_file() for p in Path("cache").rglob("*")), "nothing was left in the cache"
    return equal_bytes(first, context.image_bytes(*options, environment=cache))


@relation("execution", "render --crop", "a crop or the whole image", "the same pixels")
def _(context):
    scene, options = context.source / BOX, (*SMALL, "--spp", "4", "--integrator", "path", "--filter", "box")
    context.image_bytes(scene, *options)
    from runs import read_pfm
    width, height, whole = read_pfm(Path("bytes.pfm"))
    context.image_bytes(scene, *options, "--crop", "5,21,3,19")
    w, h, part = read_pfm(Path("bytes.pfm"))
    if (w, h) == (width, height):
        left, bottom = 0, 0
    else:
        left, bottom = 5, height - 19
    for y in range(h):
        for x in range(w):
            at = (x + left, y + bottom)
            if 5 <= at[0] < 21 and height - 19 <= at[1] < height - 3:
                i, j = 3 * (y * w + x), 3 * (at[1] * width + at[0])
                assert part[i:i + 3] == whole[j:j + 3], f"pixel {at}"
    return "the same bits"

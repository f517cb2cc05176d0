"""The points that sets.py and fields.py compare: from Aureole and from other packages.

MAKERS has a row per set: its domain, the package (a module to import, a program to find, or None for Aureole), a name, a
function of the number of points and the seed that returns an array with a row per point (a fourth column of directions is the
weight), whether the seed changes it, and for Aureole the arguments of `aureole points` and the available sizes, if limited.
Other sets generate the nearest available size.
"""
import collections
import importlib
import importlib.metadata
import importlib.util
import io
import os
import shutil
import subprocess
import tempfile

import numpy as np

Maker = collections.namedtuple("Maker", "domain package name make random arguments sizes")
MAKERS = []
program = "build/release/aureole"  # the scripts' --program


def read_csv(*command):
    text = subprocess.run([program, *command], capture_output=True, text=True, check=True).stdout
    return np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1, ndmin=2)


def nearest_size(sizes, n):
    return n if sizes is None else min(sizes, key=lambda size: abs(size - n))


def ours(domain, name, arguments, random=False, sizes=None):
    def make(n, seed):
        n = nearest_size(sizes, n)
        return read_csv("points", *arguments, "-n", str(n), "--domain", domain, "--seed", str(seed), "-q")
    MAKERS.append(Maker(domain, None, name, make, random, arguments, sizes))


def peer(domain, package, name, random=False):
    def keep(function):
        MAKERS.append(Maker(domain, package, name, function, random, None, None))
        return function
    return keep


def is_installed(maker):
    return (maker.package is None or importlib.util.find_spec(maker.package) is not None
            or shutil.which(maker.package) is not None)


def version(package):
    """The version of a module's distribution, or the one that a program prints."""
    for distribution in importlib.metadata.packages_distributions().get(package, []):
        return f"{distribution} {importlib.metadata.version(distribution)}"
    return subprocess.run([package, "-version"], capture_output=True, text=True).stdout.splitlines()[0].strip("= ")


def to_sphere(u):
    """Lambert's map, which preserves areas."""
    z = 1 - 2 * u[:, 0]
    radius, phi = np.sqrt(np.maximum(0, 1 - z * z)), 2 * np.pi * u[:, 1]
    return np.column_stack([radius * np.cos(phi), radius * np.sin(phi), z])


def qmc():
    return importlib.import_module("scipy.stats").qmc


for _set in "sobol larcher-pillichshammer hammersley halton fibonacci-lattice r2 golden-set".split():
    ours("square", _set, [_set])
ours("square", "sobol, Owen", ["sobol", "--scramble", "owen"], True)
for _set in "jittered random blue-noise bnot".split():
    ours("square", _set, [_set], True)


@peer("square", "scipy", "Sobol")
def _(n, seed):
    return qmc().Sobol(2, scramble=False).random(n)


@peer("square", "scipy", "Sobol, scrambled", True)
def _(n, seed):
    return qmc().Sobol(2, rng=seed).random(n)


@peer("square", "scipy", "Halton, scrambled", True)
def _(n, seed):
    return qmc().Halton(2, rng=seed).random(n)


@peer("square", "scipy", "LatinHypercube", True)
def _(n, seed):
    return qmc().LatinHypercube(2, rng=seed).random(n)


@peer("square", "scipy", "LatinHypercube, random-cd", True)
def _(n, seed):
    return qmc().LatinHypercube(2, rng=seed, optimization="random-cd").random(n)


@peer("square", "scipy", "PoissonDisk", True)
def _(n, seed):
    return qmc().PoissonDisk(2, radius=0.78 / np.sqrt(n), rng=seed).fill_space()


@peer("square", "numpy", "random", True)
def _(n, seed):
    return np.random.default_rng(seed).random((n, 2))


@peer("square", "qmcpy", "DigitalNetB2, LMS and digital shift", True)
def _(n, seed):
    return importlib.import_module("qmcpy").DigitalNetB2(2, randomize="LMS_DS", seed=seed)(n)


@peer("square", "qmcpy", "Lattice, shifted", True)
def _(n, seed):
    return importlib.import_module("qmcpy").Lattice(2, randomize="SHIFT", seed=seed)(n)


@peer("square", "qmcpy", "Halton", True)
def _(n, seed):
    return importlib.import_module("qmcpy").Halton(2, seed=seed)(n)


def lebedev_sizes():
    """The degree and the number of points of each of the 32 rules."""
    degrees = list(range(3, 32, 2)) + list(range(35, 132, 6))
    sizes = [6, 14, 26, 38, 50, 74, 86, 110, 146, 170, 194, 230, 266, 302, 350, 434, 590, 770, 974, 1202, 1454, 1730,
             2030, 2354, 2702, 3074, 3470, 3890, 4334, 4802, 5294, 5810]
    return list(zip(degrees, sizes))


for _set in "spherical-fibonacci esfg:base=147 electrostatic r2".split():
    ours("sphere", _set, [_set])
ours("sphere", "sobol, Owen", ["sobol", "--scramble", "owen"], True)
ours("sphere", "random", ["random"], True)
ours("sphere", "healpix", ["healpix"], sizes=[12 * k * k for k in range(1, 300)])
ours("sphere", "lebedev", ["lebedev"], sizes=[n for _, n in lebedev_sizes()])
ours("sphere", "t-design", ["t-design"],
     sizes=[4, 8, 18, 32, 48, 70, 94, 122, 156, 192, 234, 278, 328, 384, 442, 504, 570,
            636, 712, 786, 870, 956, 1046, 1134, 1238, 1338])


@peer("sphere", "healpy", "pixel centres, in rings")
def _(n, seed):
    side = max(1, round(np.sqrt(n / 12)))
    return np.array(importlib.import_module("healpy").pix2vec(side, np.arange(12 * side * side))).T


def lebedev_degree(n):
    return min(lebedev_sizes(), key=lambda row: abs(row[1] - n))[0]


@peer("sphere", "scipy", "lebedev_rule")
def _(n, seed):
    x, weights = importlib.import_module("scipy.integrate").lebedev_rule(lebedev_degree(n))
    return np.column_stack([x.T, weights / weights.sum()])


@peer("sphere", "pylebedev", "PyLebedev")
def _(n, seed):
    rule = importlib.import_module("pylebedev").PyLebedev()
    x, weights = rule.get_points_and_weights(lebedev_degree(n))
    return np.column_stack([x, weights / np.sum(weights)])


@peer("sphere", "grid", "AngularGrid, spherical t-design")
def _(n, seed):
    return importlib.import_module("grid").AngularGrid(size=n, method="spherical").points


@peer("sphere", "spaudiopy", "load_t_design")
def _(n, seed):
    degree = min(21, max(1, round(np.sqrt(2 * n) - 1)))
    return importlib.import_module("spaudiopy").grids.load_t_design(degree)


@peer("sphere", "scipy", "Sobol, scrambled, by Lambert's map", True)
def _(n, seed):
    return to_sphere(qmc().Sobol(2, rng=seed).random(n))


@peer("sphere", "orix", "sample_S2, icosahedral")
def _(n, seed):
    sample = importlib.import_module("orix.sampling").sample_S2
    return np.unique(sample(63.4 / np.sqrt((n - 2) / 10), method="icosahedral").data.reshape(-1, 3).round(12), axis=0)


@peer("sphere", "orix", "sample_S2, spherified cube")
def _(n, seed):
    sample = importlib.import_module("orix.sampling").sample_S2
    return sample(90 / np.sqrt(n / 6), method="spherified_cube_edge").data.reshape(-1, 3)


@peer("sphere", "dipy", "get_sphere, repulsion724")
def _(n, seed):
    return importlib.import_module("dipy.data").get_sphere(name="repulsion724").vertices


@peer("sphere", "dirgen", "dirgen -unipolar -restarts 1", True)
def _(n, seed):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "directions.txt")
        subprocess.run(["dirgen", str(n), path, "-unipolar", "-restarts", "1", "-cartesian", "-quiet", "-nthreads", "0"],
                       check=True, env={**os.environ, "MRTRIX_RNG_SEED": str(seed)})
        return np.loadtxt(path)


for _set in "super-fibonacci super-fibonacci-grid:base=125 esfg-rotations r2 halton".split():
    ours("rotations", _set, [_set])
ours("rotations", "sobol, Owen", ["sobol", "--scramble", "owen"], True)
ours("rotations", "random", ["random"], True)


@peer("rotations", "scipy", "Rotation.random", True)
def _(n, seed):
    rotation = importlib.import_module("scipy.spatial.transform").Rotation
    return np.roll(rotation.random(n, rng=seed).as_quat(), 1, axis=1)


def orix(method, degrees):
    """degrees: the resolution that gives about a thousand rotations."""
    @peer("rotations", "orix", f"get_sample_fundamental, {method}")
    def _(n, seed):
        sample = importlib.import_module("orix.sampling").get_sample_fundamental
        group = importlib.import_module("orix.quaternion.symmetry").C1
        return sample(degrees * (n / 1000) ** (-1 / 3), point_group=group, method=method).data


orix("cubochoric", 27)
orix("haar_euler", 26)
orix("quaternion", 26)


@peer("rotations", "quaternionic", "array.random", True)
def _(n, seed):
    np.random.seed(seed)
    array = importlib.import_module("quaternionic").array
    return array.random((n,), normalize=True).ndarray

"""core.py PROGRAM: the core of the Python package."""

import copy
import gc
import inspect
import os
import pickle
import re
import subprocess
import sys
import threading
import time
import unittest
import unittest.mock
import warnings

import numpy as np

import aureole

PROGRAM = sys.argv[1]


def program(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


def written(name, *arguments):
    program("points", name, "-q", *arguments, "-o", "points.npy")
    return np.load("points.npy")


class Points(unittest.TestCase):
    def test_same_bits_as_the_program(self):
        for name, n, arguments, options in [
            ("sobol", 128, "--dim 5 --scramble owen --seed 3", dict(dimension=5, scramble="owen", seed=3, domain="cube")),
            ("halton", 64, "--domain disk --map concentric", dict(domain="disk", map="concentric")),
            ("spherical-fibonacci", 99, "--domain hemisphere --lobe ggx:0.3:40", dict(domain="hemisphere", lobe="ggx:0.3:40")),
            ("larcher-pillichshammer", 64, "--domain sphere --scramble rotate3d", dict(domain="sphere", scramble="rotate3d")),
            ("esfg", 80, "--domain sphere --cap 20 --first 7 --count 30", dict(domain="sphere", cap=20, first=7, count=30)),
            ("super-fibonacci", 50, "--domain rotations", dict(domain="rotations")),
            ("electrostatic", 20, "--domain axes", dict(domain="axes")),
        ]:  # fmt: skip
            expected = written(name, "-n", str(n), *arguments.split())
            with warnings.catch_warnings():
                warnings.filterwarnings("ignore", message=".*below the horizon")
                found = aureole.points(name, n, **options)
            self.assertTrue((found == expected[:, : found.shape[1]]).all())  # and weights after them

    def test_weights_of_the_optimal_density(self):
        xyz, weights = aureole.points(
            "sobol", 64, domain="hemisphere", lobe="phong:20", density="optimal", smoothness=1.4, weights=True
        )
        expected = written("sobol", *"-n 64 --domain hemisphere --lobe phong:20 --density optimal --smoothness 1.4".split())
        self.assertTrue((np.column_stack([xyz, weights]) == expected).all())
        _, equal = aureole.points("sobol", 64, weights=True)
        self.assertTrue((equal == 1 / 64).all())

    def test_every_set_of_the_table(self):
        for name, row in aureole.sets().items():
            if name in ("file", "matrices"):  # they are read from files
                continue
            size = int((re.match(r"([0-9]+),", row.sizes) or [0, 16])[1])  # "4, 8, 18, .. 328" or any
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", aureole.AureoleWarning)
                dimension = min(2, row.dimensions[1]) if "cube" in row.domains else 0
                found = aureole.points(name, size, dimension=dimension)
            self.assertEqual(len(found), size, name)
            self.assertTrue(np.isfinite(found).all(), name)

    def test_any_part_into_any_array(self):
        made = aureole.PointSet("sobol", 1024, dimension=3, scramble="owen", seed=1)
        whole = made.points()
        self.assertTrue((made.points(10, 20) == whole[10:30]).all())
        self.assertTrue((made.points(10, 20, dimensions=slice(1, 3)) == whole[10:30, 1:]).all())
        columns = np.empty((20, 3), order="F")
        self.assertIs(made.points(10, 20, out=columns), columns)
        self.assertTrue((columns == whole[10:30]).all())
        single = made.points(10, 20, dtype=np.float32)
        self.assertEqual(single.dtype, np.float32)
        self.assertTrue((np.floor(whole[10:30] * 2**24) / 2**24 == single).all())
        part = np.zeros((30, 3))
        made.points(0, 10, out=part[20:])
        self.assertTrue((part[20:] == whole[:10]).all() and not part[:20].any())
        other = aureole.PointSet("sobol", 1024, dimension=3, scramble="owen", seed=2)
        self.assertTrue((made.points(seed=2) == other.points()).all())
        self.assertEqual(made.coordinate(7, 2), whole[7, 2])
        self.assertTrue(np.isnan(made.coordinate(1024, 0)))
        locked = np.empty((20, 3))
        locked.flags.writeable = False
        for wrong in (np.empty((20, 2)), np.empty((20, 3), dtype=int), locked, [[0.0] * 3] * 20):
            with self.assertRaises(aureole.ArgumentError):
                made.points(0, 20, out=wrong)
        for kind in (np.float64, np.float32):  # any strides
            wide = np.full((60, 9), -1.0, dtype=kind)
            for out in (wide[::3, ::3], wide[39:19:-1, 6:3:-1], wide[20:40, 1:4]):
                wide[...] = -1
                self.assertIs(made.points(10, 20, out=out), out)
                self.assertTrue((out == made.points(10, 20, dtype=kind)).all())
                self.assertEqual(int((wide == -1).sum()), wide.size - out.size)
        directions = aureole.Directions("sobol", 64, domain="hemisphere", lobe="phong:20", density="optimal")
        xyz, weights = aureole.points("sobol", 64, domain="hemisphere", lobe="phong:20", density="optimal", weights=True)
        found = directions.rule(8, 16)
        self.assertTrue((found[0] == xyz[8:24]).all() and (found[1] == weights[8:24]).all())

    def test_points_into_arrays(self):
        for domain, shape in (("square", (64, 2)), ("sphere", (64, 3)), ("rotations", (64, 4))):
            name = "super-fibonacci" if domain == "rotations" else "sobol"
            plain = aureole.points(name, 64, domain=domain)
            single = aureole.points(name, 64, domain=domain, dtype=np.float32)
            expected = np.floor(plain * 2**24) / 2**24 if domain == "square" else plain.astype(np.float32)
            self.assertTrue(single.dtype == np.float32 and (single == expected).all())
            out = np.zeros((shape[0], 2 * shape[1]))[:, ::2]
            self.assertIs(aureole.points(name, 64, domain=domain, out=out), out)
            self.assertTrue((out == plain).all())
        with self.assertRaisesRegex(aureole.ArgumentError, r"the shape \(64, 2\)"):
            aureole.points("sobol", 64, out=np.empty((64, 3)))

    def test_sets_are_sequences(self):
        sobol = aureole.PointSet("sobol", 4096, dimension=5, scramble="owen", seed=3)
        xyz = aureole.Directions("spherical-fibonacci", 300)
        random = np.random.default_rng(1)
        turns = aureole.Rotations("super-fibonacci", 256, scramble="rotate3d", seed=4)
        self.assertTrue((turns.points() == written("super-fibonacci", "-n", "256", "--scramble", "rotate3d", "--seed", "4")).all())
        for made in (sobol, xyz, turns):
            whole = made.points()
            self.assertTrue((np.asarray(made) == whole).all() and (np.array(list(made)) == whole).all())
            picks = random.integers(-len(made), len(made), 200)
            for key in (
                0, -1, np.int32(7), slice(3, 9), slice(None, None, -70), slice(250, 5, -3), slice(9, 3), [5, 5, -2], picks, [],
                (slice(2, 8), 1), (4, slice(1, 3)), (7, 2), (-1,),
            ):  # fmt: skip
                found = made[key]
                self.assertTrue(found.shape == whole[key].shape and (found == whole[key]).all(), key)
            for wrong in (len(made), -len(made) - 1, [0, len(made)]):
                with self.assertRaises(IndexError):
                    made[wrong]
            for wrong in (1.5, "0", [[0, 1]]):
                with self.assertRaises((TypeError, IndexError)):
                    made[wrong]
        large = aureole.PointSet("sobol", 2**53)
        self.assertTrue((large[2**52 : 2**53 : 2**50] == [large.points(i, 1)[0] for i in range(2**52, 2**53, 2**50)]).all())

    def test_copies_and_texts(self):
        xyz = aureole.points("spherical-fibonacci", 100, domain="sphere")
        generator = np.random.default_rng(5)
        for made, look in (
            (aureole.PointSet("halton:permute=random", 50, dimension=3, scramble="shift", seed=generator), lambda x: x.points()),
            (aureole.Directions("sobol", 64, domain="hemisphere", lobe="phong:20", scramble="owen", seed=4), lambda x: x.points()),
            (aureole.Rotations("sobol", 64, scramble="owen", seed=2**80), lambda x: x.points(dtype=np.float32)),
            (aureole.Nearest(xyz), lambda x: np.array(x.find(xyz[:9] + 0.01, 3))),
            (aureole.Potential("phong:3", smoothness=1.6), lambda x: x.evaluate(xyz)),
        ):  # fmt: skip
            for other in (pickle.loads(pickle.dumps(made)), copy.deepcopy(made), copy.copy(made)):
                self.assertTrue((look(other) == look(made)).all())
        text = repr(aureole.PointSet("sobol", 64, dimension=3, scramble="owen", seed=2**70))
        self.assertRegex(text, r"^PointSet\('sobol', 64, dimension=3, scramble='owen', seed=[0-9]+\)$")
        self.assertTrue((eval("aureole." + text).points() == aureole.PointSet("sobol", 64, dimension=3, scramble="owen",
                                                                              seed=2**70).points()).all())  # fmt: skip

    def test_seeds(self):
        def draw(seed):
            return aureole.points("random", 8, seed=seed)

        self.assertTrue((draw(7) == draw(np.uint8(7))).all())
        self.assertTrue((draw(2**128 + 1) == draw(2**128 + 1)).all() and (draw(2**128 + 1) != draw(2**128)).all())
        for make in (np.random.default_rng, np.random.RandomState, np.random.SeedSequence, np.random.PCG64):
            self.assertTrue((draw(make(3)) == draw(make(3))).all() and (draw(make(3)) != draw(make(4))).all())
        generator = np.random.default_rng(3)
        self.assertTrue((draw(generator) != draw(generator)).all() and (draw(None) != draw(None)).all())
        self.assertTrue((aureole.rotate([[1, 0, 0.0]], generator) != aureole.rotate([[1, 0, 0.0]], generator)).any())
        for wrong in ("7", b"7", 1.5, [1], object()):
            with self.assertRaisesRegex(TypeError, "seed must be an integer, None or one of NumPy's random generators, not "):
                draw(wrong)
        with self.assertRaisesRegex(aureole.ArgumentError, "seed must be at least 0, not -1"):
            draw(-1)

    def test_arrays_of_other_libraries(self):
        """What offers DLPack alone is read and written in its place, and what we return offers it."""

        class Tensor:
            def __init__(self, array, device=(1, 0)):
                self.array, self.device = array, device

            def __dlpack__(self, **options):
                if self.device != (1, 0):
                    raise BufferError("it is on a device")
                return self.array.__dlpack__(**options)

            def __dlpack_device__(self):
                return self.device

        xyz = aureole.points("spherical-fibonacci", 50, domain="sphere")
        self.assertEqual(aureole.measure(Tensor(xyz), "energy"), aureole.measure(xyz, "energy"))
        self.assertTrue((aureole.weights(Tensor(xyz), "voronoi") == aureole.weights(xyz, "voronoi")).all())
        self.assertTrue(np.shares_memory(np.from_dlpack(xyz), xyz))
        with self.assertRaises((aureole.ArgumentError, RuntimeError)):
            aureole.measure(Tensor(xyz, (2, 0)), "energy")
        out = np.zeros((50, 3))
        if np.from_dlpack(out).flags.writeable:  # NumPy 2.1 and later
            aureole.points("spherical-fibonacci", 50, domain="sphere", out=Tensor(out))
            self.assertTrue((out == xyz).all())

    def test_arrays_are_not_copied(self):
        found = aureole.points("sobol", 1024)
        self.assertFalse(found.flags.owndata)
        before = found.copy()
        part = found[1::2]
        del found
        gc.collect()
        self.assertTrue((part == before[1::2]).all())
        # Rows that lie apart evenly are looked at in their place.
        wide = np.zeros((1024, 7))
        wide[:, 2:5] = aureole.points("spherical-fibonacci", 1024, domain="sphere")
        view = aureole._points.View(wide[:, 2:5])
        self.assertTrue(np.shares_memory(view.array, wide))
        self.assertEqual(aureole.measure(wide[:, 2:5], "energy"), aureole.measure(wide[:, 2:5].copy(), "energy"))

    def test_files(self):
        xyz = aureole.points("spherical-fibonacci", 10, domain="sphere")
        for name in ("points.csv", "points.npy"):
            aureole.write(name, xyz, np.arange(10.0) / 45)
            found, weights, domain = aureole.read(name)
            if name.endswith("npy"):  # four columns are rotations, or directions with weights
                found, weights, domain = aureole.read(name, "sphere")
            self.assertEqual(domain, "sphere")
            self.assertTrue((found == xyz).all() and (weights == np.arange(10.0) / 45).all())


class Domains(unittest.TestCase):
    """Arrays of the library's know their domain; of others what could be another one is said."""

    def test_arrays_know_their_domain(self):
        axes = aureole.points("electrostatic", 60, domain="axes")
        both = np.concatenate([axes, -axes])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            weights, report = aureole.weights_exact(axes)
            self.assertEqual(aureole.measure(axes, "energy"), aureole.measure(np.array(axes), "energy", domain="axes"))
            self.assertEqual(aureole.measure(axes[:30], "energy"), aureole.measure(np.array(axes[:30]), "energy", domain="axes"))
            aureole.write("axes.npy", axes)
            aureole.write("axes.csv", axes, weights)
            ends, of_ends = aureole.weights_exact(both)
            for file in ("axes.npy", "axes.csv"):
                self.assertEqual(aureole.read(file)[2], "axes")
                self.assertEqual(aureole.weights_exact(aureole.read(file)[0])[1], report)
        self.assertEqual(report.degree, of_ends.degree)
        np.testing.assert_allclose(weights, ends[:60] + ends[60:], rtol=1e-12)
        for k in range(2, report.degree + 1, 2):  # the mean of z^k over all directions
            self.assertAlmostEqual(float(weights @ axes[:, 2] ** k), 1 / (k + 1), delta=1e-14)
        cells = aureole.weights_voronoi(axes)
        np.testing.assert_allclose(cells, aureole.measure(axes, "voronoi")["area"] / 60, rtol=1e-12)
        optimal = aureole.weights(axes)
        self.assertAlmostEqual(float(optimal.sum()), 1.0, delta=1e-9)

    def test_what_is_taken_for_a_hemisphere_is_said(self):
        axes = np.array(aureole.points("electrostatic", 60, domain="axes"))
        for call in (
            lambda: aureole.weights_exact(axes), lambda: aureole.weights(axes, "voronoi"), lambda: aureole.weights(axes),
            lambda: aureole.measure(axes, "energy"), lambda: aureole.Nearest(axes), lambda: aureole.write("a.csv", axes),
            lambda: aureole.worst_case_error(axes),
        ):  # fmt: skip
            with self.assertWarnsRegex(aureole.AureoleWarning, "assuming the hemisphere"):
                call()
        np.savetxt("bare.csv", axes, delimiter=",", header="x,y,z", comments="")
        with self.assertWarnsRegex(aureole.AureoleWarning, "bare.csv: .* assuming the hemisphere"):
            aureole.read("bare.csv")
        self.assertEqual(aureole.read("bare.csv", "axes")[2], "axes")

    def test_vectors_off_the_sphere_are_not_of_the_cube(self):
        xyz = np.array(aureole.points("spherical-fibonacci", 50, domain="sphere"))
        xyz[7] *= 1.001
        for call in (lambda: aureole.weights(xyz), lambda: aureole.measure(xyz, "energy")):
            with self.assertRaisesRegex(aureole.ArgumentError, "row 7 has the length 1.001"):
                call()
        # Changed in place an array is no longer what it was.
        cube = aureole.points("sobol", 64, dimension=3)[2:]
        cube -= 0.5
        cube /= np.linalg.norm(cube, axis=1)[:, np.newaxis]
        self.assertTrue(aureole.measure(cube, "energy") > 0)
        with self.assertWarnsRegex(aureole.AureoleWarning, "assuming the cube"):
            aureole.measure(np.array([[0.6, 0.8, 0.01], [0.01, 0.6, 0.8]]), "centered")

    def test_numbers_out_of_range_are_argument_errors(self):
        sobol = aureole.PointSet("sobol", 64)
        for call in (lambda: sobol.points(-1, 2), lambda: sobol.points(2**64, 2), lambda: sobol.coordinate(-1, 0)):
            with self.assertRaises(aureole.ArgumentError):
                call()
        large = aureole.PointSet("random", 2**63)
        self.assertEqual(large.size, 2**63)
        self.assertEqual(large.points(2**63 - 2).shape, (2, 2))

    def test_functions_may_keep_their_arrays(self):
        kept = []

        def keep(*arrays):
            kept.append([(array, array.copy()) for array in arrays])

        aureole.estimate(lambda u, w: (keep(u, w), float(w @ u[:, 0]))[1], 2, tol=0, evaluations=2**14)
        aureole.integrate(lambda u: (keep(u), u[:, 2] ** 2)[1], 1e-9, resolution=1)
        aureole.integrate(lambda u, t: (keep(u, t), t * u[:, 2] ** 2)[1], 0, absolute=1, axis=(0, 2), first=64)
        aureole.Potential(function=lambda u: (keep(u), max(float(u[2]), 0.0))[1])
        aureole.measure(aureole.points("sobol", 4096, domain="sphere"), "energy", progress=lambda *a: kept.append([]))
        garbage = [np.random.default_rng(0).random(2**k) for k in range(20)]
        self.assertTrue(len(kept) > 20 and garbage)
        for arrays in kept:
            for array, then in arrays:
                self.assertTrue((array == then).all())
                array += 1  # it is the function's own


class Errors(unittest.TestCase):
    def test_numbers_that_are_none(self):
        x = aureole.points("spherical-fibonacci", 20, domain="sphere")
        for bad, word in ((x + 0j, "complex"), (np.ma.masked_array(x, x > 0.9), "masked")):
            with self.assertRaisesRegex(aureole.ArgumentError, word):
                aureole.weights(bad, "exact", domain="sphere")
            with self.assertRaisesRegex(aureole.ArgumentError, word):
                aureole.measure(bad, "energy", domain="sphere")

    def test_they_say_what_the_library_says(self):
        with self.assertRaisesRegex(aureole.UnknownNameError, "did you mean 'sobol'") as caught:
            aureole.points("sobl", 4)
        self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaisesRegex(aureole.UnknownNameError, "lambert"):
            aureole.points("sobol", 4, map="lambart")
        with self.assertRaises(aureole.ArgumentError):
            aureole.points("sobol", -1)
        with self.assertRaises(aureole.ArgumentError):
            aureole.points("sobol", 2**70)
        with self.assertRaises(TypeError):
            aureole.points(3, 4)
        with self.assertRaises(aureole.ArgumentError):
            aureole.points("so\0bol", 4)
        with self.assertRaises(aureole.UnsupportedError):
            aureole.measure(aureole.points("sobol", 64), "energy")
        with open("bad.csv", "w") as file:
            file.write("u,v\n0.5,0.5\n0.5,x\n")
        with self.assertRaisesRegex(aureole.FormatError, "bad.csv:3") as caught:
            aureole.read("bad.csv")
        self.assertEqual((caught.exception.file, caught.exception.line), ("bad.csv", 3))
        with self.assertRaises(OSError):
            aureole.read("none.csv")
        with self.assertRaises(aureole.ArgumentError):
            aureole.weights(np.ones((4, 3)), domain="sphere")
        for wrong in (np.ones(3), np.ones((2, 2)), np.ones((2, 3, 1))):
            with self.assertRaises(aureole.ArgumentError):
                aureole.weights(wrong)

    def test_warnings_are_pythons(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            aureole.points("sobol", 100)
        self.assertEqual([w.category for w in caught], [aureole.AureoleWarning])
        self.assertEqual(caught[0].filename, __file__)

    def test_what_a_callback_raises_comes_out(self):
        class Mine(Exception):
            pass

        def fails(*arguments):
            raise Mine

        with self.assertRaises(Mine):
            aureole.integrate(fails)
        with self.assertRaises(Mine):
            aureole.estimate(fails, 2)
        with self.assertRaises(Mine):
            aureole.Potential(function=fails)
        with self.assertRaises(ValueError):
            aureole.integrate(lambda u: np.zeros(3))
        xyz = aureole.points("random", 3000, domain="sphere")
        with self.assertRaises(Mine):
            aureole.measure(xyz, "energy", progress=fails)
        with self.assertRaises(aureole.CancelledError):
            aureole.measure(xyz, "energy", progress=lambda what, done, total: True)


class Figures(unittest.TestCase):
    def test_measures(self):
        xyz = aureole.points("spherical-fibonacci", 1024, domain="sphere")
        printed = program("measure", "spherical-fibonacci", "-n", "1024", "--metric", "energy,covering", "--format", "csv")
        expected = [float(word) for word in printed.splitlines()[1].split(",")[-2:]]
        found = aureole.measure(xyz, ["energy", "covering"], threads=3)
        for value, wanted in zip(found.values(), expected):
            self.assertAlmostEqual(value, wanted, delta=1e-5 * wanted)
        self.assertEqual(found, aureole.measure(xyz, ["energy", "covering"], threads=1))
        series = next(name for name, row in aureole.measures().items() if row.series and "square" in row.domains)
        table = aureole.measure(aureole.points("sobol", 64), series)
        self.assertEqual(len({len(column) for column in table.values()}), 1)

    def test_weights(self):
        xyz = aureole.points("spherical-fibonacci", 64, domain="hemisphere", lobe="cosine")
        program(*"weights spherical-fibonacci -n 64 --domain hemisphere --lobe cosine -o w.csv".split())
        expected = np.loadtxt("w.csv", delimiter=",", skiprows=1)
        self.assertTrue((aureole.weights(xyz, lobe="cosine") == expected[:, 3]).all())
        found = aureole.rule(n=64, lobe="cosine", optimal=True)
        self.assertTrue((np.column_stack(found) == expected).all())
        potential = aureole.Potential("cosine")
        optimal, reports, condition = aureole.weights_solve(xyz, [potential, aureole.Potential("phong:2")])
        self.assertTrue((optimal[0] == expected[:, 3]).all())
        self.assertLess(reports[0].optimal_error, reports[0].equal_error)
        self.assertGreater(condition, 1)
        error = aureole.worst_case_error(xyz, optimal[0], potential)
        self.assertAlmostEqual(error, reports[0].optimal_error, delta=1e-9)
        # The same density as a function, whose potential is a sum over 4096 nodes with an error of the order 1/4096.
        same = aureole.Potential(function=lambda u: max(0.0, u[2]), exponent=1.0)
        self.assertLess(abs(same.evaluate(xyz) - potential.evaluate(xyz)).max(), 1 / 4096)
        self.assertAlmostEqual(potential.density([[0, 0, 1.0]])[0], 1 / np.pi)

    def test_exact_and_nested_weights(self):
        xyz = aureole.points("esfg", 256, domain="sphere")
        weights, report = aureole.weights_exact(xyz, 8)
        self.assertEqual(report.degree, 8)
        self.assertEqual((report.distinct_points, report.places), (256, 256))
        self.assertAlmostEqual(float(weights @ xyz[:, 2] ** 8), 1 / 9, delta=1e-12)
        levels, reports = aureole.weights_nested(xyz, [64, 256])
        self.assertFalse(levels[0, 64:].any())
        self.assertAlmostEqual(float(levels[0] @ xyz[:, 0] ** 4), 1 / 5, delta=1e-12)
        self.assertGreater(reports[1].degree, reports[0].degree)
        self.assertAlmostEqual(aureole.weights(xyz, "voronoi").sum(), 1, delta=1e-12)
        self.assertTrue((aureole.weights(xyz, "exact", degree=8) == weights).all())

    def test_exact_weights_of_other_domains(self):
        for domain, dimension, mean in (("square", 2, 1 / 15), ("cube", 4, 1 / 15), ("disk", 2, 0)):
            x = aureole.points("sobol", 256, domain=domain, dimension=dimension if domain == "cube" else 0)
            weights, report = aureole.weights_exact(x, 6 if dimension == 2 else 4)
            self.assertAlmostEqual(float(weights @ (x[:, 0] ** 2 * x[:, 1] ** 4 if dimension == 2 else x[:, 0] ** 2 * x[:, 3])),
                                   {"square": mean, "cube": 1 / 6, "disk": 1 / 64}[domain], delta=1e-14)
        turns = aureole.points("super-fibonacci", 240)
        weights = aureole.weights(turns, "exact", degree=3)
        cosines = 2 * (turns[:, 0] ** 2) - 1  # of the angle; the mean of the character of degree 1 is 0
        self.assertAlmostEqual(float(weights @ (1 + 2 * cosines)), 0, delta=1e-14)
        cubic, report = aureole.weights_exact(turns, symmetry="432:222")
        self.assertGreater(report.degree, aureole.weights_exact(turns)[1].degree)
        kept = aureole.points("super-fibonacci", 2400, symmetry="432")
        self.assertEqual(len(kept), len(aureole.symmetry_select(aureole.points("super-fibonacci", 2400), "432")))
        with self.assertRaisesRegex(aureole.ArgumentError, r"must have the shape \(n, 4\)"):
            aureole.weights_exact(turns[:, :3], domain="rotations")

    def test_symmetry_of_points(self):
        xyz, w = aureole.points("lebedev", 110, weights=True, symmetry="Oh")
        self.assertEqual(len(xyz), 6)
        self.assertAlmostEqual(float(w @ (xyz**4).sum(axis=1)), 3 / 5, delta=1e-14)
        xyz = aureole.points("spherical-fibonacci", 960, domain="sphere", symmetry="D2h")
        weights = aureole.weights(xyz, "exact", symmetry="D2h")
        self.assertAlmostEqual(float(weights @ xyz[:, 1] ** 8), 1 / 9, delta=1e-14)
        with self.assertRaisesRegex(aureole.ArgumentError, "not this symmetry"):
            aureole.points("lebedev", 110, domain="sphere", symmetry="D5h")
        with self.assertRaises(aureole.UnsupportedError):
            aureole.points("sobol", 16, symmetry="D2h")
        with self.assertRaisesRegex(aureole.ArgumentError, "none of the 1 points"):
            aureole.points("spherical-fibonacci", 1, domain="sphere", symmetry="Oh")
        for bad in ("432:", "432:7:8", ":", "Oh"):
            with self.assertRaises(aureole.UnknownNameError):
                aureole.weights_exact([[1.0, 0, 0, 0]], domain="rotations", symmetry=bad)
        with self.assertRaises(TypeError):
            aureole.points("lebedev", 110, symmetry=5)

    def test_few_points_and_numbers_out_of_range(self):
        for domain, columns in (("square", 2), ("cube", 3), ("disk", 2), ("rotations", 4), ("sphere", 3), ("axes", 3)):
            x = np.zeros((2, columns))
            x[:, 0 if domain == "rotations" else columns - 1] = 1.0
            with self.assertRaisesRegex(aureole.ArgumentError, "at least one point"):
                aureole.weights_exact(x[:0], domain=domain)
            for n in (1, 2):  # doubled points share
                np.testing.assert_allclose(aureole.weights_exact(x[:n], domain=domain)[0], 1 / n)
            x[1, 0] = np.nan
            with self.assertRaisesRegex(aureole.ArgumentError, "2"):
                aureole.weights_exact(x, domain=domain)
        square = np.array(aureole.points("sobol", 8))[:5]
        for degree in (-1, 2**63, 9):
            with self.assertRaises(aureole.ArgumentError):
                aureole.weights_exact(square, degree)
        for counts in ([0, 5], [3, 2], [-1], [2**64], [6]):
            with self.assertRaises(aureole.ArgumentError):
                aureole.weights_nested(square, counts)
        for near in ([1, 2], [-1] * 5, [0] * 5, [np.nan] * 5):
            with self.assertRaises(aureole.ArgumentError):
                aureole.weights_exact(square, near=near)
        for set, n in (("max-determinant", 5), ("max-determinant", 1), ("pmj02", 2**17), ("sliced", 2**63), ("cascaded", 2**63)):
            with self.assertRaises(aureole.ArgumentError):
                aureole.points(set, n)

    def test_points_below_the_horizon_are_counted(self):
        with self.assertWarnsRegex(aureole.AureoleWarning, "7 of 64 points lie below the horizon"):
            visible = aureole.points("sobol", 64, lobe="visible:0.4:30", domain="hemisphere")
        with self.assertWarns(aureole.AureoleWarning):
            ggx = aureole.points("sobol", 64, lobe="ggx:0.4:30", domain="hemisphere")
        np.testing.assert_array_equal(visible, ggx)
        with self.assertRaisesRegex(aureole.UnsupportedError, "not for visible normals"):
            aureole.weights(visible, lobe="visible:0.4:30", domain="hemisphere")

    def test_integrate(self):
        with_axis = aureole.integrate(lambda u, r: r**2 * u[:, 2] ** 2, 1e-3, axis=(0, 2))
        self.assertLess(abs(with_axis.value - 32 * np.pi / 9), 3 * with_axis.error)
        half = aureole.integrate(lambda u: np.exp(u[:, 2]), 1e-4, domain="hemisphere", exponent=1)
        self.assertLess(abs(half.value - 2 * np.pi), 3 * half.error)
        with self.assertWarnsRegex(aureole.IntegrationWarning, "the target was not reached") as caught:
            found = aureole.integrate(lambda u: abs(u[:, 0]), 1e-12, max_points=2048)
        self.assertEqual(os.path.basename(caught.filename), "core.py")
        self.assertEqual((found.converged, found.reason), (False, "evaluations"))
        with self.assertWarns(aureole.AureoleWarning):
            self.assertEqual(found, aureole.integrate(lambda u: abs(u[:, 0]), 1e-12, evaluations=2048))

    def test_integrals_that_were_not_seen(self):
        """A sun of .27 degrees: a flat sky is suspicious, and a peak finds it over any sky."""
        sine, sun = np.sin(np.deg2rad(0.2666)), np.array([0.6, 0, 0.8])
        truth = 1000 * np.pi + 2e7 * np.pi * sine**2 * 0.8

        def sky(u):
            return 1000 + 2e7 * (u @ sun > np.cos(np.deg2rad(0.2666)))

        with self.assertWarnsRegex(aureole.IntegrationWarning, "all values of the function are equal"):
            found = aureole.integrate(sky, domain="hemisphere", exponent=1, resolution=1)
        self.assertEqual((found.reason, found.doubts, found.error), ("constant", ("all equal",), np.inf))
        found = aureole.integrate(sky, domain="hemisphere", exponent=1, peaks=[(sun, 0.3)])
        self.assertTrue(found.converged)
        self.assertLess(abs(found.value / truth - 1), 0.01)
        with self.assertWarnsRegex(aureole.IntegrationWarning, "the target was not reached"):
            found = aureole.integrate(lambda u: sky(u) + u[:, 2], domain="hemisphere", max_points=2**19, seed=2)
        self.assertGreater(found.evaluations, 3e5)
        self.assertAlmostEqual(np.cos(np.deg2rad(found.resolution_degrees)), 1 - found.resolution)
        with self.assertWarnsRegex(aureole.IntegrationWarning, r"a cap with a radius of 1.1 degrees\) .* allow 524288 evaluations"):
            found = aureole.integrate(lambda u: u[:, 2] ** 2, domain="hemisphere", max_points=20000)
        self.assertEqual((found.converged, found.doubts), (False, ("unresolved",)))
        found = aureole.integrate(lambda x: x[:, 0] ** -0.9, 1e-6, domain="cube", dimension=1, peaks=[(0, 0, 0.9)])
        self.assertAlmostEqual(found.value, 10)

    def test_integral_of_zero(self):
        """A relative tolerance cannot be reached, and the warning names the absolute one."""
        with self.assertWarnsRegex(aureole.IntegrationWarning, "the integral may be 0: set an absolute tolerance"):
            aureole.integrate(lambda u: u[:, 2], max_points=2**14, resolution=1)
        with self.assertWarnsRegex(aureole.IntegrationWarning, "after 8192 evaluations$"):
            aureole.integrate(lambda u: u[:, 2] > 0, 1e-9, max_points=2**13, resolution=1)

    def test_slow_function_of_integrals(self):
        """A function that makes the default resolution take minutes gets one warning, where the caller wrote the call."""

        calls = []

        def slow(u):
            calls.append(len(u))
            time.sleep(0.02 if len(calls) < 8 else 0)
            return u[:, 2] ** 2

        with unittest.mock.patch("aureole._integrate._PATIENCE", 0.05):
            with self.assertWarnsRegex(aureole.AureoleWarning, "524288 evaluations, .* pass resolution=1") as caught:
                found = aureole.integrate(slow)
            self.assertEqual((caught.filename, found.converged, len(caught.warnings)), (__file__, True, 1))
            for quiet in ({"resolution": 1}, {"first": 256}, {"peaks": [((0, 0, 1), 5)]}):  # warnings are errors here
                calls.clear()
                aureole.integrate(slow, **quiet)

    def test_integrals_of_several_values(self):
        calls = []

        def waves(u):
            calls.append(len(u))
            return np.exp(1j * u[:, :, np.newaxis] * [1, 2])

        found = aureole.integrate(waves, 1e-6, mean=True)
        self.assertEqual((found.value.shape, found.value.dtype, found.interval.shape), ((3, 2), complex, (3, 2)))
        self.assertLess(abs(found.value - np.sin([1, 2]) / [1, 2]).max(), 1e-6)
        self.assertEqual(sum(calls), found.evaluations)  # none to find out the shape
        one = aureole.integrate(lambda u: np.exp(1j * u[:, 0]), 1e-6, mean=True)
        self.assertIsInstance(one.value, complex)
        self.assertEqual(aureole.integrate(lambda u: u[:, 2], 0, absolute=1e-3).value.__class__, float)
        batch = aureole.integrate(lambda x: x[:, :1] ** np.arange(1, 201), domain="square", separate=True, resolution=1)
        self.assertLess((abs(batch.value * np.arange(2, 202) - 1)).max(), 0.03)
        with self.assertWarnsRegex(aureole.IntegrationWarning, "sampled: set `resolution`"):  # their memory is the limit
            aureole.integrate(lambda x: x[:, :1] ** np.arange(1, 201), domain="square")

    def test_integrals_over_every_domain(self):
        truth = {"sphere": 4 * np.pi / 3, "hemisphere": 2 * np.pi / 3, "axes": 2 * np.pi / 3, "rotations": 1 / 4, "square": 1 / 3,
                 "disk": np.pi / 4, "ball": 4 * np.pi / 15, "triangle": 1 / 12, "tetrahedron": 1 / 60}  # fmt: skip
        for domain, value in truth.items():
            found = aureole.integrate(lambda x: x[:, -1] ** 2, 1e-3, domain=domain)
            self.assertLess(abs(found.value / value - 1), 3e-3, domain)
            mean = aureole.average(lambda x: x[:, -1] ** 2, 200, domain)
            measure = aureole.integrate(lambda x: 1 + 1e-9 * x[:, 0], 1e-3, domain=domain).value
            self.assertLess(abs(mean.value * measure / value - 1), 0.03, domain)
            self.assertTrue(0 < mean.error < 0.02)
        smooth = aureole.average(lambda u: np.exp(4 * u[:, 0]), 500)  # exact weights, and an error that knows it
        self.assertLess(abs(smooth.value - np.sinh(4) / 4), 3 * smooth.error)
        self.assertLess(smooth.error, 1e-9)
        found = aureole.average(lambda x: x.sum(axis=1), 256, "cube", dimension=64)
        self.assertLess(abs(found.value - 32), 5 * found.error)

    def test_symmetric_integrands(self):
        """The form factor of a prism of 60 x 250 x 500 at q = 0.1, whose mean over the sphere needs 900 values."""
        def prism(u):
            return (np.sinc(0.05 * u * [60, 250, 500] / np.pi) ** 2).prod(axis=1)

        xyz, w = aureole.symmetric_rule(40000, "D2h")
        exact = w @ prism(xyz)
        xyz, w = aureole.symmetric_rule(900, "D2h")
        self.assertLessEqual(len(xyz), 900)
        self.assertLess(abs(w @ prism(xyz) / exact - 1), 1e-13)
        found = aureole.average(prism, 900, symmetry="D2h")
        self.assertLess(abs(found.value - exact), found.error)
        self.assertLess(found.error, 0.01 * exact)
        whole = aureole.integrate(prism, 1e-10, symmetry="D2h")
        self.assertTrue(whole.converged)
        self.assertLess(abs(whole.value / (4 * np.pi * exact) - 1), 1e-13)
        both = aureole.integrate(lambda u: u**2, 1e-9, symmetry="Ci", mean=True)
        self.assertLess(abs(both.value - 1 / 3).max(), 1e-14)
        with self.assertWarnsRegex(aureole.IntegrationWarning, "all values of the function are equal"):
            self.assertEqual(aureole.integrate(lambda u: u[:, 0] > 2, symmetry="Oh").error, np.inf)
        matrices = aureole.point_group("D5d")
        self.assertLess(abs(matrices @ matrices.transpose(0, 2, 1) - np.eye(3)).max(), 1e-14)
        with self.assertRaisesRegex(aureole.UnknownNameError, "unknown point group"):
            aureole.symmetric_rule(100, "D99h")
        with self.assertRaisesRegex(aureole.ArgumentError, "the smallest rule"):
            aureole.symmetric_rule(1, "C5v")
        with self.assertRaises(aureole.UnsupportedError):
            aureole.average(prism, 900, "hemisphere", symmetry="D2h")
        with self.assertRaises(aureole.UnsupportedError):
            aureole.integrate(prism, domain="rotations", symmetry="432")
        for bad, error in ((lambda u: 1 / 0, ZeroDivisionError), (lambda u: np.ones(3), aureole.ArgumentError),
                           (lambda u: u[:, 0] * np.nan, aureole.ArgumentError), (lambda u: "x", TypeError)):
            with self.assertRaises(error):
                aureole.integrate(bad, symmetry="Oh")

    def test_bad_integrands(self):
        masked = np.ma.masked_array(np.ones(1024), np.arange(1024) == 3)
        for bad in (lambda u: u[:3, 0], lambda u: "x", lambda u: u[:, 2] / 0, lambda u: {}, lambda u: None,
                    lambda u: np.ones((len(u), 0)), lambda u: masked[: len(u)], lambda u: ["1"] * len(u),
                    lambda u: np.full(len(u), np.datetime64("2020")), lambda u: np.zeros(len(u), [("a", float)])):  # fmt: skip
            with self.assertRaises((ValueError, TypeError)), np.errstate(all="ignore"):
                aureole.integrate(bad)
            with self.assertRaises((ValueError, TypeError)), np.errstate(all="ignore"):
                aureole.average(bad, 100, symmetry="D2h")
        for options in ({"tol": 0}, {"peaks": [1]}, {"peaks": [((0, 0, 1),)]}, {"domain": "ball", "dimension": 2}, {"resolution": 1.5}):
            with self.assertRaises(aureole.ArgumentError):
                aureole.integrate(lambda u: u[:, 2], **options)
        for bad in (lambda u, w: "1", lambda u, w: 1j):
            with self.assertRaisesRegex(TypeError, "must return real numbers"):
                aureole.estimate(bad, 2)
        for axis in ((0,), 5, (0, 1, 2)):
            with self.assertRaisesRegex(aureole.ArgumentError, "an axis is"):
                aureole.integrate(lambda u, r: r, axis=axis)
        self.assertEqual(aureole.average(lambda u: u[:, 2], np.int8(10)).evaluations, 160)
        with self.assertRaisesRegex(aureole.ArgumentError, "n // 4 = 0 points"):
            aureole.average(lambda u: u[:, 2], 3, symmetry="D2h")
        constant = aureole.average(lambda u: 2.0, 100, symmetry="Oh")
        self.assertEqual((round(constant.value, 14), constant.error), (2.0, np.inf))
        changing = iter(range(1, 10**6))
        with self.assertRaisesRegex(aureole.ArgumentError, "changed their shape"):
            aureole.integrate(lambda u: np.ones((len(u), next(changing))))
        for count in (0, -1, 2**63):
            with self.assertRaises(aureole.ArgumentError):
                aureole.average(lambda u: u[:, 2], count)
        for count in (1, 2):
            self.assertGreater(aureole.average(lambda u: u[:, 2] ** 2, count).error, 0)
        with self.assertRaises(TypeError):
            aureole.integrate(lambda u: u[:, 2], seed="7")
        self.assertTrue(aureole.integrate(lambda u: u[:, 2] ** 2, seed=2**63, max_points=2**63).converged)
        held = aureole.integrate(lambda u: u[:, 2], 0, absolute=1e-6)  # a view of the argument
        self.assertEqual(held.value, aureole.integrate(lambda u: u[:, 2] + 0, 0, absolute=1e-6).value)

    def test_estimate(self):
        found = aureole.estimate(lambda u, w: [w @ u.prod(axis=1), w.sum()], 3, 2, tol=1e-3)
        self.assertLess(abs(found.value[0] - 1 / 8), 3 * found.half_width[0])
        self.assertAlmostEqual(found.value[1], 1)
        with self.assertWarnsRegex(aureole.IntegrationWarning, "one value for all 16 randomisations"):
            found = aureole.estimate(lambda u, w: w @ (u[:, 0] < 1e-7), 1)
        self.assertEqual((found.converged, found.half_width[0]), (False, np.inf))

    def test_nearest(self):
        xyz = aureole.points("spherical-fibonacci", 500, domain="sphere")
        queries = aureole.points("random", 50, domain="sphere", seed=1)
        indices, angles = aureole.Nearest(xyz).find(queries, 3)
        cosines = queries @ xyz.T
        self.assertTrue((indices == np.argsort(-cosines, axis=1)[:, :3]).all())
        self.assertLess(abs(np.cos(angles) - np.take_along_axis(cosines, indices.astype(int), 1)).max(), 1e-12)
        self.assertTrue((aureole.fibonacci_nearest(queries, 500) == indices[:, 0]).all())

    def test_maps(self):
        square = aureole.points("sobol", 256, scramble="shift")
        for name in aureole.names("map"):
            back = aureole.map_from_disk(aureole.map_to_disk(square, name), name)
            self.assertLess(abs(back - square).max(), 1e-12)
            for domain in ("hemisphere", "sphere"):
                xyz = aureole.map_to_directions(square, name, domain=domain)
                self.assertTrue((xyz == aureole.points("sobol", 256, scramble="shift", map=name, domain=domain)).all())
                self.assertLess(abs(aureole.map_from_directions(xyz, name, domain=domain) - square).max(), 1e-7)
        xyz = aureole.points("sobol", 256, domain="hemisphere")
        lobe = aureole.lobe_warp(xyz, "phong:9")
        self.assertTrue((lobe == aureole.points("sobol", 256, domain="hemisphere", lobe="phong:9")).all())
        self.assertLess(abs(aureole.lobe_unwarp(lobe, "phong:9") - xyz).max(), 1e-9)
        wxyz = aureole.points("super-fibonacci", 30)
        matrices = aureole.rotation_matrices(wxyz)
        self.assertLess(abs(matrices @ matrices.transpose(0, 2, 1) - np.eye(3)).max(), 1e-14)
        self.assertLess(abs(abs((aureole.rotation_quaternions(matrices) * wxyz).sum(axis=1)) - 1).max(), 1e-14)
        zone = aureole.symmetry_select(aureole.points("super-fibonacci", 2400), "432")
        self.assertLess(abs(len(zone) - 100), 10)
        self.assertTrue((aureole.symmetry_reduce(zone, "432") == zone).all())

    def test_threads_of_python(self):
        xyz = aureole.points("spherical-fibonacci", 2000, domain="sphere")
        found = [None] * 4
        def work(k):
            found[k] = aureole.measure(xyz, "energy", threads=1), aureole.integrate(lambda u: u[:, 2] ** 2).value
        threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(set(found)), 1)

    def test_signatures_are_typed(self):
        for name in aureole.__all__:
            thing = getattr(aureole, name)
            if inspect.isfunction(thing):
                signature = inspect.signature(thing)
                self.assertIsNot(signature.return_annotation, signature.empty, name)
                for parameter in signature.parameters.values():
                    self.assertIsNot(parameter.annotation, parameter.empty, f"{name}({parameter.name})")


unittest.main(argv=sys.argv[:1])

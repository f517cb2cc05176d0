"""render.py PROGRAM SOURCE_TREE: what needs libaureole-render and libaureole-lighting."""

import copy
import pathlib
import pickle
import subprocess
import sys
import unittest
import warnings

import numpy as np

import aureole

PROGRAM, TREE = sys.argv[1:3]
SCENE = f"{TREE}/scenes/cornell-box/cornell-box.xml"


def program(*arguments):
    subprocess.run([PROGRAM, *arguments, "-q"], check=True, capture_output=True, text=True)


class Render(unittest.TestCase):
    def test_pictures(self):
        program("render", SCENE, "--width", "24", "--spp", "4", "--seed", "3", "-o", "program.exr")
        scene = aureole.Scene(SCENE)
        picture = aureole.render(scene, width=24, spp=4, seed=3, threads=1)
        self.assertEqual((picture.shape, picture.dtype), ((24, 24, 3), np.float32))
        expected, names = aureole.read_image("program.exr")
        self.assertEqual(names[:3], ["R", "G", "B"])
        self.assertTrue((picture == expected[:, :, :3]).all())
        self.assertTrue((picture == aureole.render(SCENE, width=24, spp=4, seed=3, threads=3)).all())
        for other in (pickle.loads(pickle.dumps(scene)), copy.deepcopy(scene)):
            self.assertTrue((picture == aureole.render(other, width=24, spp=4, seed=3)).all())
        self.assertEqual(repr(scene), f"Scene({SCENE!r})")
        corner = aureole.render(scene, width=24, spp=4, seed=3, crop=(16, 24, 16, 24))
        self.assertEqual(corner.shape[2], 3)
        self.assertEqual(scene.describe().width, 512)

        aureole.write_image("python.exr", picture)
        self.assertEqual(aureole.compare("python.exr", picture), 0.0)
        with self.assertWarnsRegex(DeprecationWarning, "compare: picture= is image= now"):
            self.assertEqual(aureole.compare("python.exr", picture=picture), 0.0)
        with self.assertWarns(DeprecationWarning):
            aureole.write_image("renamed.exr", picture=picture)
        self.assertEqual(aureole.compare("renamed.exr", image=picture), 0.0)
        other = aureole.render(scene, width=24, spp=4, seed=4)
        rmse = float(np.sqrt(np.mean((picture.astype(float) - other) ** 2)))
        self.assertAlmostEqual(aureole.compare(picture, other), rmse, delta=1e-12)
        self.assertAlmostEqual(aureole.compare(picture, other, "flip"), aureole.flip(picture, other).mean(), delta=1e-6)
        clamped = aureole.render(
            scene, width=24, spp=4, seed=3, integrator="path", clamp=0.05, channels=["G", "clamped.G"]
        )
        self.assertLess(clamped[:, :, 0].mean(), aureole.render(scene, width=24, spp=4, seed=3, integrator="path")[:, :, 1].mean())
        self.assertGreater(clamped[:, :, 1].mean(), 0)
        asked = aureole.render(scene, width=16, error=0.5)
        self.assertGreater(asked.mean(), 0)
        shown = aureole.render(scene, width=16, error=0.1, error_measure="display")
        self.assertFalse(np.array_equal(asked, shown))
        with self.assertRaises(Exception):
            aureole.render(scene, width=16, error=0.1, error_measure="pixel")

        with self.assertRaisesRegex(aureole.UnknownNameError, "did you mean 'path'"):
            aureole.render(scene, integrator="pth")
        with self.assertRaisesRegex(aureole.ArgumentError, "there are R, G, B"):
            aureole.render(scene, width=4, spp=1, channels=["depth"])
        with self.assertRaises(aureole.ArgumentError):
            aureole.compare(picture, picture[:3])
        with self.assertRaises(aureole.OpenError):
            aureole.Scene("none.xml")
        with self.assertRaises(aureole.CancelledError):
            aureole.render(scene, width=64, spp=64, progress=lambda what, done, total: True)
        with self.assertRaises(ZeroDivisionError):
            aureole.render(scene, width=64, spp=64, progress=lambda what, done, total: 1 / 0)
        text = pathlib.Path(SCENE).read_text().replace("<scene", "<sceen", 1)
        with self.assertRaises(aureole.FormatError) as caught:
            aureole.Scene("mine.xml", text=text)
        self.assertEqual(caught.exception.file, "mine.xml")

    def test_previews(self):
        """A progress callback renders, in the callback of a render, at counts of samples that ask whether to stop."""
        small = {"width": 16, "spp": 256, "threads": 1, "integrator": "path"}
        alone = aureole.render(SCENE, **small)
        previews = []

        def inner(what, done, total):
            if len(previews) < 2:
                previews.append(aureole.render(SCENE, **small))

        def outer(what, done, total):
            if len(previews) < 2:
                previews.append(aureole.render(SCENE, progress=inner, **small))

        picture = aureole.render(SCENE, progress=outer, **small)
        self.assertEqual(len(previews), 3)
        for made in [picture, *previews]:
            self.assertTrue((made == alone).all())

    def test_irradiance(self):
        position, normal = [[278, 10, 280], [100, 10, 100]], [[0, 1, 0]] * 2
        with open("sensors.pts", "w") as file:
            for row in np.hstack([position, normal]):
                print(*row, file=file)
        program("irradiance", SCENE, "--sensors", "sensors.pts", "-n", "64", "-o", "light.npy")
        expected = np.load("light.npy")
        found = aureole.irradiance(SCENE, position, normal, directions=64)
        self.assertTrue((found.total[:, :3] == expected[:, 3:6]).all())
        self.assertTrue((found.error["total"][:, :3] == expected[:, 6:9]).all())
        self.assertTrue((found.directions == 64).all() and not found.on_surface.any())
        self.assertLess(abs(found.direct + found.sky + found.reflected + found.sun - found.total).max(), 1e-12)
        with self.assertRaises(aureole.ArgumentError):
            aureole.irradiance(SCENE, position, normal[:1])
        with self.assertRaises(aureole.ArgumentError):
            aureole.irradiance(SCENE, position, np.zeros((2, 3)))

    def test_daylight(self):
        with open("room.mat", "w") as file:
            file.write("void plastic grey 0 0 5 .5 .5 .5 0 0\n")
        with open("room.rad", "w") as file:
            file.write("grey polygon wall 0 0 12 -3 2 0 3 2 0 3 2 3 -3 2 3\n")
        with open("year.epw", "w") as file:
            subprocess.run(["bash", f"{TREE}/scripts/weather.sh"], stdout=file, check=True)
        positions, normals = [[0, 0, 0.5], [1, 1, 1]], [[0, 0, 1], [0, 1, 0]]
        np.save("sensors.npy", np.hstack([positions, normals]))
        scene = aureole.Scene("room.mat", further=["room.rad"])
        night = np.array([float(hour % 24 >= 20 or hour % 24 < 6) for hour in range(8760)])
        for schedule in [(20, 6), night]:
            program("irradiance", "room.mat", "room.rad", "--sensors", "sensors.npy", "--weather", "year.epw", "-n", "64",
                    "--schedule", "20-6", "--threshold", "50", "--series", "series.npy", "-o", "year.npy")  # fmt: skip
            found = aureole.daylight(scene, positions, normals, "year.epw", directions=64, threshold=50, schedule=schedule)
            self.assertTrue((np.stack([found.hours, found.hours_error], 1) == np.load("series.npy")).all())
            names = list(found._fields[:8])
            columns = [column for name in names for column in (getattr(found, name), found.error[name])]
            self.assertTrue((np.stack(columns, 1) == np.load("year.npy")[:, 3:]).all())
        diffuse = np.genfromtxt("year.epw", delimiter=",", skip_header=8, usecols=15)
        lightest = np.zeros(8760)
        lightest[np.argsort(-diffuse, kind="stable")[:4380]] = 1
        by_name, by_hour = (aureole.daylight(scene, positions, normals, "year.epw", directions=64, schedule=schedule) for schedule in ("daylight", lightest))  # fmt: skip
        self.assertTrue((by_name.autonomy == by_hour.autonomy).all() and (by_name.useful == by_hour.useful).all())
        with self.assertRaises(aureole.ArgumentError):
            aureole.daylight(scene, positions, normals, "year.epw", schedule="nights")
        watts = aureole.daylight(scene, positions, normals, "year.epw", directions=64, efficacy="none")
        self.assertLess(watts.annual[0] * 90, found.annual[0])
        with self.assertRaises(aureole.ArgumentError):
            aureole.daylight(scene, positions, normals, "year.epw", schedule=night[:24])
        with self.assertRaises(aureole.ArgumentError):
            aureole.daylight(scene, positions, normals, "year.epw", efficacy="lux")
        with self.assertRaises(aureole.OpenError):
            aureole.daylight(scene, positions, normals, "none.epw")

    def test_daylight_coefficients(self):
        with open("wall.rad", "w") as file:
            file.write("void plastic grey 0 0 5 .8 .5 .2 0 0\ngrey polygon wall 0 0 12 -3 2 0 3 2 0 3 2 3 -3 2 3\n")
        positions, normals = [[0, 0, 0.5], [0, 0, 1], [0, 0, -50]], [[0, 0, 1], [0, 1, 0], [1, 0, 0]]
        np.save("sensors.npy", np.hstack([positions, normals]))
        program("irradiance", "wall.rad", "--sensors", "sensors.npy", "--coefficients", "--patches", "reinhart:2", "-n", "1024", "-o", "c.npy")
        program("irradiance", "wall.rad", "--sensors", "sensors.npy", "--coefficients", "--patches", "reinhart:2", "-n", "1024", "-o", "c.mtx")
        found, error = aureole.daylight_coefficients("wall.rad", positions, normals, patches=2, directions=1024)
        self.assertTrue((found == np.load("c.npy")).all() and found.shape == error.shape == (3, 578, 3))
        head, data = open("c.mtx", "rb").read().split(b"\n\n", 1)
        self.assertIn(b"NROWS=3\nNCOLS=578\nNCOMP=3\n", head)
        self.assertTrue((np.frombuffer(data, "f4").reshape(found.shape) == found.astype("f4")).all())
        # Under sky and ground of radiance 1 the same light as by tracing it; far below, a sensor to the east sees half of each.
        program("irradiance", "wall.rad", "--sensors", "sensors.npy", "--sky", "uniform", "--sky-lux", str(179 * np.pi), "--ground-albedo", "1", "-n", "65536", "-o", "uniform.npy")  # fmt: skip
        away = found.sum(1) - np.load("uniform.npy")[:, 3:6]
        self.assertLess(abs(away).max(), 0.02)
        fine, _ = aureole.daylight_coefficients("wall.rad", positions[2:], normals[2:], patches=2, directions=1 << 17)
        east = fine[0, 1 + np.arange(60), 0]  # the lowest row, from north
        turn = np.radians(6 * np.arange(60))
        height = np.sin(np.radians(90 / 14.5))
        truth = np.maximum(np.sin(turn), 0) * 2 * np.sin(np.radians(3)) * (np.arcsin(height) + height * np.sqrt(1 - height**2)) / 2
        self.assertLess(abs(east - truth).max(), 0.1 * truth.max())
        self.assertAlmostEqual(fine[0, 0, 0], np.pi / 2, delta=0.001)

    def test_bifacial(self):
        with open("none.rad", "w") as file:
            file.write("void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey polygon far 0 0 9 0 0 -900 1 0 -900 0 1 -900\n")
        with open("two.epw", "w") as file:
            year = subprocess.run(["bash", f"{TREE}/scripts/weather.sh"], stdout=subprocess.PIPE, check=True, text=True).stdout
            file.writelines(line + "\n" for line in year.splitlines()[:56])
        east, west = [-0.6, 0, 0.8], [0.6, 0, 0.8]
        normals = np.array([[east if hour % 24 < 12 else west for hour in range(48)]][0])
        normals[:3] = 0
        warnings.filterwarnings("ignore", "two.epw: the file has 48")
        found = aureole.bifacial("none.rad", [[0, 0, 1]], normals, "two.epw", directions=1024, ground_albedo=0.5)
        seen = []
        for normal in (east, west):
            fixed = aureole.bifacial(lambda n: "none.rad", lambda n: [[0, 0, 1]], normal, "two.epw", directions=1024, ground_albedo=0.5)
            seen.append(fixed)
        morning = np.arange(48) % 24 < 12
        morning[:3] = False
        self.assertTrue((found.front[0][morning] == seen[0].front[0][morning]).all())
        self.assertTrue((found.rear[0][24 + 12 :] == seen[1].rear[0][24 + 12 :]).all() and not found.front[0][:3].any())
        self.assertAlmostEqual(found.gain[0], 100 * found.rear.sum() / found.front.sum())
        # The first two days are clear: an unshaded rear sees (1 + .8) / 2 of the ground, which has half of the global irradiance.
        level = aureole.bifacial("none.rad", [[0, 0, 1]], [0, 0, 1], "two.epw", directions=1024, ground_albedo=0.5)
        self.assertLess(abs(level.gain[0] - 50), 4 * level.gain_error[0] + 0.01)
        with self.assertRaises(aureole.ArgumentError):
            aureole.bifacial("none.rad", [[0, 0, 1]], normals[:24], "two.epw", directions=64)

    def test_exchange(self):
        program("viewfactors", SCENE, "--group", "--rays", "64", "--radiosity", "0.5", "--emission", "1", "-o", "b.csv")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = aureole.radiosities(SCENE, {"*": 0.5}, emission=1, group=True, rays=64)
            table = np.genfromtxt("b.csv", delimiter=",", names=True)
            self.assertTrue(np.allclose(found.radiosity, table["radiosity"], rtol=1e-8))
            script = aureole.viewfactors(SCENE, group=True, rays=64, script=0.5)
            with open("emittances.csv", "w") as file:
                file.write("name,emittance\n*,.5\n")
            program("viewfactors", SCENE, "--group", "--rays", "64", "--surfaces", "emittances.csv", "--script-f", "-o", "script.npz")
            self.assertTrue((script.values == np.load("script.npz")["data"]).all())
            factors = aureole.viewfactors(SCENE, group=True, rays=64, error=0.02)
            self.assertLess(factors.half_widths.max(), 0.02)
            for bad in ({"reflectance": {"none": 1}}, {"reflectance": [1, 2]}, {"reflectance": 0.5, "emittance": 0.5}, {}):
                with self.assertRaises(aureole.ArgumentError):
                    aureole.radiosities(SCENE, group=True, rays=64, **bad)

    def test_view_factors(self):
        program("viewfactors", SCENE, "--group", "--rays", "256", "-o", "factors.npz")
        expected = np.load("factors.npz")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            found = aureole.viewfactors(SCENE, group=True, rays=256)
        self.assertTrue(caught and all(w.category is aureole.AureoleWarning for w in caught))
        self.assertTrue((found.values == expected["data"]).all() and (found.columns == expected["indices"]).all())
        self.assertLess(abs(found.dense().sum(axis=1) + found.sky + found.back - 1).max(), 1e-9)
        self.assertIn("light", found.names)
        square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
        # Two unit squares at the distance 1 (Howell's catalogue, C-11).
        above = square[::-1] + [0, 0, 1]
        self.assertAlmostEqual(aureole.view_factor_polygons(square, above), 0.199824895698, delta=1e-10)

    def test_tables(self):
        tables = aureole.render_tables()
        self.assertIn("max_depth", tables["integrator"]["path"].keys)
        self.assertRegex(aureole.render_library().rsplit("/", 1)[-1], "^libaureole-(lab|lighting)")  # a wheel has both


unittest.main(argv=sys.argv[:1])

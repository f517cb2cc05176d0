"""The engines of aureole.qmc."""

import unittest
import warnings

import copy
import inspect
import itertools
import os
import pickle

import numpy as np
import scipy.integrate
from scipy.stats import qmc

import aureole
import aureole.qmc


class Engines(unittest.TestCase):
    def test_every_set_has_one(self):
        for name, row in aureole.sets().items():
            if name in ("file", "matrices") or row.domains == ("rotations",):
                continue
            size = {"healpix": 12, "t-design": 18, "lebedev": 26, "gauss": 32, "icosahedral": 42}.get(name, 64)
            d = min(2, row.dimensions[1])
            engine = aureole.qmc.engines()[name](d, n=size, scramble=False, seed=3)
            self.assertIsInstance(engine, qmc.QMCEngine)
            sample = engine.random(12)
            self.assertEqual(sample.shape, (12, d), name)
            self.assertTrue((sample >= 0).all() and (sample < 1).all(), name)
            if not row.native and name != "sobol":  # in Gray code's order
                self.assertTrue((sample == aureole.PointSet(name, size, dimension=d, seed=3).points(0, 12)).all(), name)

    def test_they_go_on_and_begin_anew(self):
        engine = aureole.qmc.Halton(3, scramble=True, seed=1)
        first, second = engine.random(10), engine.random(10)
        self.assertTrue((np.vstack([first, second]) == engine.reset().random(20)).all())
        self.assertTrue((engine.reset().fast_forward(10).random(10) == second).all())
        self.assertFalse((aureole.qmc.Halton(3, scramble=True, seed=2).random(10) == first).any())
        same = [aureole.qmc.Sobol(2, scramble=True, seed=np.random.default_rng(5)).random(8) for _ in range(2)]
        self.assertTrue((same[0] == same[1]).all())
        with self.assertRaisesRegex(ValueError, "n must be given"):
            aureole.qmc.Hammersley(2)
        with self.assertRaisesRegex(ValueError, "all there are"):
            aureole.qmc.Hammersley(2, n=16).random(17)
        with self.assertRaises(ValueError):
            aureole.qmc.Halton(2, permute="rndom")
        with self.assertRaisesRegex(TypeError, "another name"):
            aureole.qmc.Halton(2, seed=1, rng=2)

    def test_seeds_of_any_kind(self):
        entropy = np.random.SeedSequence(8).entropy << 100
        for seed in (lambda: 2**63, lambda: entropy, lambda: np.int64(4), lambda: np.random.default_rng(4),
                     lambda: np.random.RandomState(4)):  # fmt: skip
            first, second = (aureole.qmc.Sobol(2, scramble=True, rng=seed()).random(8) for _ in range(2))
            self.assertTrue((first == second).all(), seed())
        by_name = [aureole.qmc.Sobol(2, scramble="owen", **{name: entropy}).random(8) for name in ("seed", "rng")]
        self.assertTrue((by_name[0] == by_name[1]).all())
        other = aureole.qmc.Sobol(2, scramble="owen", rng=entropy + 1).random(8)
        self.assertFalse((by_name[0] == other).any())
        if "rng" in inspect.signature(qmc.Sobol.__init__).parameters:  # SciPy makes others of an integer by each name
            for name in ("seed", "rng"):
                ours, theirs = (module.Sobol(2, **{name: entropy}).random(8) for module in (aureole.qmc, qmc))
                self.assertTrue((ours == theirs).all())
        with self.assertRaises(ValueError):
            aureole.qmc.Sobol(2, rng=-1)
        with self.assertRaisesRegex(TypeError, "seed must be an integer, None or .* not str '7'"):
            aureole.qmc.Sobol(2, seed="7")

    def test_no_dimensions_and_base_2(self):
        self.assertEqual(aureole.qmc.Sobol(0).random(4).shape, (4, 0))
        engine = aureole.qmc.Sobol(3, seed=1)
        self.assertTrue((engine.random_base2(3) == aureole.qmc.Sobol(3, seed=1).random(8)).all())
        with self.assertRaisesRegex(ValueError, "power of 2"):
            engine.random_base2(4)

    def test_copies_go_on(self):
        for engine in (
            aureole.qmc.Sobol(2, scramble=True, seed=3), aureole.qmc.Halton(2, permute="random", seed=3),
            aureole.qmc.SphericalFibonacci(2, n=30, scramble=True, seed=3), aureole.qmc.Sobol(0),
            aureole.qmc.Sobol(3, scramble="owen", rng=np.random.default_rng(2)), aureole.qmc.Halton(3), aureole.qmc.Faure(4),
        ):  # fmt: skip
            engine.random(5)
            copies = [copy.deepcopy(engine), pickle.loads(pickle.dumps(engine))]
            following = engine.random(5)
            for made in copies:
                self.assertTrue((made.random(5) == following).all())
        self.assertEqual(repr(aureole.qmc.Sobol(3, scramble="owen")), "<Sobol(d=3, scramble='owen'), 0 points drawn>")

    def test_parts_of_sets(self):
        """The first points of a set that is other points for every size are told of, those of a sequence are not."""
        for engine in (aureole.qmc.SphericalFibonacci, aureole.qmc.FibonacciLattice, aureole.qmc.Hammersley):
            with self.assertWarnsRegex(aureole.AureoleWarning, "the first 64 of 89 points are no even set"):
                engine(n=89, scramble=True, seed=1).random(64)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(aureole.qmc.SphericalFibonacci(n=89).random(89).shape, (89, 2))
            self.assertEqual(aureole.qmc.Faure(3).random(27).shape, (27, 3))
            self.assertEqual(aureole.qmc.Halton(2, n=89).random(64).shape, (64, 2))
            self.assertEqual(aureole.qmc.Hammersley(2, n=64).fast_forward(32).random(32).shape, (32, 2))

    def test_qmc_quad(self):
        """Integrals by every set, within eight of their standard errors: by 8 estimates chance exceeds that once in 10^4."""
        public = getattr(scipy.integrate, "qmc_quad", None)  # before SciPy 1.11 the first axis is that of points
        quad = public or scipy.integrate._quadrature._qmc_quad

        def integrate(engine):
            return quad(lambda x: np.prod(1 + x, axis=0 if public else -1), [0.0] * engine.d, [1.0] * engine.d,
                        n_points=size, n_estimates=8, qrng=engine)  # fmt: skip

        for name, engine in aureole.qmc.engines().items():
            row = aureole.sets()[name]
            if os.environ.get("AUREOLE_SHORT_TESTS") and not row.extensible:
                continue
            size = {"healpix": 12, "t-design": 18, "lebedev": 26, "gauss": 32, "icosahedral": 42}.get(name, 16)
            d = min(2, row.dimensions[1])
            endless = row.extensible and (row.maximum_size or 2**48) > 2**20
            made = engine(d, n=None if endless else size, scramble=True, seed=5)
            found = integrate(made)
            self.assertGreater(found.standard_error, 0, name)
            self.assertLess(abs(found.integral - 1.5**d), 8 * found.standard_error, name)
        size = 64  # only the first of the estimates is by the points themselves, as with scipy's engines
        for made in (aureole.qmc.Sobol(3), aureole.qmc.Halton(3, permute="random"), aureole.qmc.Hammersley(3, n=64)):
            found = integrate(made)
            self.assertLess(abs(found.integral - 1.5**3), 0.1)

    def test_scipys_points(self):
        """Sobol and Halton are SciPy's, drawn in parts, for the same seed."""
        ways = [{"scramble": False}, {}, {"bits": 12}, {"bits": 40}, {"bits": 64}]
        for d, way in itertools.product((1, 2, 7, 40), ways):
            ours, theirs = aureole.qmc.Sobol(d, seed=5, **way), qmc.Sobol(d, seed=5, **way)
            for n in (1, 7, 8, 100, 1, 37):
                error = abs(ours.random(n) - theirs.random(n)).max()
                self.assertLessEqual(error, 2**-53 if way.get("bits") == 64 else 0, (d, way))
        ours, theirs = (module.Sobol(2000, scramble=False).random(8) for module in (aureole.qmc, qmc))
        self.assertTrue((ours == theirs).all())
        for d, first in itertools.product((1, 2, 7, 100), (0, 5000)):
            for scramble in (False, True):
                ours, theirs = (maker.Halton(d, scramble=scramble, seed=5) for maker in (aureole.qmc, qmc))
                ours, theirs = (made.fast_forward(first).random(500) for made in (ours, theirs))
                if scramble and not hasattr(qmc.Halton, "_initialize_permutations"):
                    ours, theirs = ours[:, :1], theirs[:, :1]  # SciPy before 1.11 permuted all dimensions alike
                self.assertLess(abs(ours - theirs).max(), 5e-16, (d, first, scramble))
        with self.assertRaisesRegex(ValueError, "increasing `bits`"):
            aureole.qmc.Sobol(2, bits=3).random(9)

    def test_faure_keeps_its_net(self):
        """Each cell of a (0,m,s)-net in base 5 has one of 25 points, scrambled too; the first point is not 0 then."""
        for seed in range(5):
            sample = aureole.qmc.Faure(5, seed=seed).random(25)
            for a, b in itertools.combinations(range(5), 2):
                cells = np.floor(5 * sample[:, [a, b]]) @ [5, 1]
                self.assertEqual(len(set(cells)), 25, (seed, a, b))
            self.assertGreater(sample[0].min(), 0)

    def test_scipys_own(self):
        # SciPy's Sobol points come in Gray code's order: the same 2^k points, another order.
        ours, theirs = aureole.PointSet("sobol", 64, dimension=4).points(), qmc.Sobol(4, scramble=False).random(64)
        self.assertTrue((ours[[i ^ (i >> 1) for i in range(64)]] == theirs).all())
        ours = aureole.qmc.Halton(3, scramble=False).random(50)
        value = qmc.discrepancy(ours[:, :2], method="L2-star")
        self.assertAlmostEqual(aureole.measure(ours[:, :2], "l2-star"), value, delta=1e-14)
        optimised = aureole.qmc.Sobol(2, scramble=False, optimization="random-cd", seed=3).random(16)
        self.assertLessEqual(qmc.discrepancy(optimised), qmc.discrepancy(aureole.qmc.Sobol(2, scramble=False).random(16)))
        normal = qmc.MultivariateNormalQMC(mean=[0, 0], engine=aureole.qmc.Sobol(2, scramble=True, seed=1)).random(256)
        self.assertLess(abs(normal.mean(axis=0)).max(), 0.02)


unittest.main(warnings="ignore")  # what sets say of their sizes

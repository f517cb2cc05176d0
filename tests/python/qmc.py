"""The engines of aureole.qmc."""

import unittest
import warnings

import copy
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
            size = {"healpix": 12, "t-design": 18, "lebedev": 26}.get(name, 64)
            d = min(2, row.dimensions[1])
            engine = aureole.qmc.engines()[name](d, n=size, seed=3)
            self.assertIsInstance(engine, qmc.QMCEngine)
            sample = engine.random(12)
            self.assertEqual(sample.shape, (12, d), name)
            self.assertTrue((sample >= 0).all() and (sample < 1).all(), name)
            if not row.native:
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
        with self.assertRaisesRegex(TypeError, "two names"):
            aureole.qmc.Halton(2, seed=1, rng=2)

    def test_seeds_of_any_kind(self):
        entropy = np.random.SeedSequence(8).entropy << 100
        for seed in (lambda: 2**63, lambda: entropy, lambda: np.int64(4), lambda: np.random.default_rng(4),
                     lambda: np.random.RandomState(4)):  # fmt: skip
            first, second = (aureole.qmc.Sobol(2, scramble=True, rng=seed()).random(8) for _ in range(2))
            self.assertTrue((first == second).all(), seed())
        by_name = [aureole.qmc.Sobol(2, scramble=True, **{name: entropy}).random(8) for name in ("seed", "rng")]
        self.assertTrue((by_name[0] == by_name[1]).all())
        other = aureole.qmc.Sobol(2, scramble=True, rng=entropy + 1).random(8)
        self.assertFalse((by_name[0] == other).any())
        with self.assertRaises(ValueError):
            aureole.qmc.Sobol(2, rng=-1)

    def test_no_dimensions_and_base_2(self):
        self.assertEqual(aureole.qmc.Sobol(0).random(4).shape, (4, 0))
        engine = aureole.qmc.Sobol(3)
        self.assertTrue((engine.random_base2(3) == aureole.qmc.Sobol(3).random(8)).all())
        with self.assertRaisesRegex(ValueError, "power of 2"):
            engine.random_base2(4)

    def test_copies_go_on(self):
        for engine in (
            aureole.qmc.Sobol(2, scramble=True, seed=3), aureole.qmc.Halton(2, permute="random", seed=3),
            aureole.qmc.SphericalFibonacci(2, n=30, scramble=True, seed=3), aureole.qmc.Sobol(0),
        ):  # fmt: skip
            engine.random(5)
            copies = [copy.deepcopy(engine), pickle.loads(pickle.dumps(engine))]
            following = engine.random(5)
            for made in copies:
                self.assertTrue((made.random(5) == following).all())

    def test_parts_of_sets(self):
        """The first points of a set that is other points for every size are told of, those of a sequence are not."""
        for engine in (aureole.qmc.SphericalFibonacci, aureole.qmc.FibonacciLattice, aureole.qmc.Hammersley):
            with self.assertWarnsRegex(aureole.AureoleWarning, "the first 64 of 89 points are no even set"):
                engine(n=89, scramble=True, seed=1).random(64)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(aureole.qmc.SphericalFibonacci(n=89).random(89).shape, (89, 2))
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
            size = {"healpix": 12, "t-design": 18, "lebedev": 26}.get(name, 16)
            d = min(2, row.dimensions[1])
            made = engine(d, n=None if row.extensible else size, scramble=True, seed=5)
            found = integrate(made)
            self.assertGreater(found.standard_error, 0, name)
            self.assertLess(abs(found.integral - 1.5**d), 8 * found.standard_error, name)
        size = 64  # only the first of the estimates is by the points themselves, as with scipy's engines
        for made in (aureole.qmc.Sobol(3), aureole.qmc.Halton(3, permute="random"), aureole.qmc.Hammersley(3, n=64)):
            found = integrate(made)
            self.assertLess(abs(found.integral - 1.5**3), 0.1)

    def test_scipys_own(self):
        # SciPy's Sobol points come in Gray code's order: the same 2^k points, another order.
        for k in (3, 6):
            ours, theirs = aureole.qmc.Sobol(4).random(2**k), qmc.Sobol(4, scramble=False).random(2**k)
            self.assertTrue((np.sort(ours, axis=0) == np.sort(theirs, axis=0)).all())
            self.assertAlmostEqual(qmc.discrepancy(ours), qmc.discrepancy(theirs), delta=1e-14)
        ours = aureole.qmc.Halton(3).random(50)
        self.assertLess(abs(ours - qmc.Halton(3, scramble=False).random(50)).max(), 1e-15)
        value = qmc.discrepancy(ours[:, :2], method="L2-star")
        self.assertAlmostEqual(aureole.measure(ours[:, :2], "l2-star"), value, delta=1e-14)
        optimised = aureole.qmc.Sobol(2, optimization="random-cd", seed=3).random(16)
        self.assertLessEqual(qmc.discrepancy(optimised), qmc.discrepancy(aureole.qmc.Sobol(2).random(16)))
        normal = qmc.MultivariateNormalQMC(mean=[0, 0], engine=aureole.qmc.Sobol(2, scramble=True, seed=1)).random(256)
        self.assertLess(abs(normal.mean(axis=0)).max(), 0.02)


unittest.main(warnings="ignore")  # what sets say of their sizes

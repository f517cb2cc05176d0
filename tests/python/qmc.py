"""The engines of aureole.qmc."""

import unittest

import numpy as np
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

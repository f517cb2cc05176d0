"""SciPy's own tests of its engines and of qmc_quad, unchanged, with Aureole's Sobol and Halton in the place of SciPy's; by pytest."""

import pytest
import scipy
from scipy.stats import _qmc, qmc

import aureole.qmc

for module in (_qmc, qmc):
    module.Sobol, module.Halton = aureole.qmc.Sobol, aureole.qmc.Halton

from scipy.integrate.tests.test_quadrature import TestQMCQuad  # noqa: E402, F401
from scipy.stats.tests import test_qmc  # noqa: E402
from scipy.stats.tests.test_qmc import TestMultinomialQMC, TestMultivariateNormalQMC, TestNormalQMC, TestSobol  # noqa: E402, F401

if hasattr(test_qmc, "test_deterministic"):
    from scipy.stats.tests.test_qmc import test_deterministic  # noqa: F401

one_permutation = tuple(int(part) for part in scipy.__version__.split(".")[:2]) < (1, 11)
reason = "SciPy before 1.11 permuted all dimensions by the same random numbers, and expects such points"


class TestHalton(test_qmc.TestHalton):
    @pytest.mark.skipif(one_permutation, reason=reason)
    def test_workers(self):
        super().test_workers()

    @pytest.mark.parametrize("scramble", [True, False])
    def test_sample(self, scramble):
        if scramble and one_permutation:
            pytest.skip(reason)
        super().test_sample(scramble)


class Others(test_qmc.QMCEngineTests):
    can_scramble = True

    def test_sample(self, *args):
        pytest.skip("SciPy has no values of this set")


class TestFaure(Others):
    qmce = aureole.qmc.Faure


class TestNiederreiter(Others):
    qmce = aureole.qmc.Niederreiter

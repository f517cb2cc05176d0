"""Integrals to a tolerance, and estimates of any functional of points with their intervals."""

from __future__ import annotations

from typing import Any, Callable, Literal, NamedTuple, Optional

import numpy as np

from ._bridge import Progress
from ._core import CoreCall, core, ffi, lib
from ._points import Array


class Integral(NamedTuple):
    value: float
    error: float  #: what was held against the tolerance
    interval: float  #: half the width of Student's interval about the value
    difference: float  #: between the values of the last two levels
    evaluations: int
    levels: int
    converged: bool  #: the tolerance was reached


def integrate(
    f: Callable[..., Any], tol: float = 0.01, *, absolute: float = 0.0,
    domain: Literal["sphere", "hemisphere"] = "sphere", cap: float = 0.0, exponent: float = 0.0,
    axis: Optional[tuple[float, float]] = None, confidence: float = 0.95, replicates: int = 8,
    evaluations: int = 2**22, seed: int = 0, progress: Optional[Progress] = None,
) -> Integral:  # fmt: skip
    """The integral of a function over directions, in steradians, until its error is as wanted.

    Parameters
    ----------
    f : called with unit vectors (n, 3), and where there is an axis also with the numbers (n,) on it; returns values (n,).
        What it raises ends the integration. The arrays are the function's own: it may keep them.
    tol : the relative error wanted; `absolute`: the absolute one. The larger of the two counts, one must be > 0.
    domain : "sphere" or "hemisphere"; cap : degrees; not 0: the cap of that polar angle about +z.
    exponent : the function is multiplied by cos^exponent theta, on the whole hemisphere.
    axis : (a, b): the product with one more number from a to b, a radius or an energy.
    confidence, replicates, evaluations : of the interval; randomised replicates, 4 to 64; at most so many values of f.

    On the sphere each replicate is a spherical Fibonacci grid that doubles (Marques 2019), with exact weights, turned at
    random; elsewhere an Owen-scrambled Sobol sequence.

    >>> integral = integrate(lambda u: u[:, 2] ** 2, 1e-6)
    >>> round(integral.value, 6), integral.converged  # 4 pi / 3
    (4.18879, True)
    """
    options = ffi.new("aur_integrate_options *")
    core.initialize(options, lib.aur_integrate_options_init, core.value("domain", domain))
    core.fill(
        options, cap_degrees=cap, exponent=exponent, relative=tol, absolute=absolute, confidence=confidence,
        replicates=replicates, evaluations=evaluations, seed=seed,
    )  # fmt: skip
    if axis is not None:
        core.fill(options, has_axis=True, axis_from=axis[0], axis_to=axis[1])
    integral = core.options("integral")
    with CoreCall(progress, f) as call:
        call.attach(options, warnings=False)
        core.call(lib.aur_integrate, lib.aureole_integrand, call.handle, options, integral)
    return Integral(
        integral.value, integral.error, integral.interval, integral.difference, integral.evaluations, integral.levels,
        integral.reason == lib.AUR_INTEGRATE_TOLERANCE,
    )  # fmt: skip


class Estimate(NamedTuple):
    value: Array  #: (values,), the mean over the randomisations
    error: Array  #: (values,), its standard error
    half_width: Array  #: (values,), of Student's interval
    evaluations: int
    levels: int
    converged: bool


def estimate(
    f: Callable[[Array, Array], Any], dimension: int, values: int = 1, *, set: str = "sobol", tol: float = 0.01,
    absolute: float = 0.0, confidence: float = 0.95, replicates: int = 16, first: int = 16, evaluations: int = 2**20,
    seed: int = 0, progress: Optional[Progress] = None,
) -> Estimate:  # fmt: skip
    """Any functional of points with weights, by independent randomisations of the points, with its interval.

    Parameters
    ----------
    f : called with points (n, dimension) in [0, 1) and weights (n,) of sum 1; returns `values` numbers, of which the
        first is held against the error wanted. The arrays are the function's own: it may keep them.
    set : of `dimension` dimensions. Nets in base 2 are Owen-scrambled, other sets shifted modulo 1.
    tol, absolute : the half width wanted, relative and absolute; both 0: one level of all points.
    confidence, replicates, first, evaluations : of the intervals; randomisations, 4 to 64; points of a randomisation on
        the first level, each level having twice as many; points at most, of all.

    >>> found = estimate(lambda u, w: w @ np.exp(u[:, 0] * u[:, 1]), 2, tol=1e-5)
    >>> found.converged, bool(abs(found.value[0] - 1.31790215) < 3e-5)
    (True, True)
    """
    name = ffi.new("char[]", set.encode())
    options = ffi.new("aur_estimate_options *")
    core.initialize(options, lib.aur_estimate_options_init, dimension, values)
    core.fill(
        options, set=name, relative=tol, absolute=absolute, confidence=confidence, replicates=replicates, first=first,
        evaluations=evaluations, seed=seed,
    )  # fmt: skip
    results = np.empty((values, 3))
    report = core.options("estimate_report")
    with CoreCall(progress, f) as call:
        call.count = values
        call.attach(options, warnings=False)
        core.call(
            lib.aur_estimate, lib.aureole_functional, call.handle, options, core.output(results, "aur_estimated"),
            report,
        )  # fmt: skip
    value, error, half_width = results.T
    return Estimate(value, error, half_width, report.evaluations, report.levels, report.reached)

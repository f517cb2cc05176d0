"""Integrals to a tolerance, and estimates of any functional of points with their intervals."""

from __future__ import annotations

import operator
import time
import warnings
from typing import Any, Callable, Literal, NamedTuple, Optional, Sequence

import numpy as np

from ._bridge import ArgumentError, AureoleWarning, IntegrationWarning, Progress, Seed, UnsupportedError, encode, vector
from ._core import CoreCall, core, ffi, lib
from ._points import Array, parse_symmetry


Domain = Literal[
    "sphere", "hemisphere", "axes", "rotations", "square", "cube", "disk", "ball", "triangle", "tetrahedron"
]
_REGIONS = ("ball", "triangle", "tetrahedron")
_DOUBTS = ("all equal", "sparse", "dominated", "heavy tail", "unresolved")
_REASONS = ("tolerance", "evaluations", "constant")
_DEFAULT_EVALUATIONS = 2**19  #: that the default resolution takes, of 16 randomisations
_PATIENCE = 10.0  #: seconds in a slow function until a warning says how long the default resolution takes


class Integral(NamedTuple):
    """Of a function with several values per point, `value` and `interval` have the shape of one point's values."""

    value: Any
    error: float  #: compared with the tolerance; of several values the largest
    interval: Any  #: half the width of the interval about the value
    difference: float  #: between the values of the last two levels
    evaluations: int
    levels: int
    converged: bool  #: the tolerance was reached
    reason: str = ""  #: "tolerance", "evaluations" or "constant": why the work ended
    doubts: tuple[str, ...] = ()  #: "all equal", "sparse", "dominated", "heavy tail", "unresolved": why the interval may not hold
    resolution: float = 0.0  #: with 95 % probability a feature of this share of the domain has been seen
    resolution_degrees: float = 0.0  #: the radius of a cap of that size; 0: not on the sphere, hemisphere or axes


class _Shape(Exception):
    """The function has other values per point than were expected."""


def _values(function: Callable[..., Any], *arguments: Array) -> Array:
    """What a function of the user's returns, as doubles or complex numbers with one row per point."""
    count = len(arguments[0])
    returned = function(*arguments)
    if returned is None or np.ma.is_masked(returned):
        raise ArgumentError("the function must return numbers, not " + ("None" if returned is None else "masked values"))
    values = np.asarray(returned)
    if values.dtype.kind not in "biufcO":  # NumPy would make numbers of strings, dates and records
        raise TypeError(f"the function must return numbers, not {values.dtype}")
    values = values.astype(np.complex128 if np.iscomplexobj(values) else np.float64)  # a copy: it may be a view of them
    if values.ndim == 0:
        values = np.full(count, values[()])
    if len(values) != count or values.size == 0:
        raise ArgumentError(f"the function must return one row of values per point, ({count}, ...), not {values.shape}")
    return values


class _Integrand:
    """A user's function, whose values per point are known once it was called: its first ones are used again."""

    def __init__(self, function: Callable[..., Any]):
        self.function = function
        self.shape: tuple[int, ...] = ()
        self.type: type = float
        self.first: Optional[tuple[tuple[Array, ...], Array]] = None
        self.advises = False  # on the time that the default resolution takes
        self.seconds, self.evaluated = 0.0, 0

    @property
    def width(self) -> int:
        return int(np.prod(self.shape)) * (2 if self.type is complex else 1)

    def _advise(self, seconds: float, evaluated: int) -> None:
        """Warns once if a function is so slow that the default resolution takes minutes more."""
        self.seconds, self.evaluated = self.seconds + seconds, self.evaluated + evaluated
        left = (_DEFAULT_EVALUATIONS - self.evaluated) * self.seconds / self.evaluated
        if self.advises and self.seconds >= _PATIENCE and left >= 6 * _PATIENCE:
            self.advises = False
            warnings.warn(
                f"the default resolution takes {_DEFAULT_EVALUATIONS} evaluations, about {left / 60:.0f} minutes more: if no "
                "feature of the function is narrow, pass resolution=1",
                AureoleWarning,
                stacklevel=8,  # the caller of `integrate`, below the library's call
            )

    def __call__(self, *arguments: Array) -> Array:
        first, self.first = self.first, None
        if first is not None and all(map(np.array_equal, first[0], arguments)):
            return first[1]
        copies = tuple(array.copy() for array in arguments)
        begin = time.perf_counter()
        result = _values(self.function, *arguments)
        self._advise(time.perf_counter() - begin, len(result))
        if self.type is complex:
            result = result.astype(np.complex128)
        if result.shape[1:] != self.shape or result.dtype.type is np.complex128 and self.type is not complex:
            self.shape = result.shape[1:]
            self.type = complex if np.iscomplexobj(result) else float
            self.first = (copies, np.ascontiguousarray(result).view(np.float64).ravel())
            raise _Shape
        return np.ascontiguousarray(result).view(np.float64).ravel()

    def shaped(self, column: Array) -> Any:
        """Numbers of all values in the shape of one point's; a number where that has none."""
        result = np.array(column)
        if self.type is complex:
            result = result.view(np.complex128)
        return result.reshape(self.shape)[()] if self.shape else result[0].item()

    def widths(self, column: Array) -> Any:
        """The same of half widths, which are of a complex number's modulus."""
        result = self.shaped(column)
        return abs(result) if self.type is complex else result


def _integrate(
    f: Callable[..., Any], domain: str, dimension: int, axis: Optional[tuple[float, float]], peaks: Sequence[Any],
    progress: Optional[Progress], name: Optional[str], **fields: Any,
) -> tuple[_Integrand, Any, Array]:  # fmt: skip
    if not callable(f):
        raise TypeError(f"expected a function, not {type(f).__name__}")
    options = ffi.new("aur_integrate_options *")
    region = _REGIONS.index(domain) + 1 if domain in _REGIONS else 0
    if dimension and domain != "cube":
        raise ArgumentError(f"a dimension is for the cube, not for the domain {domain!r}")
    core.initialize(options, lib.aur_integrate_options_init, core.value("domain", "cube" if region else domain))
    core.fill(options, region=region, dimension=dimension, **fields)
    if axis is not None:
        if np.shape(axis) != (2,):
            raise ArgumentError(f"an axis is (a, b), not {axis!r}")
        core.fill(options, has_axis=True, axis_from=axis[0], axis_to=axis[1])
    alive, peak_rows = [name and ffi.new("char[]", encode(name))], ffi.new("aur_integrate_peak[]", len(peaks))
    for row, peak in zip(peak_rows, peaks):
        if not isinstance(peak, (tuple, list)) or len(peak) not in (2, 3):
            raise ArgumentError(f"a peak is (centre, radius) or (centre, radius, exponent), not {peak!r}")
        centre, radius, *exponent = peak
        point = vector(np.atleast_1d(centre), lib.aur_integrate_coordinates(options), "the centre of a peak")
        alive.append(ffi.new("double[]", point.tolist()))
        core.fill(row, centre=alive[-1], radius=radius, exponent=exponent[0] if exponent else 0.0)
    core.fill(options, peak_count=len(peaks), peaks=peak_rows, set=alive[0] or ffi.NULL)
    integrand = _Integrand(f)
    by_default = not (options.resolution or options.first or len(peaks) or options.group)
    integrand.advises = by_default and options.evaluations >= _DEFAULT_EVALUATIONS
    for _ in range(3):
        width = integrand.width
        options.values = width
        results = np.empty((width, 3))
        integral = core.options("integral")
        try:
            with CoreCall(progress, integrand) as call:
                call.coordinates, call.count = lib.aur_integrate_coordinates(options), width
                call.category, call.depth = IntegrationWarning, 4
                call.attach(options)
                core.call(
                    lib.aur_integrate_values, lib.aureole_integrand, call.handle, options,
                    core.output(results, "aur_estimated"), integral,
                )  # fmt: skip
            return integrand, integral, results
        except _Shape:
            continue
    raise ArgumentError(f"the function's values changed their shape to {integrand.shape}")


def point_group(name: str) -> Array:
    """The matrices (order, 3, 3) of a point group by its Schoenflies symbol, the identity first.

    "Ci" (u and -u), "Cs" (a mirror plane), "Cn", "Cnv", "Cnh", "Sn", "Dn", "Dnh", "Dnd" with n from 1 to 30, "T", "Td", "Th",
    "O", "Oh", "I", "Ih". The main axis is z, mirror planes and axes across it contain x. A box along the axes has "D2h".

    >>> point_group("D2h").shape
    (8, 3, 3)
    """
    group = ffi.new("aur_point_group *")
    core.call(lib.aur_point_group_from_name, encode(name), group)
    return np.array([list(group.elements[i].m) for i in range(group.order)]).reshape(-1, 3, 3)


def symmetric_rule(n: int, symmetry: str) -> tuple[Array, Array]:
    """At most `n` directions (n, 3) and weights of sum 1 for the mean over the sphere of functions with a symmetry.

    Their images under the point group are a product rule: Gauss-Legendre heights times equal azimuths. It is exact for
    polynomials to a degree of about sqrt(2 n order) - 1. `symmetry`: as for `point_group`.

    >>> xyz, w = symmetric_rule(900, "D2h")
    >>> round(float(w @ np.sinc(8 * xyz[:, 2] / np.pi) ** 2), 12)
    0.188618568844
    """
    group = ffi.new("aur_point_group *")
    core.call(lib.aur_point_group_from_name, encode(symmetry), group)
    n = operator.index(n)
    if n < 1:
        raise ArgumentError(f"a rule must have 1 point or more, not {n}")
    xyz, weights, count = np.empty((n, 3)), np.empty(n), ffi.new("size_t *")
    core.call(lib.aur_symmetric_rule, group, n, 3 * n, core.output(xyz), core.output(weights), count)
    return xyz[: count[0]], weights[: count[0]]


def _symmetric(f: Callable[..., Any], xyz: Array, weights: Array) -> tuple[Any, int, bool]:
    """The mean by a symmetric rule, its number of points, and whether all values were equal."""
    result = _values(f, xyz.copy())
    if not np.isfinite(result).all():
        raise ArgumentError("the function has a value that is not finite")
    return np.tensordot(weights, result, 1)[()], len(xyz), bool((result == result[0]).all())


def integrate(
    f: Callable[..., Any], tol: float = 0.01, *, absolute: float = 0.0, domain: Domain = "sphere",
    dimension: int = 0, cap: float = 0.0, exponent: float = 0.0, axis: Optional[tuple[float, float]] = None,
    peaks: Sequence[tuple[Any, ...]] = (), symmetry: Optional[str] = None, separate: bool = False, mean: bool = False,
    confidence: float = 0.95, replicates: int = 16, first: int = 0, resolution: float = 0.0, evaluations: int = 2**22,
    max_points: Optional[int] = None, seed: Seed = 0, progress: Optional[Progress] = None,
) -> Integral:  # fmt: skip
    """The integral of a function over a domain until its error is below a tolerance.

    By default f is evaluated at 524288 points or more, so that narrow features are seen: 9 minutes at 1 ms each. For a slow
    function without narrow features pass `resolution=1`; 8192 can suffice then.

    Parameters
    ----------
    f : called with points (n, coordinates), at most 1024, and with an axis also the numbers (n,) on it; returns values
        (n,) or (n, ...), real or complex. What it raises ends the integration. The arrays are the function's own.
    tol : the relative target error; `absolute`: the absolute one. The larger of the two counts, one must be > 0.
    domain : directions in steradians on the "sphere" or "hemisphere"; "axes" (z >= 0, 2 pi in all); "rotations"
        (quaternions w,x,y,z, 1 in all); "square", "disk", "cube" of `dimension`; the unit "ball"; "triangle" and
        "tetrahedron" (coordinates >= 0 whose sum is at most 1). `mean`: divided by the domain's measure.
    cap : degrees; not 0: the cap of that polar angle about +z.
    exponent : the function is multiplied by cos^exponent theta, on the whole hemisphere.
    axis : (a, b): the product with one more number from a to b, a radius or an energy.
    peaks : (centre, radius) or (centre, radius, exponent): parts of the domain with points of their own, where the function
        is large in a small place. Directions have a radius in degrees, points of the square and cube half the side of a
        box, 0 is all of the domain. `exponent`: the function grows as distance^-exponent, and is integrated without a
        singularity.
    symmetry : the point group of a smooth function on the sphere, see `point_group`: each value counts as often as the group
        has elements, by product rules (`symmetric_rule`) whose degrees double until two agree. No random move keeps mirror
        planes: error and interval are the change from the rule before, an estimate for smooth functions only.
    separate : each of several values is an integral with its own tolerance; else the tolerance is relative to the largest.
    confidence, replicates : of the interval; randomisations, 4 to 64.
    first : points of a randomisation on the first level. Without `resolution` nothing else sets the number of points then.
    resolution : the share of the domain that the smallest feature takes: no result comes before a feature of that size has
        been seen with 95 % probability, by 3 / resolution points. 0: 1e-5 (524288 values of f), nearly as a sun with a radius
        of 0.27 degrees in the sky; with `first` or `peaks` no condition. 1: no narrow features. A slow f gets a warning after 10 s.
    evaluations, max_points : two names of the largest number of values of f.

    An `IntegrationWarning` comes where the tolerance was not reached or the interval may not hold: all values are equal
    (the interval is then infinite), few values differ, one point has most of the sum, the tail is heavy, or there are too
    few points for `resolution`. A feature that no point has hit gives no other sign: the result's `resolution` gives its size.

    >>> integral = integrate(lambda u: u[:, 2] ** 2, 1e-6)
    >>> round(integral.value, 6), integral.converged  # 4 pi / 3
    (4.18879, True)
    >>> integrate(lambda x: np.exp(2j * np.pi * x[:, :1] * [0, 0.5]), domain="square").value.round(2)
    array([1.+0.j  , 0.+0.64j])
    """
    most = evaluations if max_points is None else max_points
    if tol == 0.0 == absolute:
        raise ArgumentError("one of the tolerances must be above 0")
    if symmetry is not None and domain != "sphere":
        raise UnsupportedError("a symmetry is for the whole sphere")
    group = ffi.NULL if symmetry is None else parse_symmetry(symmetry, domain)[0]
    integrand, integral, results = _integrate(
        f, domain, dimension, axis, peaks, progress, None, cap_degrees=cap, exponent=exponent, relative=tol,
        absolute=absolute, confidence=confidence, replicates=replicates, first=first, seed=seed, separate=separate,
        mean=mean, evaluations=most, group=group, resolution=resolution,
    )  # fmt: skip
    return Integral(
        integrand.shaped(results[:, 0]), integral.error, integrand.widths(results[:, 2]), integral.difference,
        integral.evaluations, integral.levels, integral.reason == lib.AUR_INTEGRATE_TOLERANCE,
        _REASONS[integral.reason], tuple(name for bit, name in enumerate(_DOUBTS) if integral.doubts >> bit & 1),
        integral.resolution, integral.resolution_degrees,
    )  # fmt: skip


class Average(NamedTuple):
    value: Any
    error: Any  #: half the width of the interval about the value; of a symmetric rule the change from a smaller one
    evaluations: int


def average(
    f: Callable[..., Any], n: int, domain: Domain = "sphere", *, set: Optional[str] = None, copies: int = 16,
    dimension: int = 0, cap: float = 0.0, exponent: float = 0.0, axis: Optional[tuple[float, float]] = None,
    symmetry: Optional[str] = None, confidence: float = 0.95, seed: Seed = 0, progress: Optional[Progress] = None,
) -> Average:  # fmt: skip
    """The mean of a function over a domain and its error, by `copies` of one set of `n` points, each moved at random.

    Sets of directions and rotations are turned; on the sphere and for axes their weights are exact to a degree that they have
    with room to spare. Other sets are Owen-scrambled, or shifted. `set`: default "spherical-fibonacci" for sphere and axes,
    "super-fibonacci" for rotations, "sobol" elsewhere. Other parameters as for `integrate`.

    `symmetry`: of a smooth function on the sphere, by one symmetric rule of at most n points and one of a quarter of them,
    whose difference is the error.

    >>> found = average(lambda u: np.exp(-3 * u[:, 0] ** 2), 500, "axes")
    >>> abs(found.value - 0.50434356) < 3 * found.error + 1e-8
    True
    """
    n, copies = operator.index(n), operator.index(copies)  # NumPy's integers overflow
    if n < 1:
        raise ArgumentError(f"a set must have 1 point or more, not {n}")
    if symmetry is not None:
        if domain != "sphere" or set is not None or cap or axis is not None:
            raise UnsupportedError("a symmetry is for the whole sphere, and has its own set")
        try:
            rules = [symmetric_rule(max(k, 1), symmetry) for k in (n // 4, n)]
        except ArgumentError as error:
            raise ArgumentError(f"the error comes from a rule of n // 4 = {n // 4} points: {error}") from error
        (coarse, few, _), (value, many, equal) = (_symmetric(f, *rule) for rule in rules)
        return Average(value, np.full(np.shape(value), np.inf)[()] if equal else np.abs(value - coarse), few + many)
    if set is None:
        turned = axis is None and cap in (0.0, 180.0)
        set = {"sphere": "spherical-fibonacci", "axes": "spherical-fibonacci", "rotations": "super-fibonacci"}.get(
            domain if turned else "", "sobol"
        )
    integrand, integral, results = _integrate(
        f, domain, dimension, axis, (), progress, set, cap_degrees=cap, exponent=exponent, relative=0.0,
        confidence=confidence, replicates=copies, first=n, seed=seed, mean=True, evaluations=n * copies,
    )  # fmt: skip
    return Average(integrand.shaped(results[:, 0]), integrand.widths(results[:, 2]), integral.evaluations)


class Estimate(NamedTuple):
    value: Array  #: (values,), the mean over the randomisations
    error: Array  #: (values,), its standard error
    half_width: Array  #: (values,), of Student's interval; infinite where all randomisations are equal
    evaluations: int
    levels: int
    converged: bool
    resolution: float = 0.0  #: a feature of this share of the cube has been seen with 95 % probability; smaller ones may not


def estimate(
    f: Callable[[Array, Array], Any], dimension: int, values: int = 1, *, set: str = "sobol", tol: float = 0.01,
    absolute: float = 0.0, confidence: float = 0.95, replicates: int = 16, first: int = 0, evaluations: int = 2**20,
    seed: Seed = 0, progress: Optional[Progress] = None,
) -> Estimate:  # fmt: skip
    """Any functional of points with weights, by independent randomisations of the points, with its interval.

    Parameters
    ----------
    f : called with points (n, dimension) in [0, 1) and weights (n,) of sum 1; returns `values` numbers, of which the
        first is held against the error wanted. The arrays are the function's own: it may keep them.
    set : of `dimension` dimensions. Nets in base 2 are Owen-scrambled, other sets shifted modulo 1.
    tol, absolute : the half width wanted, relative and absolute; both 0: one level of all points.
    confidence, replicates, first, evaluations : of the intervals; randomisations, 4 to 64; points of a randomisation on
        the first level (0: 128), each level having twice as many; points at most, of all.

    Where features are small, `integrate` is safer: it sees the values of a function, and takes more points by default.

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
        call.category = IntegrationWarning
        call.attach(options)
        core.call(
            lib.aur_estimate, lib.aureole_functional, call.handle, options, core.output(results, "aur_estimated"),
            report,
        )  # fmt: skip
    value, error, half_width = results.T
    return Estimate(value, error, half_width, report.evaluations, report.levels, report.reached, report.resolution)

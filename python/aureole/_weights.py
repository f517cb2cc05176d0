"""Quadrature weights: optimal ones, exact ones, and the worst-case errors of any."""

from __future__ import annotations

from typing import Any, Callable, Literal, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from ._bridge import ArgumentError, Progress, Rebuilt, encode, rows, vector
from ._core import CoreCall, core, ffi, lib
from ._measures import weights_voronoi
from ._points import Array, Density, Domain, Map, Scramble, directions_options, domain_of, parse_lobe, parse_symmetry


class Potential(Rebuilt):
    """A density on the sphere for integrands of one smoothness: what worst-case errors and optimal weights are made of.

    Parameters
    ----------
    lobe : "uniform", "cosine", "phong:M" or "ggx:ALPHA[:VIEW_DEGREES]" about `axis`.
    domain : "hemisphere", or "sphere" for the uniform density on the whole sphere.
    smoothness : s of the integrand, in (1, 6), above 2 no nearer than .01 to an integer.
    axis : of the lobe, a unit vector; None: +z.
    clipped : only the part above the surface, z > 0.
    function : any density p(direction) >= 0 in the place of a lobe: called with an array (3,). `exponent` is that of the
        lobe about the axis that its nodes are drawn from, which must cover it; whole_sphere: from the whole sphere.
    nodes, masses : point masses in the place of a lobe, (n, 3) and (n,).

    Everywhere p is normalised to integral 1. Marques 2018 eqs 3, 10 and 12; Brauchart, Saff, Sloan, Womersley 2014.

    >>> round(Potential("cosine").mass, 6)
    3.141593
    """

    def __init__(
        self, lobe: str = "uniform", *, domain: Literal["hemisphere", "sphere"] = "hemisphere", smoothness: float = 1.5,
        axis: Optional[ArrayLike] = None, clipped: bool = False,
        function: Optional[Callable[[Array], float]] = None, exponent: float = 0.0, whole_sphere: bool = False,
        nodes: Optional[ArrayLike] = None, masses: Optional[ArrayLike] = None,
    ):  # fmt: skip
        density = ffi.new("aur_density *")
        core.initialize(density, lib.aur_density_init)
        self._call = CoreCall(function=function and (lambda xyz: [float(function(u)) for u in xyz]))
        if function is not None:
            density.kind = lib.AUR_DENSITY_FUNCTION
            core.fill(density, function=lib.aureole_density, user=self._call.handle, exponent=exponent)
            density.whole_sphere = whole_sphere
        elif nodes is not None:
            points = rows(nodes, 3, "nodes")
            mass = vector(np.ones(len(points)) if masses is None else masses, len(points), "masses")
            density.kind = lib.AUR_DENSITY_NODES
            core.fill(density, node_count=len(points), nodes=core.input(points), masses=core.input(mass))
        else:
            core.call(lib.aur_density_from_lobe, parse_lobe(lobe), core.value("domain", domain), density)
            density.clipped = clipped
        if axis is not None:
            density.axis = vector(axis, 3, "axis").tolist()
        with self._call:
            pointer = ffi.new("aur_potential **")
            core.call(lib.aur_potential_create, density, smoothness, pointer)
            self._potential = core.own("potential", pointer)

    @property
    def smoothness(self) -> float:
        return lib.aur_potential_smoothness(self._potential)

    @property
    def mass(self) -> float:
        """The integral of the density as it is written, in steradians for lobes of cosines and the sphere."""
        return lib.aur_potential_mass(self._potential)

    @property
    def self_energy(self) -> float:
        """V, the integral of z p (Marques 2018 eq. 10)."""
        return lib.aur_potential_self_energy(self._potential)

    def density(self, xyz: ArrayLike) -> Array:
        """p at unit vectors (n, 3), in 1/steradian, (n,)."""
        array = rows(xyz, 3, "xyz")
        values = np.empty(len(array))
        with self._call:
            core.call(lib.aur_potential_density, self._potential, len(array), core.input(array), core.output(values))
        return values

    def evaluate(self, xyz: ArrayLike) -> Array:
        """z at unit vectors (n, 3), (n,): the integral of the kernel times p (Marques 2018 eq. 12)."""
        array = rows(xyz, 3, "xyz")
        z = np.empty(len(array))
        lib.aur_potential_evaluate(self._potential, len(array), core.input(array), core.output(z))
        return z


def worst_case_error(
    xyz: ArrayLike, weights: Optional[ArrayLike] = None, potential: Union[Potential, str] = "uniform", *,
    domain: Optional[Domain] = None, smoothness: float = 1.5, threads: int = 0, progress: Optional[Progress] = None,
) -> float:  # fmt: skip
    """The largest error of sum w_i f(u_i) over functions f of norm 1 (Marques 2018 eq. 9).

    `xyz` (n, 3), `weights` (n,) or None for 1/n; `potential` a Potential, or a lobe for the domain and the smoothness.

    >>> round(worst_case_error(points("spherical-fibonacci", 256, domain="sphere"), domain="sphere"), 5)
    0.01411
    """
    array = rows(xyz, 3, "xyz")
    mass = None if weights is None else vector(weights, len(array), "weights")
    of = _potential(array, potential, domain, smoothness)
    value = ffi.new("double *")
    with CoreCall(progress) as call:
        core.call(
            lib.aur_worst_case_error, len(array), core.input(array), ffi.NULL if mass is None else core.input(mass),
            of._potential, call.attach(core.options("worst_case_options", threads=threads), warnings=False), value,
        )  # fmt: skip
    return value[0]


def _potential(array: Array, given: Union[Potential, str], domain: Optional[str], smoothness: float) -> Potential:
    if isinstance(given, Potential):
        return given
    return Potential(given, domain=domain or domain_of(array), smoothness=smoothness)  # type: ignore[arg-type]


class Report(NamedTuple):
    """What weights gain. Of optimal weights errors are worst-case errors, of exact ones those to the degree."""

    equal_error: float  #: with equal weights
    optimal_error: float  #: with the weights found
    weight_sum: float
    visible: int  #: samples that take part


class ExactReport(NamedTuple):
    degree: int
    residual: float  #: the worst error among functions of mean square 1 to the degree
    least: float  #: weight times `points`
    largest: float
    points: int  #: how many were weighed
    distinct_points: int  #: among them: coincident points count once
    iterations: int  #: of conjugate gradients; 0: solved by a factorisation

    @property
    def places(self) -> int:
        """`distinct_points` as version 0.1 named it; to be removed in the next version."""
        return self.distinct_points


def weights(
    xyz: ArrayLike, method: Literal["optimal", "exact", "voronoi"] = "optimal", *, domain: Optional[Domain] = None,
    lobe: str = "uniform", cap: float = 0.0, smoothness: float = 1.5, degree: Optional[int] = None,
    near: Optional[ArrayLike] = None, negative: bool = False, regularization: float = 1e-6,
    sum_constraint: bool = True, threads: int = 0, symmetry: Optional[str] = None,
) -> Array:  # fmt: skip
    """Weights (n,) of sum 1 for unit vectors (n, 3): for integrals against the lobe normalised to integral 1.

    Exact ones also for points of square, disk and cube and for rotations.

    Parameters
    ----------
    method : "optimal": those of the smallest worst-case error (Marques 2018 eq. 14); "exact": the nearest to equal ones
        that integrate polynomials to a degree without error; "voronoi": the areas of Voronoi cells.
    domain : "sphere", "hemisphere" or "axes", whose weights are for even functions; None: what the array is known to be
        of (see `measure`).
    lobe : as for `points`; but a GGX lobe is here what the surface reflects, D G2 cos above the horizon normalised to 1,
        not the density of visible normals that points follow. Points below the horizon have weight 0.
    cap : degrees; not 0: the points are on the cap of that polar angle. Not for optimal weights.
    smoothness, regularization, sum_constraint : of optimal weights.
    degree, near, negative, symmetry : of exact weights: see `weights_exact`.

    Multiply by the area (4 pi, 2 pi, ...) for integrals over solid angle.

    >>> xyz = points("spherical-fibonacci", 100, domain="hemisphere")
    >>> w = weights(xyz, lobe="cosine")
    >>> w.shape, round(float(w.sum()), 6)
    ((100,), 1.0)
    """
    array = rows(xyz, 0 if method == "exact" else 3, "xyz")
    where: Domain = domain or domain_of(array)
    if method == "exact":
        return weights_exact(
            array, degree, domain=where, lobe=lobe, cap=cap, near=near, negative=negative, threads=threads,
            symmetry=symmetry,
        )[0]  # fmt: skip
    if symmetry is not None:
        raise ArgumentError("symmetry is for method='exact'")
    if method == "voronoi":
        return weights_voronoi(array, domain=where, lobe=lobe, cap=cap, threads=threads)
    if method != "optimal":
        raise ArgumentError(f"method must be 'optimal', 'exact' or 'voronoi', not {method!r}")
    if cap:
        raise ArgumentError("optimal weights are for whole domains, not for caps")
    if where == "axes":  # both ends of each, with half of its weight
        whole = Potential(lobe, domain="sphere", smoothness=smoothness)
        ends = np.concatenate([array, -array])
        found = weights_solve(ends, [whole], regularization=regularization, sum_constraint=sum_constraint)[0][0]
        return found[: len(array)] + found[len(array) :]
    potential = _potential(array, lobe, where, smoothness)
    return weights_solve(array, [potential], regularization=regularization, sum_constraint=sum_constraint)[0][0]


def weights_solve(
    xyz: ArrayLike, potentials: Sequence[Potential], *, regularization: float = 1e-6, sum_constraint: bool = True
) -> tuple[Array, list[Report], float]:
    """Optimal weights of one set of samples (n, 3) for several densities of one smoothness (Marques 2018 eq. 14).

    Returns the weights (densities, n), a report for each density, and an estimate of the condition number of the system.
    O(n^3) time.
    """
    array = rows(xyz, 3, "xyz")
    options = ffi.new("aur_weights_options *")
    core.initialize(options, lib.aur_weights_options_init)
    core.fill(options, regularization=regularization, sum_constraint=sum_constraint)
    found = np.empty((len(potentials), len(array)))
    reports = ffi.new("aur_weights_report[]", max(1, len(potentials)))
    condition = ffi.new("double *")
    core.call(
        lib.aur_weights_solve, len(array), core.input(array), len(potentials),
        ffi.new("aur_potential *[]", [potential._potential for potential in potentials]), options, found.size,
        core.output(found), reports, condition,
    )  # fmt: skip
    described = [
        Report(report.equal_error, report.optimal_error, report.weight_sum, report.visible)
        for report in reports[0 : len(potentials)]
    ]
    return found, described, condition[0]


def _exact_report(report: Any) -> ExactReport:
    return ExactReport(*(getattr(report, name) for name in ExactReport._fields))


def _exact_options(
    call: CoreCall, array: Array, domain: Optional[str], degree: Optional[int], lobe: str, cap: float,
    near: Optional[ArrayLike], negative: bool, threads: int, tolerance: float, symmetry: Optional[str],
) -> tuple[Any, Any]:  # fmt: skip
    options = ffi.new("aur_exact_options *")
    where = domain or domain_of(array)
    columns = {"square": 2, "disk": 2, "rotations": 4, "cube": array.shape[1]}.get(where, 3)
    if array.shape[1] != columns:
        raise ArgumentError(f"points of the domain {where!r} must have the shape (n, {columns}), not {array.shape}")
    core.initialize(options, lib.aur_exact_options_init, core.value("domain", where))
    core.fill(
        options, cap_degrees=cap, lobe=parse_lobe(lobe)[0], negative=negative, threads=threads,
        tolerance=tolerance, dimension=array.shape[1],
    )  # fmt: skip
    group, crystal, sample = parse_symmetry(symmetry, where)
    core.fill(options, crystal=crystal, sample=sample, group=ffi.NULL if group is None else group)
    if degree is not None:
        core.fill(options, degree=degree)
    mass = None if near is None else vector(near, len(array), "near")
    if mass is not None:
        options.near = core.input(mass)
    return call.attach(options, warnings=False), (mass, group)


def weights_exact(
    xyz: ArrayLike, degree: Optional[int] = None, *, domain: Optional[Domain] = None, lobe: str = "uniform",
    cap: float = 0.0, near: Optional[ArrayLike] = None, negative: bool = False, threads: int = 0,
    progress: Optional[Progress] = None, tolerance: float = 0.0, symmetry: Optional[str] = None,
) -> tuple[Array, ExactReport]:  # fmt: skip
    """Of all weights (n,) that integrate polynomials to a degree without error, the nearest to equal ones.

    `xyz`: unit vectors (n, 3); points of square, disk or cube (n, d), of a total degree in the coordinates; or rotations
    (n, 4), of Wigner functions. `symmetry`: only for functions that have it; of directions of the sphere a point group
    ("D2h", "Oh"), of rotations "CRYSTAL" or "CRYSTAL:SAMPLE" ("432:222").
    `degree`: 0 to 1500; None: the largest that keeps every weight positive. `near`: the weights to stay near to, (n,).
    `negative`: a given degree may take negative weights. `domain` and `cap` as for `weights`. `tolerance`: the largest
    error of a polynomial of mean square 1, for more than 2048 points; 0: 1e-14.

    >>> w, report = weights_exact(points("spherical-fibonacci", 200, domain="sphere"))
    >>> report.degree, report.points
    (13, 200)
    """
    array = rows(xyz, 0, "xyz")
    found = np.empty(len(array))
    report = ffi.new("aur_exact_report *")
    with CoreCall(progress) as call:
        options, _alive = _exact_options(
            call, array, domain, degree, lobe, cap, near, negative, threads, tolerance, symmetry
        )
        core.call(
            lib.aur_weights_exact, len(array), core.input(array), options, len(array), core.output(found), report
        )
    return found, _exact_report(report)


def weights_nested(
    xyz: ArrayLike, counts: Sequence[int], degree: Optional[int] = None, *, domain: Optional[Domain] = None,
    lobe: str = "uniform", cap: float = 0.0, near: Optional[ArrayLike] = None, negative: bool = False,
    threads: int = 0, tolerance: float = 0.0, symmetry: Optional[str] = None,
) -> tuple[Array, list[ExactReport]]:  # fmt: skip
    """Exact weights for the first counts[k] points of a set, (levels, n), 0 behind them; and a report for each level.

    One function value a point gives an integral for every level; differences of neighbours estimate the error.
    """
    array = rows(xyz, 0, "xyz")
    try:
        numbers = ffi.new("size_t[]", list(counts))
    except OverflowError as error:
        raise ArgumentError(f"counts: {list(counts)} are out of range") from error
    found = np.empty((len(counts), len(array)))
    reports = ffi.new("aur_exact_report[]", max(1, len(counts)))
    with CoreCall() as call:
        options, _alive = _exact_options(
            call, array, domain, degree, lobe, cap, near, negative, threads, tolerance, symmetry
        )
        core.call(
            lib.aur_weights_nested, len(array), core.input(array), len(counts), numbers,
            options, found.size, core.output(found), reports,
        )  # fmt: skip
    return found, [_exact_report(report) for report in reports[0 : len(counts)]]


def rule(
    set: str = "spherical-fibonacci", n: int = 64, *, domain: Literal["hemisphere", "sphere"] = "hemisphere",
    lobe: str = "cosine", density: Density = "same", optimal: bool = False, smoothness: float = 1.5,
    map: Map = "lambert", scramble: Scramble = "none", seed: int = 0, regularization: float = 1e-6,
    sum_constraint: bool = True,
) -> tuple[Array, Array]:  # fmt: skip
    """Directions (n, 3) with their weights (n,) in one call, for integrals against the lobe normalised to 1.

    Parameters as for `points` and `weights`. `optimal`: optimal weights; else equal ones, or p/q where points do not
    follow the lobe itself. A GGX lobe is the density of visible normals, whose mass below the horizon has weight 0 so
    that the weights add up to less than 1; with `optimal` it is D G2 cos normalised to 1, as for `weights`.

    >>> xyz, w = rule("spherical-fibonacci", 64, lobe="cosine")
    >>> round(float(w @ xyz[:, 2]), 3)  # the mean of cos theta against cos theta/pi is 2/3
    0.667
    """
    with CoreCall() as call:
        points = directions_options(call, n, domain, map, lobe, density, smoothness, 0.0, scramble, seed)
        weighing = ffi.new("aur_weights_options *")
        core.initialize(weighing, lib.aur_weights_options_init)
        core.fill(weighing, regularization=regularization, sum_constraint=sum_constraint)
        name = ffi.new("char[]", encode(set))
        options = ffi.new("aur_rule_options *")
        core.initialize(options, lib.aur_rule_options_init, points)
        core.fill(options, set=name, optimal=optimal, weights=weighing)
        xyz, found = np.empty((n, 3)), np.empty(n)
        core.call(lib.aur_rule_make, options, xyz.size, core.output(xyz), core.output(found))
    return xyz, found

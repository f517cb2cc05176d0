"""Figures of merit of points, the nearest of them, and weights of theirs."""

from __future__ import annotations

from typing import Iterable, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._bridge import Progress, Rebuilt, Seed, encode, rows, vector, view_of
from ._core import CoreCall, core, ffi, lib
from ._points import Array, Domain, View, domain_of, parse_lobe

Series = dict[str, Array]


def _measure_options(
    call: CoreCall, threads: int = 0, fast: bool = False, seed: Seed = 0, accuracy: float = 0.0, cap: float = 0.0
) -> object:
    options = core.options(
        "measure_options", threads=threads, fast=fast, seed=seed, accuracy=accuracy, cap_degrees=cap
    )
    return call.attach(options)


@overload
def measure(  # type: ignore[overload-overlap]  # a text is an Iterable of texts too, but comes first
    points: ArrayLike, names: str, *, weights: Optional[ArrayLike] = ..., domain: Optional[Domain] = ...,
    cap: float = ..., fast: bool = ..., accuracy: float = ..., seed: Seed = ..., threads: int = ...,
    progress: Optional[Progress] = ...,
) -> Union[float, Series]: ...  # fmt: skip
@overload
def measure(
    points: ArrayLike, names: Iterable[str], *, weights: Optional[ArrayLike] = ..., domain: Optional[Domain] = ...,
    cap: float = ..., fast: bool = ..., accuracy: float = ..., seed: Seed = ..., threads: int = ...,
    progress: Optional[Progress] = ...,
) -> dict[str, Union[float, Series]]: ...  # fmt: skip
def measure(
    points: ArrayLike, names: Union[str, Iterable[str]], *, weights: Optional[ArrayLike] = None,
    domain: Optional[Domain] = None, cap: float = 0.0, fast: bool = False, accuracy: float = 0.0, seed: Seed = 0,
    threads: int = 0, progress: Optional[Progress] = None,
) -> Union[float, Series, dict[str, Union[float, Series]]]:  # fmt: skip
    """How even points are: one measure of `measures()`, or several.

    Parameters
    ----------
    points : (n, d), one point a row: (n, 2) on square and disk, (n, 3) unit vectors, (n, 4) unit quaternions w, x, y, z.
    names : NAME[:PARAMETER], or several of them.
    weights : (n,), masses that are divided by their sum (but for wce); None: 1/n each.
    domain : None: that of an array that `points` or `read` returned. Of others: "square" for two columns; "sphere" for
        unit vectors, or "hemisphere", with a warning, where none has z < 0; "rotations" for four columns of unit length;
        "cube" for all others.
    cap : degrees; not 0: the points are on the cap of this polar angle about +z.
    fast : sums over pairs to 2e-14 relative instead of the last bit.
    accuracy : relative error allowed to energies of many points, which are done sooner then; 0: none but rounding.
    seed : of the measures that search at random.
    threads : 0: all. No bit depends on it.
    progress : called as progress(what, done, total) now and then; something true stops the work with CancelledError.

    Returns
    -------
    For one name a float (distances are chords, angles radians), or for a measure that is a table a dict from the
    names of its columns to arrays; for several names a dict of these.

    >>> xyz = points("spherical-fibonacci", 1024, domain="sphere")
    >>> round(measure(xyz, "energy"), 8)
    0.00498051
    >>> {name: round(value, 6) for name, value in measure(xyz, ["min-distance", "covering"]).items()}
    {'min-distance': 0.096622, 'covering': 0.08526}
    """
    with View(points, weights, domain) as view:
        with CoreCall(progress) as call:
            options = _measure_options(call, threads, fast, seed, accuracy, cap)
            if isinstance(names, str):
                return _measure(names, view, options)
            return {name: _measure(name, view, options) for name in names}


def _measure(name: str, view: object, options: object) -> Union[float, Series]:
    row = ffi.new("const aur_measure_description **")
    core.call(lib.aur_measure_find, encode(name), row)
    if not row[0].series:
        value = ffi.new("double *")
        core.call(lib.aur_measure, encode(name), view, options, value)
        return value[0]
    pointer = ffi.new("aur_series **")
    core.call(lib.aur_measure_series, encode(name), view, options, pointer)
    series = core.own("series", pointer)
    shape = lib.aur_series_row_count(series), lib.aur_series_column_count(series)
    table = view_of(core, series, lib.aur_series_values(series), shape)
    return {core.text(lib.aur_series_column(series, column)) or "": table[:, column] for column in range(shape[1])}


class Nearest(Rebuilt):
    """A tree over points of any domain, for queries in batches. `domain` as for `measure`.

    >>> xyz = points("spherical-fibonacci", 1000, domain="sphere")
    >>> indices, angles = Nearest(xyz).find([[0, 0, 1.0]], 2)
    >>> indices
    array([[0, 1]], dtype=uint64)
    """

    def __init__(self, points: ArrayLike, *, domain: Optional[Domain] = None):
        looked = View(points, None, domain)
        self._arguments = (looked.array.copy(),), {"domain": looked.domain}  # the caller's array may change
        with looked as view:
            self._dimension = view.dimension
            self._tree = core.make("nearest", view)

    def __repr__(self) -> str:
        return f"<Nearest of {len(self._arguments[0][0])} points, domain {self._arguments[1]['domain']!r}>"

    def find(
        self, queries: ArrayLike, neighbours: int = 1, *, threads: int = 0, progress: Optional[Progress] = None
    ) -> tuple[NDArray[np.uint64], Array]:
        """Indices and distances (q, neighbours) of the points nearest to each of the queries (q, d).

        Nearest first, of equally near ones the smaller index first. Distances are angles in radians where the points
        are directions, axes or rotations.
        """
        query_rows = rows(queries, self._dimension, "queries")
        shape = len(query_rows), max(1, neighbours)
        indices, distances = np.empty(shape, dtype=np.uint64), np.empty(shape)
        with CoreCall(progress) as call:
            options = call.attach(
                core.options("nearest_options", neighbours=neighbours, threads=threads), warnings=False
            )
            core.call(
                lib.aur_nearest_find, self._tree, options, len(query_rows), core.input(query_rows),
                core.output(indices, "size_t"), core.output(distances),
            )  # fmt: skip
        return indices, distances


def weights_voronoi(
    xyz: ArrayLike, *, domain: Optional[Domain] = None, lobe: str = "uniform", cap: float = 0.0, threads: int = 0
) -> Array:
    """Weights (n,) of unit vectors (n, 3): the areas of their Voronoi cells times the lobe there, of sum 1.

    They are exact for functions that are constant within each cell. `domain`: sphere, hemisphere or axes, as for
    `measure`.
    """
    array = rows(xyz, 3, "xyz")
    weights = np.empty(len(array))
    with CoreCall() as call:
        core.call(
            lib.aur_weights_voronoi, len(array), core.input(array), core.value("domain", domain or domain_of(array)),
            parse_lobe(lobe), _measure_options(call, threads=threads, cap=cap), len(array), core.output(weights),
        )  # fmt: skip
    return weights


def student_quantile(degrees: int, probability: float) -> float:
    """The quantile t with P(T < t) = probability for Student's t with `degrees` >= 1 degrees of freedom.

    >>> round(student_quantile(7, 0.975), 6)
    2.364624
    """
    return lib.aur_student_quantile(degrees, probability)

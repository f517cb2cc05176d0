"""Points of any set on any domain, at once or any part of them; files of points."""

from __future__ import annotations

import operator
import os
import warnings
from typing import Any, Callable, Iterator, Literal, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._bridge import (
    ArgumentError, AureoleWarning, Rebuilt, Seed, UnsupportedError, as_array, encode, seed_number, vector, view_domain,
    view_of,
)  # fmt: skip
from ._core import CoreCall, core, ffi, lib

Array = NDArray[np.float64]
Domain = Literal["square", "cube", "disk", "hemisphere", "sphere", "axes", "rotations"]
Map = Literal["lambert", "concentric", "azimuthal", "polar"]
Scramble = Literal["none", "digit", "owen", "shift", "rotate", "rotate3d", "nested"]
Density = Literal["same", "optimal"]


def parse_lobe(lobe: str) -> Any:
    """The library's lobe of a text "uniform", "cosine", "phong:M" or "ggx:ALPHA[:VIEW_DEGREES]"."""
    parsed = ffi.new("aur_lobe *")
    core.call(lib.aur_lobe_parse, encode(lobe), parsed)
    return parsed


def parse_symmetry(symmetry: Optional[str], domain: str) -> tuple[Any, int, int]:
    """The point group of directions, or None, and the symmetries of crystal and sample of rotations."""
    if symmetry is None:
        return None, 0, 0
    if domain == "rotations":
        crystal, _, sample = symmetry.partition(":")
        return None, core.value("symmetry", crystal), core.value("symmetry", sample if ":" in symmetry else "1")
    if domain != "sphere":
        raise UnsupportedError(f"a symmetry is for the sphere and rotations, not for the domain {domain!r}")
    group = ffi.new("aur_point_group *")
    core.call(lib.aur_point_group_from_name, encode(symmetry), group)
    return group, 0, 0


def _select(found: Array, weights: Optional[Array], symmetry: str, domain: str) -> tuple[Array, Array]:
    """Points in the fundamental region, in the first rows of their array, with the weights of their orbits."""
    group, crystal, _ = parse_symmetry(symmetry, domain)
    array, mass = np.array(found), np.ones(len(found)) if weights is None else np.array(weights)
    if group is None:
        count = lib.aur_symmetry_select(crystal, len(array), core.output(array))
    else:
        count = lib.aur_point_group_select(group, len(array), core.output(array), core.output(mass))
    if count == 0:
        raise ArgumentError(f"none of the {len(found)} points is in the fundamental region: take more")
    total = mass[:count].sum()
    if weights is not None and (group is None or abs(total - 1.0) > 1e-9):
        raise ArgumentError(f"the set has weights and not this symmetry: those of the region add up to {total:.6g}")
    found[:count] = array[:count]
    return found[:count], mass[:count] / total


def directions_options(
    call: CoreCall, n: int, domain: str, map: str, lobe: str, density: str, smoothness: float, cap: float,
    scramble: str, seed: Seed,
) -> Any:  # fmt: skip
    if density not in ("same", "optimal"):
        raise ArgumentError(f"density must be 'same' or 'optimal', not {density!r}")
    options = ffi.new("aur_directions_options *")
    core.initialize(options, lib.aur_directions_options_init, 0, core.value("domain", domain))
    core.fill(
        options, count=n, map=core.value("map", map), lobe=parse_lobe(lobe)[0], optimal_density=density == "optimal",
        smoothness=smoothness, cap_degrees=cap, scramble=core.value("scramble", scramble), seed=seed,
    )  # fmt: skip
    return call.attach(options, progress=False)


def contents(owner: Any) -> tuple[Array, Optional[Array], str]:
    """The library's points as they lie there, their weights or None, and their domain."""
    view = lib.aur_points_get_view(owner)
    stride = 8 * (view.stride or view.dimension)
    domain = core.text(lib.aur_domain_name(view.domain)) or ""
    points = view_of(core, owner, view.coordinates, (view.count, view.dimension), strides=(stride, 8), domain=domain)
    weights = None if view.weights == ffi.NULL else view_of(core, owner, view.weights, (view.count,))
    return points, weights, domain


@overload
def points(
    set: str, n: int = ..., *, domain: Optional[Domain] = ..., dimension: int = ..., map: Map = ..., lobe: str = ...,
    density: Density = ..., smoothness: float = ..., cap: float = ..., scramble: Scramble = ..., seed: Seed = ...,
    first: int = ..., count: int = ..., weights: Literal[False] = ..., out: Any = ..., dtype: DTypeLike = ...,
    symmetry: Optional[str] = ...,
) -> np.ndarray: ...  # fmt: skip
@overload
def points(
    set: str, n: int = ..., *, domain: Optional[Domain] = ..., dimension: int = ..., map: Map = ..., lobe: str = ...,
    density: Density = ..., smoothness: float = ..., cap: float = ..., scramble: Scramble = ..., seed: Seed = ...,
    first: int = ..., count: int = ..., weights: Literal[True], out: Any = ..., dtype: DTypeLike = ...,
    symmetry: Optional[str] = ...,
) -> tuple[np.ndarray, Array]: ...  # fmt: skip
def points(
    set: str, n: int = 0, *, domain: Optional[Domain] = None, dimension: int = 0, map: Map = "lambert",
    lobe: str = "uniform", density: Density = "same", smoothness: float = 1.5, cap: float = 0.0,
    scramble: Scramble = "none", seed: Seed = 0, first: int = 0, count: int = 0, weights: bool = False,
    out: Any = None, dtype: DTypeLike = np.float64, symmetry: Optional[str] = None,
) -> Union[np.ndarray, tuple[np.ndarray, Array]]:  # fmt: skip
    """Points of a set, one a row.

    Parameters
    ----------
    set : NAME[:key=value,...] or file:PATH. `sets()` lists the names and keys.
    n : points of the set; 0 for a file: all of its points.
    domain : where the points are; None: where the set has them by itself. Shapes of the result: square and disk (n, 2);
        cube (n, dimension); hemisphere, sphere and axes (n, 3), unit vectors with z up; rotations (n, 4), unit
        quaternions w, x, y, z. Square and cube are [0, 1)^d.
    dimension : of the cube, and 2 for the square; 0: 2, or what the set has.
    map : how sets of the square come to other domains. "lambert" (the cylindrical equal-area map), "concentric"
        (Shirley, Chiu 1997), "azimuthal" and "polar" (Schretter 2012).
    lobe : what points of the whole hemisphere follow: "uniform", "cosine", "phong:M" (cos^M of the polar angle, M from
        0 to 1e9), "visible:ALPHA[:VIEW_DEGREES]" (Dupuy, Benyoub 2023; alpha from 1e-4 to 1): reflections by the visible
        normals of a GGX surface, some of which are below the horizon, z < 0 (14 % of "visible:0.4:30", 45 % of
        "visible:0.9:0"); an AureoleWarning says how many. "ggx:ALPHA[:VIEW_DEGREES]", the reflected light, has these points.
    density : "same": points follow the lobe; "optimal": its power 2/(s+1), with weights (Marques 2018).
    smoothness : s of the optimal density, in (1, 6).
    cap : degrees; not 0: the points fill the cap of this polar angle about +z.
    scramble : "digit" (Kollig, Keller 2002), "owen" (by a hash: Burley 2020), "nested" (Owen 1995), "shift" (Cranley,
        Patterson 1976), "rotate" (about z),
        "rotate3d" (a uniformly random rotation).
    seed : of scrambling and of random sets: an integer from 0, the same points for the same one; None or a generator
        of NumPy's for other points in each call. The default is 0, so that two calls give the same points.
    first, count : the part of the set that is wanted; count 0: all from `first` on.
    weights : whether to return also the weights, (n,): 1/n each where the density is the lobe itself.
    out : an array to write the points into and to return, of float64 or float32 and any strides.
    symmetry : only one point of each orbit, with its weight: of directions of the sphere a point group ("D2h", "Oh"), of
        rotations a crystal's group ("432").
    dtype : float64 or float32, where there is no `out`. Of square and cube float32 are the doubles cut to 24 binary digits.

    Returns
    -------
    An array, or a pair of it and the weights. Without `out` arrays of float64 are the library's own, without a copy.

    >>> points("hammersley", 4)
    array([[0.  , 0.  ],
           [0.25, 0.5 ],
           [0.5 , 0.25],
           [0.75, 0.75]])
    >>> points("spherical-fibonacci", 1000, domain="sphere").shape
    (1000, 3)
    >>> xyz, w = points("sobol", 64, domain="hemisphere", lobe="phong:20", density="optimal", weights=True)
    >>> xyz.shape, w.shape
    ((64, 3), (64,))
    """
    with CoreCall() as call:
        options = directions_options(
            call, n, domain or "square", map, lobe, density, smoothness, cap, scramble, seed
        )  # fmt: skip
        request = ffi.new("aur_points_request *")
        core.initialize(request, lib.aur_points_request_init, options)
        core.fill(request, natural_domain=domain is None, dimension=dimension, first=first, count=count)
        pointer = ffi.new("aur_points **")
        core.call(lib.aur_points_generate, encode(set), request, pointer)
        found, found_weights, of = contents(core.own("points", pointer))
    mass = np.full(len(found), 1.0 / len(found)) if found_weights is None and weights else found_weights
    below = int((found[:, 2] < 0.0).sum()) if of == "hemisphere" and lobe.startswith(("ggx", "visible")) else 0
    if below:
        warnings.warn(
            f"{below} of {len(found)} points lie below the horizon, where reflection is 0: integrals count them as 0",
            AureoleWarning, stacklevel=2,
        )  # fmt: skip
    if symmetry is not None:
        found, mass = _select(found, found_weights, symmetry, of)
    found = _deliver(found, out, dtype, cut=of in ("square", "cube"))
    return (found, mass) if weights else found


def read(path: Union[str, os.PathLike[str]], domain: Optional[Domain] = None) -> tuple[Array, Optional[Array], str]:
    """Points, their weights or None, and their domain from a CSV or NPY file.

    A comment "# domain: NAME" in the header gives the domain; `write` writes it. Without it the names in the header of
    a CSV file say it: u,v; x,y; x,y,z; w,x,y,z; u1,u2,...; and w or weight after it for weights. Without a header two columns
    are u,v and three x,y,z. If all directions have z >= 0, the hemisphere is assumed, with an AureoleWarning.
    `domain` says it where it is known.

    >>> import tempfile, os
    >>> path = os.path.join(tempfile.mkdtemp(), "points.csv")
    >>> write(path, points("hammersley", 2))
    >>> read(path)
    (array([[0. , 0. ],
           [0.5, 0.5]]), None, 'square')
    """
    pointer = ffi.new("aur_points **")
    if domain is None:
        core.call(lib.aur_points_read, encode(path), ffi.NULL, pointer)
        if lib.aur_points_get_view(pointer[0]).guessed:
            _warn(core.text(lib.aur_domain_name(lib.aur_points_get_view(pointer[0]).domain)) or "", os.fspath(path))
    else:
        core.call(lib.aur_points_read, encode(path), ffi.new("aur_domain *", core.value("domain", domain)), pointer)
    return contents(core.own("points", pointer))


def write(
    path: Union[str, os.PathLike[str]], points: ArrayLike, weights: Optional[ArrayLike] = None, *,
    domain: Optional[Domain] = None, format: Optional[Literal["csv", "json", "npy", "ply"]] = None,
) -> None:  # fmt: skip
    """Writes points, one a row, with weights if there are any; the file is replaced whole or not at all.

    `format` None: by the end of the file's name, and CSV where that says nothing. `domain` as for `measure`.
    """
    ending = os.path.splitext(os.fspath(path))[1][1:]
    name = format or (ending if ending in ("csv", "json", "npy", "ply") else "csv")
    with View(points, weights, domain) as view:
        core.call(lib.aur_points_write, encode(path), core.value("points_format", name), view, ffi.NULL)


class View:
    """The library's view of a caller's array, without a copy where rows of doubles lie apart evenly."""

    def __init__(self, points: ArrayLike, weights: Optional[ArrayLike] = None, domain: Optional[Domain] = None):
        array = as_array(points)
        if array.ndim == 1:
            array = array[:, np.newaxis]
        if array.ndim != 2:
            raise ArgumentError(f"points must have the shape (n, d), not {array.shape}")
        row, column = array.strides
        if not array.flags.aligned or column != 8 or row < 8 * array.shape[1] or row % 8:
            array = np.ascontiguousarray(array)
        self.array = array
        self.domain = domain or domain_of(array)
        self.view = ffi.new("aur_points_view *")
        count, dimension = array.shape
        self.view[0] = lib.aur_points_view_of(
            core.value("domain", self.domain), count, dimension, core.input(array)
        )  # fmt: skip
        self.view.stride = array.strides[0] // 8 if count > 1 else dimension
        if weights is not None:
            self.weights = vector(weights, count, "weights")
            self.view.weights = core.input(self.weights)

    def __enter__(self) -> Any:
        return self.view

    def __exit__(self, *error: Any) -> None:
        pass


def _warn(domain: str, what: str = "points") -> None:
    warnings.warn(
        f"{what}: the domain of the points is not stated; assuming the {domain}: set domain=... "
        "(sphere, axes, cube, rotations)", AureoleWarning, stacklevel=4,
    )  # fmt: skip


def domain_of(array: NDArray[np.float64]) -> Domain:
    """The domain that an array of points is of where the caller does not say it.

    Arrays that `points` and `read` returned, and rows of them, know their domain. Of others two columns are of the
    square; three of unit length (to 1e-6) of the sphere, or of the hemisphere where no z is below 0; four of unit length
    are rotations; all others are of the cube. Where the numbers could be of another domain too, an AureoleWarning says so.
    """
    columns = array.shape[1]
    squares = np.einsum("ij,ij->i", array, array)
    unit = bool(len(array)) and bool(np.all(np.abs(squares - 1.0) < 2e-6))
    flat = bool(len(array)) and array.min() >= 0.0 and array.max() < 1.0
    above = columns == 3 and unit and array[:, 2].min() >= 0.0
    fits = {
        "square": columns == 2 and flat, "cube": flat, "disk": columns == 2 and bool(np.all(squares <= 1.0)),
        "hemisphere": above, "sphere": columns == 3 and unit, "axes": columns == 3 and unit,
        "rotations": columns == 4 and unit,
    }  # fmt: skip
    stored = view_domain(array)
    if stored is not None and fits[stored]:
        return stored  # type: ignore[return-value]
    if columns == 2:
        return "square"
    if columns not in (3, 4) or not len(array):
        return "cube"
    off = int(np.argmax(np.abs(squares - 1.0)))
    near = abs(squares[off] - 1.0) < 0.02
    if not unit and near and not flat:
        kind = "unit vectors" if columns == 3 else "unit quaternions"
        raise ArgumentError(
            f"points are {kind} to 1e-6, or lie in [0, 1)^{columns}: row {off} has the length {np.sqrt(squares[off]):.9g}"
        )
    found: Domain = "cube" if not unit else "rotations" if columns == 4 else "hemisphere" if above else "sphere"
    if above or (near and flat):
        _warn(found)
    return found


class _Rows(Rebuilt):
    """A set made ready as a sequence of its points: its length, its rows by index, and all of it as an array."""

    size: int
    dimension: int
    points: Callable[..., np.ndarray]

    def __len__(self) -> int:
        """At most 2^63 - 1, as of everything in Python; `size` has no bound."""
        return self.size

    def __getitem__(self, key: Any) -> Any:
        """Rows by an index, a slice or an array of indices, and coordinates of theirs after a comma, as of an array."""
        which, *columns = key if isinstance(key, tuple) else (key,)
        if isinstance(which, slice):
            first, stop, step = which.indices(self.size)
            count = len(range(first, stop, step))
            found = self.points(first, count) if step == 1 else self._rows(first + step * np.arange(count, dtype=object))
        elif np.ndim(which) == 0:
            found = self._rows(np.array([operator.index(which)], dtype=object))[0]
        else:
            found = self._rows(np.asarray(which, dtype=object))
        return found[(..., *columns)] if columns else found

    def _rows(self, indices: NDArray[Any]) -> np.ndarray:
        """Rows at any indices: runs of near ones are made at once."""
        if indices.ndim != 1:
            raise IndexError("indices must be an integer, a slice or a list of integers")
        rows = np.array([operator.index(i) + self.size * (i < 0) for i in indices], dtype=object)
        for row in rows[(rows < 0) | (rows >= self.size)][:1]:
            raise IndexError(f"point {row} is outside of the {self.size} points")
        found = np.empty((len(rows), self.dimension))
        order = np.argsort(rows, kind="stable")
        for run in np.split(order, np.flatnonzero(np.diff(rows[order]) > 64) + 1) if len(rows) else ():
            first = rows[run[0]]
            found[run] = self.points(first, rows[run[-1]] - first + 1)[(rows[run] - first).astype(np.intp)]
        return found

    def __iter__(self) -> Iterator[np.ndarray]:
        for first in range(0, self.size, 1024):
            yield from self.points(first, min(1024, self.size - first))

    def __array__(self, dtype: Optional[DTypeLike] = None, copy: Optional[bool] = None) -> np.ndarray:
        if copy is False:
            raise ValueError("points are computed on request: copy=False is not possible")
        return np.asarray(self.points(), dtype=dtype)


class PointSet(_Rows):
    """A set on the unit cube made ready: any part of it, in any order, into any array, from any thread.

    Parameters as for `points`; n must be given unless the set is a file. Rows are there by their indices too.

    >>> sobol = PointSet("sobol", 2**20, dimension=3, scramble="owen", seed=7)
    >>> len(sobol), sobol.dimension
    (1048576, 3)
    >>> part = sobol.points(1000, 64)
    >>> bool((part == sobol.points(0, 1064)[1000:]).all()), bool((part[::3, 1] == sobol[1000:1064:3, 1]).all())
    (True, True)
    """

    def __init__(self, set: str, n: int = 0, *, dimension: int = 0, scramble: Scramble = "none", seed: Seed = 0):
        with CoreCall() as call:
            options = core.options(
                "pointset_options", count=n, dimension=dimension, scramble=core.value("scramble", scramble),
                seed=self._reseed(seed),
            )  # fmt: skip
            self._set = core.make("pointset", encode(set), call.attach(options, progress=False))

    @property
    def size(self) -> int:  # type: ignore[override]
        """Points of the set."""
        return lib.aur_pointset_size(self._set)

    @property
    def dimension(self) -> int:  # type: ignore[override]
        """Coordinates a point."""
        return lib.aur_pointset_dimension(self._set)

    def points(  # type: ignore[override]
        self, first: int = 0, count: Optional[int] = None, *, dimensions: Optional[slice] = None,
        seed: Seed = None, out: Any = None, dtype: DTypeLike = np.float64,
    ) -> np.ndarray:  # fmt: skip
        """Points first .. first+count-1, (count, dimension), in [0, 1).

        `count` None: all from `first` on. `dimensions`: a slice, some of the coordinates alone. `seed`: another seed of
        the scrambling; None: the set's. `out`: an array of float64 or float32 to write into and to return; float32 are
        the doubles cut to 24 binary digits. Contiguous rows or columns of it are filled in their place, others by a copy.
        """
        low, high, step = (dimensions or slice(None)).indices(self.dimension)
        if step != 1:
            raise ArgumentError("dimensions must be a slice without a step")
        if seed is not None and dimensions is not None:
            raise ArgumentError("another seed gives all dimensions: slice what it returns")
        if count is None:
            count = max(0, self.size - first)

        def generate(output: Any) -> None:
            if seed is not None:
                core.call(lib.aur_pointset_randomize, self._set, seed_number(seed), first, count, output)
            else:
                core.call(lib.aur_pointset_coordinates, self._set, low, max(0, high - low), first, count, output)

        return write_into(count, max(0, high - low), out, dtype, generate)

    def coordinate(self, index: int, dimension: int) -> float:
        """One coordinate of one point; NaN beyond the set."""
        try:
            return lib.aur_pointset_coordinate(self._set, index, dimension)
        except OverflowError as error:
            raise ArgumentError(f"coordinate {dimension} of point {index} is out of range") from error


class Directions(_Rows):
    """A set of directions made ready: any part of it, in any order, from any thread. Parameters as for `points`.

    >>> sphere = Directions("spherical-fibonacci", 10**12, domain="sphere")
    >>> sphere.points(123456789012, 2).round(6)
    array([[-0.354449,  0.55428 ,  0.753086],
           [ 0.635771, -0.169282,  0.753086]])
    """

    dimension = 3

    def __init__(
        self, set: str, n: int = 0, *, domain: Literal["hemisphere", "sphere", "axes"] = "sphere",
        map: Map = "lambert", lobe: str = "uniform", density: Density = "same", smoothness: float = 1.5,
        cap: float = 0.0, scramble: Scramble = "none", seed: Seed = 0,
    ):  # fmt: skip
        with CoreCall() as call:
            options = directions_options(
                call, n, domain, map, lobe, density, smoothness, cap, scramble, self._reseed(seed)
            )
            self._set = core.make("directions", encode(set), options)

    @property
    def size(self) -> int:  # type: ignore[override]
        """Directions of the set."""
        return lib.aur_directions_size(self._set)

    def points(  # type: ignore[override]
        self, first: int = 0, count: Optional[int] = None, *, out: Any = None, dtype: DTypeLike = np.float64
    ) -> np.ndarray:
        """Unit vectors first .. first+count-1, (count, 3); count None: all from `first` on. `out` as for `PointSet`."""
        return self.rule(first, count, out=out, dtype=dtype)[0]

    def rule(
        self, first: int = 0, count: Optional[int] = None, *, out: Any = None, dtype: DTypeLike = np.float64
    ) -> tuple[np.ndarray, Array]:
        """The same with their weights, (count,): for integrals against the lobe normalised to 1."""
        count = max(0, self.size - first) if count is None else count
        weights = target_array(count, 1, None, np.float64)
        weights_output = plain_output(weights)
        array = write_into(
            count, 3, out, dtype,
            lambda output: core.call(lib.aur_directions_generate, self._set, first, count, output, weights_output),
        )  # fmt: skip
        return array, weights[:, 0]


class Rotations(_Rows):
    """A set of rotations made ready: unit quaternions w, x, y, z; any part of it, in any order, from any thread.

    `set` : one native to rotations, or any of the cube, whose first three coordinates are lifted (Shoemake 1992).
    `scramble` : "rotate3d" turns all by one random rotation; others as for the cube.

    >>> turns = Rotations("super-fibonacci", 10**9, scramble="rotate3d", seed=2)
    >>> turns[12345:12348].shape, round(float((turns[-1] ** 2).sum()), 12)
    ((3, 4), 1.0)
    """

    dimension = 4

    def __init__(self, set: str, n: int, *, scramble: Scramble = "none", seed: Seed = 0):
        with CoreCall() as call:
            options = core.options(
                "rotations_options", count=n, scramble=core.value("scramble", scramble), seed=self._reseed(seed)
            )
            self._set = core.make("rotations", encode(set), call.attach(options, progress=False))

    @property
    def size(self) -> int:  # type: ignore[override]
        """Rotations of the set."""
        return lib.aur_rotations_size(self._set)

    def points(  # type: ignore[override]
        self, first: int = 0, count: Optional[int] = None, *, out: Any = None, dtype: DTypeLike = np.float64
    ) -> np.ndarray:
        """Rotations first .. first+count-1, (count, 4); count None: all from `first` on. `out` as for `points`."""
        found = target_array(max(0, self.size - first) if count is None else count, 4, None, np.float64)
        core.call(lib.aur_rotations_points, self._set, first, len(found), found.size, core.output(found))
        return _deliver(found, out, dtype)


def _deliver(found: Array, out: Any, dtype: DTypeLike, cut: bool = False) -> np.ndarray:
    """`found` where and as it is asked for; `cut`: float32 are cut to 24 binary digits, not rounded."""
    if out is None and np.dtype(dtype) == np.float64:
        return found
    target = target_array(len(found), found.shape[1], out, dtype)
    target[...] = np.floor(found * 2.0**24) * 2.0**-24 if cut and target.dtype == np.float32 else found
    return target if out is None else out


def target_array(count: int, columns: int, out: Any, dtype: DTypeLike) -> np.ndarray:
    """The array that count points go into: `out` as NumPy sees it, or a new one."""
    if count < 0:
        raise ArgumentError(f"a count of {count} points")
    array = np.empty((count, columns), dtype=dtype) if out is None else out
    if not isinstance(array, np.ndarray) and hasattr(array, "__dlpack__"):
        array = np.from_dlpack(array)
        if not array.flags.writeable and hasattr(out, "__array__"):  # as all are that NumPy before 2.1 takes by DLPack
            array = np.asarray(out)
    if not isinstance(array, np.ndarray):
        raise ArgumentError(f"out must be an array, not {type(array).__name__}")
    if array.shape != (count, columns) or array.dtype not in (np.float64, np.float32) or not array.flags.writeable:
        raise ArgumentError(
            f"out must be a writeable array of float64 or float32 of the shape ({count}, {columns}), "
            f"not {array.dtype} of {array.shape}"
        )
    return array


def plain_output(array: np.ndarray) -> Any:
    """The library's words for where an array lies; None where it has none, as rows or columns lie apart."""
    row, column = array.strides
    count, columns = array.shape
    item = array.itemsize
    output = ffi.new("aur_output *")
    output.layout = lib.AUR_LAYOUT_POINTS
    output.capacity = array.size
    if not array.flags.c_contiguous:
        if row != item or column % item or column < count * item or not array.flags.aligned:
            return None
        output.layout = lib.AUR_LAYOUT_ARRAYS
        output.stride = column // item
        output.capacity = output.stride * (columns - 1) + count
    kind = "double" if array.dtype == np.float64 else "float"
    setattr(output, kind + "s", core.output(array, kind))
    return output


def write_into(count: int, columns: int, out: Any, dtype: DTypeLike, generate: Callable[[Any], None]) -> np.ndarray:
    """What `generate` writes into an output of the library's, in `out` or in a new array."""
    array = target_array(count, columns, out, dtype)
    output = plain_output(array)
    if output is not None:
        generate(output)
    else:
        filled = np.empty(array.shape, dtype=array.dtype)
        generate(plain_output(filled))
        array[...] = filled
    return array if out is None else out

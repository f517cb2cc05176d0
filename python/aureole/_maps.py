"""Maps from the square, lobes, rotations: arrays of points in, arrays out, one point a row."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._bridge import ArgumentError, Seed, as_array, rows, seed_number
from ._core import core, ffi, lib
from ._points import Array, Map, parse_lobe

_HEIGHTS = {"hemisphere": 1.0, "sphere": 2.0}


def _height(domain: str, cap: float) -> float:
    if domain not in _HEIGHTS:
        raise ArgumentError(f"domain must be 'hemisphere' or 'sphere', not {domain!r}")
    if not 0.0 <= cap <= 180.0:
        raise ArgumentError(f"cap must be between 0 and 180 degrees, not {cap}")
    return 1.0 - float(np.cos(np.radians(cap))) if cap else _HEIGHTS[domain]


def map_to_disk(square: ArrayLike, map: Map = "concentric") -> Array:
    """u,v in [0, 1) to the unit disk, (n, 2) to (n, 2). "concentric" is that of Shirley and Chiu (1997).

    >>> map_to_disk([[0.5, 0.5], [0.5, 0.0]]).round(12) + 0.0
    array([[ 0.,  0.],
           [ 0., -1.]])
    """
    array = rows(square, 2, "square")
    disk = np.empty_like(array)
    core.call(lib.aur_map_to_disk, core.value("map", map), len(array), core.input(array), core.output(disk))
    return disk


def map_from_disk(disk: ArrayLike, map: Map = "concentric") -> Array:
    """The inverse of `map_to_disk`: coordinates in [0, 1)."""
    array = rows(disk, 2, "disk")
    square = np.empty_like(array)
    core.call(lib.aur_map_from_disk, core.value("map", map), len(array), core.input(array), core.output(square))
    return square


def map_to_directions(
    square: ArrayLike, map: Map = "lambert", *, domain: Literal["hemisphere", "sphere"] = "sphere", cap: float = 0.0
) -> Array:
    """u,v in [0, 1) to unit vectors, (n, 2) to (n, 3), about +z.

    `cap`: degrees; not 0: onto the cap of that polar angle about +z in the place of the domain. Every map but "polar"
    preserves area.

    >>> map_to_directions([[0.5, 0.0]]).round(12)
    array([[1., 0., 0.]])
    """
    array = rows(square, 2, "square")
    xyz = np.empty((len(array), 3))
    core.call(
        lib.aur_map_to_cap, core.value("map", map), _height(domain, cap), len(array), core.input(array), core.output(xyz)
    )
    return xyz


def map_from_directions(
    xyz: ArrayLike, map: Map = "lambert", *, domain: Literal["hemisphere", "sphere"] = "sphere", cap: float = 0.0
) -> Array:
    """The inverse of `map_to_directions`: coordinates in [0, 1)."""
    array = rows(xyz, 3, "xyz")
    square = np.empty((len(array), 2))
    core.call(
        lib.aur_map_from_cap, core.value("map", map), _height(domain, cap), len(array), core.input(array), core.output(square)
    )
    return square


def map_weight(square: ArrayLike, map: Map) -> Array:
    """The uniform density over the map's own, (n,): 1, and 2u for "polar"."""
    array = rows(square, 2, "square")
    weights = np.empty(len(array))
    lib.aureole_map_weights(core.value("map", map), len(array), core.input(array), core.output(weights))
    return weights


def lobe_warp(uniform: ArrayLike, lobe: str) -> Array:
    """Uniform directions of the hemisphere (n, 3) to ones that follow a lobe about +z."""
    array = rows(uniform, 3, "uniform")
    xyz = np.empty_like(array)
    lib.aur_lobe_warp(parse_lobe(lobe), len(array), core.input(array), core.output(xyz))
    return xyz


def lobe_unwarp(xyz: ArrayLike, lobe: str) -> Array:
    """The inverse of `lobe_warp`."""
    array = rows(xyz, 3, "xyz")
    uniform = np.empty_like(array)
    lib.aur_lobe_unwarp(parse_lobe(lobe), len(array), core.input(array), core.output(uniform))
    return uniform


def lobe_pdf(xyz: ArrayLike, lobe: str) -> Array:
    """The density of a lobe about +z at unit vectors (n, 3), in 1/steradian, (n,).

    >>> lobe_pdf([[0, 0, 1.0]], "cosine").round(12)
    array([0.31830989])
    """
    array = rows(xyz, 3, "xyz")
    density = np.empty(len(array))
    lib.aureole_lobe_pdf(parse_lobe(lobe), len(array), core.input(array), core.output(density))
    return density


def rotation_matrices(wxyz: ArrayLike) -> NDArray[np.float64]:
    """Unit quaternions w, x, y, z (n, 4) to matrices (n, 3, 3).

    >>> rotation_matrices([[1, 0, 0, 0.0]])[0]
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    array = rows(wxyz, 4, "wxyz")
    matrices = np.empty((len(array), 3, 3))
    lib.aureole_rotation_matrices(len(array), core.input(array), core.output(matrices, "aur_rotation"))
    return matrices


def rotation_quaternions(matrices: ArrayLike) -> Array:
    """Rotation matrices (n, 3, 3) to unit quaternions w, x, y, z (n, 4) (Shepperd 1978)."""
    array = np.ascontiguousarray(as_array(matrices))
    if array.ndim != 3 or array.shape[1:] != (3, 3):
        raise ArgumentError(f"matrices must have the shape (n, 3, 3), not {array.shape}")
    wxyz = np.empty((len(array), 4))
    lib.aureole_rotation_quaternions(len(array), core.input(array, "aur_rotation"), core.output(wxyz))
    return wxyz


def rotate(xyz: ArrayLike, seed: Seed, *, about_z: bool = False) -> Array:
    """Unit vectors (n, 3) turned by one random rotation, uniform over seeds (Shoemake 1992), or about +z alone.

    The same rotation for the same seed: one set turned many times is randomised without being made again.
    """
    array = np.array(rows(xyz, 3, "xyz"))
    rotation = ffi.new("aur_rotation *")
    (lib.aur_rotation_axial if about_z else lib.aur_rotation_uniform)(seed_number(seed), rotation)
    lib.aur_rotation_apply(rotation, len(array), core.output(array))
    return array


def healpix_pixels(xyz: ArrayLike, side: int, *, nested: bool = False) -> NDArray[np.uint64]:
    """The pixels (n,) of HEALPix in which vectors (n, 3) lie, of 12 side^2 in rings, or nested.

    `points("healpix:order=nested", 12 * side**2)` has their centres.

    >>> healpix_pixels([[0, 0, 1.0], [0, 0, -1.0]], 4)
    array([  0, 188], dtype=uint64)
    """
    array = rows(xyz, 3, "xyz")
    found = np.empty(len(array), np.uint64)
    core.call(
        lib.aur_healpix_pixels, side, nested, len(array), core.input(array), len(array),
        core.output(found, "uint64_t"),
    )  # fmt: skip
    return found


def symmetry_group(symmetry: str) -> Array:
    """The quaternions of a crystal's rotations, the identity first: "1", "222", "432", ...

    >>> len(symmetry_group("432"))
    24
    """
    group = np.empty((lib.AUR_SYMMETRY_ORDER_MAX, 4))
    return group[: lib.aur_symmetry_group(core.value("symmetry", symmetry), core.output(group))].copy()


def symmetry_reduce(wxyz: ArrayLike, symmetry: str) -> Array:
    """Each rotation (n, 4) to the same orientation of the crystal in the fundamental zone, with w >= 0."""
    array = np.array(rows(wxyz, 4, "wxyz"))
    core.call(lib.aur_symmetry_reduce, core.value("symmetry", symmetry), len(array), core.output(array))
    return array


def symmetry_select(wxyz: ArrayLike, symmetry: str) -> Array:
    """Those of the rotations (n, 4) that are in the fundamental zone, in their order, with w >= 0."""
    array = np.array(rows(wxyz, 4, "wxyz"))
    return array[: lib.aur_symmetry_select(core.value("symmetry", symmetry), len(array), core.output(array))].copy()


def fibonacci_nearest(xyz: ArrayLike, n: int, domain: Literal["hemisphere", "sphere"] = "sphere") -> NDArray[np.uint64]:
    """The index (q,) of the nearest point of the spherical Fibonacci set of n points (Keinert 2015), without a table.

    >>> fibonacci_nearest([[0, 0, 1.0], [0, 0, -1.0]], 10**9)
    array([        0, 999999999], dtype=uint64)
    """
    array = rows(xyz, 3, "xyz")
    fibonacci = ffi.new("aur_fibonacci_set *", {"size": n, "domain": core.value("domain", domain)})
    indices = np.empty(len(array), dtype=np.uint64)
    core.call(
        lib.aur_fibonacci_nearest, fibonacci, len(array), core.input(array), len(array),
        core.output(indices, "uint64_t"),
    )  # fmt: skip
    return indices

"""View factors and radiosities of meshes, by libaureole-lighting."""

from __future__ import annotations

from typing import Any, Mapping, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._bridge import ArgumentError, Progress, encode, rows, view_of
from ._library import ffi
from ._render import Array, Path, Texts, _Call, _lighting

_STEFAN_BOLTZMANN = 5.670374419e-8

PerRow = Union[ArrayLike, Mapping[str, float]]


class ViewFactors(NamedTuple):
    """View factors between rows: facets, or groups of them. The matrix is in compressed rows, columns ascending."""

    starts: NDArray[np.uint64]  #: (rows + 1,): row i has the entries starts[i] .. starts[i+1]-1
    columns: NDArray[np.uint32]
    values: Array
    half_widths: Array  #: of intervals; 0 for closed forms
    areas: Array  #: (rows,), in squared units of length
    sky: Array  #: (rows,): what leaves the scene
    back: Array  #: (rows,): what arrives at backs of facets that only see on their fronts
    names: list[Optional[str]]  #: of groups; None where rows are single facets

    def dense(self) -> Array:
        """All factors, (rows, rows)."""
        matrix = np.zeros((len(self.areas), len(self.areas)))
        matrix[np.repeat(np.arange(len(self.areas)), np.diff(self.starts.astype(np.int64))), self.columns] = self.values
        return matrix


class Radiosities(NamedTuple):
    """Light or heat on rows: facets, or groups of them. All arrays are (rows,)."""

    radiosity: Array  #: what leaves a row
    half_widths: Array  #: of the intervals of `radiosity`
    incoming: Array  #: what arrives at it
    incoming_half_widths: Array
    net: Array  #: radiosity - incoming: the net flux from the row
    sky: Array  #: sky factors
    areas: Array
    names: list[Optional[str]]  #: of groups; None where rows are single facets


def _load(path: Path, group: bool, both_sides: bool, definitions: Optional[Mapping[str, Any]], progress: Optional[Progress]) -> Any:
    library, texts, facets = _lighting(), Texts(), ffi.new("aur_facets **")
    with _Call(progress) as call:
        call.depth = 4
        given = library.options("facets_options", group=group, both_sides=both_sides, **texts.definitions(definitions))
        library.call(library.lib.aur_facets_load, encode(path), call.attach(given, progress=False), facets)
        return library.own("facets", facets)


def _names(facets: Any) -> list[Optional[str]]:
    library = _lighting()
    return [library.text(library.lib.aur_facets_name(facets, row)) for row in range(library.lib.aur_facets_rows(facets))]


def _per_row(facets: Any, values: PerRow, name: str) -> Array:
    """One number for all rows, one for each, or numbers by name, where "*" is all other rows."""
    count = _lighting().lib.aur_facets_rows(facets)
    if not isinstance(values, Mapping):
        try:
            return np.array(np.broadcast_to(np.asarray(values, dtype=float), (count,)))
        except ValueError:
            raise ArgumentError(f"{name}: expected a number, or one for each of {count} rows (found the shape {np.shape(values)})") from None
    names = _names(facets)
    unknown = [key for key in values if key != "*" and key not in names]
    missing = [row for row in names if row not in values and "*" not in values]
    if unknown or missing:
        raise ArgumentError(f"{name}: " + (f"no row has the name {unknown[0]!r}" if unknown else f"no number for row {missing[0]!r}, nor for '*'"))
    return np.array([values[row] if row in values else values["*"] for row in names], dtype=float)


def _emittances(facets: Any) -> Array:
    """Those of the file, where it has them."""
    library = _lighting()
    found = library.lib.aur_facets_emittances(facets)
    if found == ffi.NULL:
        raise ArgumentError("the file has no emittances: give them")
    return np.array(view_of(library, facets, found, (library.lib.aur_facets_rows(facets),)))


def viewfactors(
    path: Path, *, group: bool = False, both_sides: bool = False, rays: int = 0, randomizations: int = 0,
    set: Optional[str] = None, seed: int = 0, rays_only: bool = False, confidence: float = 0.0, threads: int = 0,
    half_planes: int = 0, error: float = 0.0, script: Union[bool, PerRow] = False,
    definitions: Optional[Mapping[str, Any]] = None, progress: Optional[Progress] = None,
) -> ViewFactors:  # fmt: skip
    """View factors between the facets of a mesh (.obj, .ply, .stl, .off, .vs3) or a scene, or between their groups.

    `rays` from each facet and side, 0: 2048, by `randomizations` of a set of four dimensions, from which the intervals of
    `confidence` (0: 0.95) come; pairs that see each other wholly have closed forms unless `rays_only`, and the sky is found
    by `half_planes`, 0: three for two rays. Each row with its sky and back adds up to 1. `error`: double rays and half planes
    until no half width is larger. `script`: Hottel's script F instead, with emittances as a number, an array or numbers by
    name ("*": all other rows), or True for those of a .vs3 file.
    """
    library, texts = _lighting(), Texts()
    lib = library.lib
    loaded = _load(path, group, both_sides, definitions, progress)
    with _Call(progress) as call:
        options = library.options(
            "view_factors_options", rays=rays, randomizations=randomizations, set=texts(set), seed=seed,
            rays_only=rays_only, confidence=confidence, threads=threads, half_planes=half_planes, error=error,
        )  # fmt: skip
        factors = library.make("view_factors", loaded, call.attach(options))
    if script is not False:
        emittances = _emittances(loaded) if script is True else _per_row(loaded, script, "script")
        pointer = ffi.new("aur_view_factors **")
        library.call(lib.aur_view_factors_script, factors, library.input(emittances), confidence or 0.95, pointer)
        factors = library.own("view_factors", pointer)
    matrix = library.options("view_factors_matrix")
    library.call(lib.aur_view_factors_get_matrix, factors, matrix)
    count = matrix.rows
    starts = view_of(library, factors, matrix.starts, (count + 1,), "<u8")
    entries = int(starts[count])
    return ViewFactors(
        starts, view_of(library, factors, matrix.columns, (entries,), "<u4"),
        view_of(library, factors, matrix.values, (entries,)), view_of(library, factors, matrix.half_widths, (entries,)),
        view_of(library, factors, matrix.areas, (count,)), view_of(library, factors, matrix.sky, (count,)),
        view_of(library, factors, matrix.back, (count,)), _names(loaded),
    )  # fmt: skip


def radiosities(
    path: Path, reflectance: Optional[PerRow] = None, *, emittance: Optional[PerRow] = None,
    temperature: Optional[PerRow] = None, emission: PerRow = 0.0, sky: float = 0.0, sun: ArrayLike = (0, 0, 0),
    matrix_free: bool = False, group: bool = False, both_sides: bool = False, rays: int = 0, randomizations: int = 0,
    half_planes: int = 0, error: float = 0.0, confidence: float = 0.0, seed: int = 0, threads: int = 0,
    definitions: Optional[Mapping[str, Any]] = None, progress: Optional[Progress] = None,
) -> Radiosities:  # fmt: skip
    """Radiosity B = emission + reflectance (sun + sky + F B) and net flux of the rows of a mesh, with intervals.

    Give `reflectance`, or `emittance` (1 - reflectance; of a .vs3 file where neither is given) with `temperature` in kelvin or
    `emission`: each a number, an array, or numbers by name, where "*" is all other rows. `sky` is the sky's radiosity; `sun`
    points to the sun and is as long as the irradiance of what faces it.
    """
    library = _lighting()
    lib = library.lib
    loaded = _load(path, group, both_sides, definitions, progress)
    if reflectance is not None and emittance is not None:
        raise ArgumentError("give reflectance or emittance, not both")
    if reflectance is not None:
        reflected = _per_row(loaded, reflectance, "reflectance")
    else:
        reflected = 1 - (_emittances(loaded) if emittance is None else _per_row(loaded, emittance, "emittance"))
    emitted = _per_row(loaded, emission, "emission")
    if temperature is not None:
        emitted = (1 - reflected) * _STEFAN_BOLTZMANN * _per_row(loaded, temperature, "temperature") ** 4
    count = lib.aur_facets_rows(loaded)
    found = np.zeros((5, count))
    names = ("radiosity", "half_widths", "sky", "incoming", "incoming_half_widths")
    light = library.options(
        "facets_light", sky=sky, sun=tuple(np.asarray(sun, float)), reflectances=library.input(reflected), emissions=library.input(emitted)
    )
    solved = library.options("facets_radiosities", **{name: library.output(found[i]) for i, name in enumerate(names)})
    with _Call(progress) as call:
        options = call.attach(library.options(
            "view_factors_options", rays=rays, randomizations=randomizations, seed=seed, threads=threads,
            confidence=confidence, half_planes=half_planes, error=error,
        ))  # fmt: skip
        factors = ffi.NULL if matrix_free else library.make("view_factors", loaded, options)
        library.call(lib.aur_view_factors_solve, loaded, factors, options, light, solved)
    areas = np.array(view_of(library, loaded, lib.aur_facets_areas(loaded), (count,)))
    return Radiosities(found[0], found[1], found[3], found[4], found[0] - found[3], found[2], areas, _names(loaded))


def view_factor_polygons(from_corners: ArrayLike, to_corners: ArrayLike) -> float:
    """The view factor from a plane convex polygon (n, 3) to another (m, 3), seen from their fronts (Sparrow 1963)."""
    library, value = _lighting(), ffi.new("double *")
    first, second = rows(from_corners, 3, "from_corners"), rows(to_corners, 3, "to_corners")
    library.call(
        library.lib.aur_view_factor_polygons, len(first), library.input(first), len(second), library.input(second), value
    )
    return value[0]

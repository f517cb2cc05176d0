"""Aureole: sample points on the square, the cube, the disk, the sphere, axes and rotations; how even they are; weights.

Functions have the names of the C library without `aur_`. Arrays are NumPy's, one point a row, in double precision unless
said otherwise. Errors are `Error`s with the library's words, most of them also ValueErrors. Points and weights are
functions of their arguments and the seed: no bit depends on threads or on the machine's instruction set.

>>> xyz = points("spherical-fibonacci", 1024, domain="sphere")
>>> round(measure(xyz, "min-distance"), 6)
0.096622

`aureole.qmc` has engines for scipy.stats.qmc, `aureole.plot` draws points by matplotlib, `aureole.lab` runs experiments; they are
loaded when they are asked for. `render`, `compare`, `viewfactors`, `irradiance`, `daylight` and `lab` need libaureole-render
(see `render_library`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._bridge import (
    ArgumentError,
    AureoleWarning,
    CancelledError,
    Error,
    FormatError,
    IntegrationWarning,
    InternalError,
    OpenError,
    OutOfMemoryError,
    UnknownNameError,
    UnsupportedError,
    WriteError,
)
from ._core import core as _core
from ._integrate import Average, Estimate, Integral, average, estimate, integrate, point_group, symmetric_rule
from ._maps import (
    fibonacci_nearest,
    healpix_pixels,
    lobe_pdf,
    lobe_unwarp,
    lobe_warp,
    map_from_directions,
    map_from_disk,
    map_to_directions,
    map_to_disk,
    map_weight,
    rotate,
    rotation_matrices,
    rotation_quaternions,
    symmetry_group,
    symmetry_reduce,
    symmetry_select,
)
from ._measures import Nearest, measure, student_quantile, weights_voronoi
from ._points import Directions, PointSet, Rotations, points, read, write
from ._sets import register_set
from ._tables import Key, Measure, Row, Set, measures, names, sets, tables
from ._weights import (
    ExactReport,
    Potential,
    Report,
    rule,
    weights,
    weights_exact,
    weights_nested,
    weights_solve,
    worst_case_error,
)

if TYPE_CHECKING:
    from ._daylight import Bifacial, Daylight, bifacial, daylight, daylight_coefficients
    from ._factors import Radiosities, ViewFactors, radiosities, view_factor_polygons, viewfactors
    from ._render import (
        Irradiance,
        Scene,
        SceneDescription,
        compare,
        flip,
        irradiance,
        read_image,
        render,
        render_library,
        render_tables,
        write_image,
    )

__version__: str = _core.text(_core.lib.aur_version()) or ""

__all__ = [
    "ArgumentError",
    "AureoleWarning",
    "Average",
    "Bifacial",
    "CancelledError",
    "Daylight",
    "Directions",
    "Error",
    "Estimate",
    "ExactReport",
    "FormatError",
    "Integral",
    "IntegrationWarning",
    "InternalError",
    "Irradiance",
    "Key",
    "Measure",
    "Nearest",
    "OpenError",
    "OutOfMemoryError",
    "PointSet",
    "Potential",
    "Radiosities",
    "Report",
    "Rotations",
    "Row",
    "Scene",
    "SceneDescription",
    "Set",
    "UnknownNameError",
    "UnsupportedError",
    "ViewFactors",
    "WriteError",
    "average",
    "bifacial",
    "compare",
    "daylight",
    "daylight_coefficients",
    "estimate",
    "fibonacci_nearest",
    "flip",
    "healpix_pixels",
    "integrate",
    "irradiance",
    "lobe_pdf",
    "lobe_unwarp",
    "lobe_warp",
    "map_from_directions",
    "map_from_disk",
    "map_to_directions",
    "map_to_disk",
    "map_weight",
    "measure",
    "measures",
    "names",
    "point_group",
    "points",
    "radiosities",
    "read",
    "read_image",
    "register_set",
    "render",
    "render_library",
    "render_tables",
    "rotate",
    "rotation_matrices",
    "rotation_quaternions",
    "rule",
    "sets",
    "student_quantile",
    "symmetric_rule",
    "symmetry_group",
    "symmetry_reduce",
    "symmetry_select",
    "tables",
    "view_factor_polygons",
    "viewfactors",
    "weights",
    "weights_exact",
    "weights_nested",
    "weights_solve",
    "weights_voronoi",
    "worst_case_error",
    "write",
    "write_image",
]

for _error in (Error, *Error.__subclasses__(), AureoleWarning, IntegrationWarning):  # their home in messages
    _error.__module__ = __name__
del _error


def __getattr__(name: str) -> object:
    """What needs more than NumPy is loaded when it is asked for: the renderer, scipy, matplotlib."""
    import importlib

    if name in ("lab", "qmc", "plot"):
        return importlib.import_module(f"{__name__}.{name}")
    if name in __all__:
        homes = {
            "_daylight": ("Bifacial", "Daylight", "bifacial", "daylight", "daylight_coefficients"),
            "_factors": ("Radiosities", "ViewFactors", "radiosities", "view_factor_polygons", "viewfactors"),
        }
        module = next((home for home, names in homes.items() if name in names), "_render")
        return getattr(importlib.import_module(f"{__name__}.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*__all__, "lab", "plot", "qmc"]

"""A year of daylight at sensors, by libaureole-lighting."""

from __future__ import annotations

import os
import tempfile
from typing import Any, Mapping, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from ._bridge import ArgumentError, Progress, encode, rows
from ._library import ffi
from ._render import Array, Path, Scene, Texts, _Call, _lighting, _scene

_MEASURES = ("factor", "autonomy", "continuous", "useful", "below", "above", "sun_hours", "annual")
_EFFICACIES = {"perez": 0, "179": 1, "none": 2}


class Daylight(NamedTuple):
    """A year at sensors: arrays (n,), each with its standard errors in `error`."""

    factor: Array  #: daylight factor, percent of the horizontal illuminance outside under the CIE overcast sky
    autonomy: Array  #: percent of the hours that count with at least `threshold`
    continuous: Array  #: the same, with hours below it counted in proportion
    useful: Array  #: percent of the hours that count within `useful`
    below: Array  #: and below it
    above: Array  #: and above it
    sun_hours: Array  #: hours that count with more than 1000 lux straight from the sun
    annual: Array  #: the sum over the year: lux hours, or Wh/m2
    error: dict[str, Array]  #: standard errors of each of these, by name
    hours: Array  #: (n, hours of the weather): lux, or W/m2
    hours_error: Array  #: their standard errors
    spatial_autonomy: float  #: percent of sensors with an autonomy of 50 % or more
    spatial_autonomy_interval: tuple[float, float]  #: by the ends of their 95 % intervals
    sunlight_exposure: float  #: percent of sensors with more than 250 sun hours


def _schedule(library: Any, schedule: Union[None, tuple[int, int], ArrayLike], options: Any) -> Any:
    """Sets the hours that count; what is returned must live as long as the options."""
    if schedule is None:
        return None
    if isinstance(schedule, tuple) and len(schedule) == 2:
        options.__setattr__("from", int(schedule[0]))
        options.to = int(schedule[1])
        return None
    counted = np.ascontiguousarray(np.asarray(schedule, dtype=float) > 0)
    options.schedule_count = counted.size
    options.schedule = library.input(counted.view(np.uint8), "bool")
    return counted


def daylight(
    scene: Union[Scene, Path], positions: ArrayLike, normals: ArrayLike, weather: Path, *, directions: int = 0,
    patches: int = 1, efficacy: str = "perez", ground_albedo: float = 0.2, threshold: float = 300.0,
    useful: tuple[float, float] = (100.0, 3000.0), schedule: Union[None, tuple[int, int], ArrayLike] = None,
    weekdays: bool = False, up: ArrayLike = (0, 0, 0), north: ArrayLike = (0, 0, 0), max_depth: int = 0,
    set: Optional[str] = None, seed: int = 0, threads: int = 0, definitions: Optional[Mapping[str, Any]] = None,
    progress: Optional[Progress] = None,
) -> Daylight:  # fmt: skip
    """Daylight through the hours of a weather file (EPW, .wea or TMY3), in the place of the scene's lights.

    Parameters
    ----------
    positions, normals : (n, 3), in scene units.
    directions : from each sensor; 0: 16384.
    patches : M of Reinhart's patches, M x M for each of Tregenza's 145, from 1 to 6.
    efficacy : "perez" (1990), "179" lm/W, or "none": W/m2 in the place of lux.
    schedule : (from, to) o'clock, over midnight where from is above to; or a number for each hour, above 0 where it counts.
    up, north : in the scene; zeros: of its sky, else +z and +y in Radiance's files, +y and -z in others.
    """
    library, texts = _lighting(), Texts()
    lib = library.lib
    loaded, where, along = _scene(scene, definitions), rows(positions, 3, "positions"), rows(normals, 3, "normals")
    if len(where) != len(along):
        raise ArgumentError(f"{len(where)} positions and {len(along)} normals")
    if efficacy not in _EFFICACIES:
        raise ArgumentError(f"efficacy must be one of {', '.join(_EFFICACIES)}, not {efficacy!r}")
    read = ffi.new("aur_weather **")
    library.call(lib.aur_weather_read, encode(weather), read)
    known = library.own("weather", read)
    view = library.options("sensors_view", count=len(where), positions=library.input(where), normals=library.input(along))
    found = np.zeros(
        len(where),
        dtype={"names": ["value", "error"], "formats": [("<f8", 8), ("<f8", 8)],
               "offsets": [ffi.offsetof("aur_daylight", name) for name in ("value", "error")], "itemsize": ffi.sizeof("aur_daylight")},
    )  # fmt: skip
    summary = library.options("daylight_summary")
    with tempfile.TemporaryDirectory() as folder, _Call(progress) as call:
        series = os.path.join(folder, "hours.npy")
        options = library.options(
            "daylight_options", set=texts(set), directions=directions, max_depth=max_depth, subdivision=patches,
            no_ground=ground_albedo == 0, ground_albedo=ground_albedo, efficacy=_EFFICACIES[efficacy],
            threshold=threshold, useful=tuple(useful), weekdays=weekdays, up=tuple(np.asarray(up, float)),
            north=tuple(np.asarray(north, float)), series=texts(series), seed=seed, threads=threads,
        )  # fmt: skip
        _hours = _schedule(library, schedule, options)
        library.call(
            lib.aur_daylight_estimate, loaded._scene, view, lib.aur_weather_get_view(known), call.attach(options),
            found.dtype.itemsize, library.output(found, "aur_daylight"), summary,
        )  # fmt: skip
        hours = np.load(series)
    return Daylight(
        *(found["value"][:, i] for i in range(8)),
        {name: found["error"][:, i] for i, name in enumerate(_MEASURES)}, hours[:, 0], hours[:, 1], summary.spatial_autonomy,
        (summary.spatial_autonomy_least, summary.spatial_autonomy_most), summary.sunlight_exposure,
    )  # fmt: skip


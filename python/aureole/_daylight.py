"""A year of daylight at sensors, by libaureole-lighting."""

from __future__ import annotations

from typing import Any, Callable, Mapping, NamedTuple, Optional, Union

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


_Schedule = Union[None, str, tuple[int, int], ArrayLike]


def _schedule(library: Any, schedule: _Schedule, options: Any) -> Any:
    """Sets the hours that count; what is returned must live as long as the options."""
    if schedule is None:
        return None
    if isinstance(schedule, str):
        if schedule != "daylight":
            raise ArgumentError(f'schedule must be (from, to), "daylight" or a number per hour, not {schedule!r}')
        options.daylight_hours = True
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
    useful: tuple[float, float] = (100.0, 3000.0), schedule: _Schedule = None,
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
    schedule : (from, to) o'clock, over midnight where from is above to; a number for each hour, above 0 where it counts; or
        "daylight", the half of the hours with the most diffuse irradiance (EN 17037).
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
    parsed = library.own("weather", read)
    view = library.options("sensors_view", count=len(where), positions=library.input(where), normals=library.input(along))
    found = np.zeros(
        len(where),
        dtype={"names": ["value", "error"], "formats": [("<f8", 8), ("<f8", 8)],
               "offsets": [ffi.offsetof("aur_daylight", name) for name in ("value", "error")], "itemsize": ffi.sizeof("aur_daylight")},
    )  # fmt: skip
    summary = library.options("daylight_summary")
    hours = np.zeros((len(where), 2, lib.aur_weather_get_view(parsed).count))
    with _Call(progress) as call:
        options = library.options(
            "daylight_options", set=texts(set), directions=directions, max_depth=max_depth, subdivision=patches,
            no_ground=ground_albedo == 0, ground_albedo=ground_albedo, efficacy=_EFFICACIES[efficacy],
            threshold=threshold, useful=tuple(useful), weekdays=weekdays, up=tuple(np.asarray(up, float)),
            north=tuple(np.asarray(north, float)), hourly=library.output(hours), seed=seed, threads=threads,
        )  # fmt: skip
        _hours = _schedule(library, schedule, options)
        library.call(
            lib.aur_daylight_estimate, loaded._scene, view, lib.aur_weather_get_view(parsed), call.attach(options),
            found.dtype.itemsize, library.output(found, "aur_daylight"), summary,
        )  # fmt: skip
    return Daylight(
        *(found["value"][:, i] for i in range(8)),
        {name: found["error"][:, i] for i, name in enumerate(_MEASURES)}, hours[:, 0], hours[:, 1], summary.spatial_autonomy,
        (summary.spatial_autonomy_least, summary.spatial_autonomy_most), summary.sunlight_exposure,
    )  # fmt: skip


def daylight_coefficients(
    scene: Union[Scene, Path], positions: ArrayLike, normals: ArrayLike, *, directions: int = 0, patches: int = 1,
    up: ArrayLike = (0, 0, 0), north: ArrayLike = (0, 0, 0), max_depth: int = 0, set: Optional[str] = None, seed: int = 0,
    threads: int = 0, definitions: Optional[Mapping[str, Any]] = None, progress: Optional[Progress] = None,
) -> tuple[Array, Array]:  # fmt: skip
    """Irradiance of sensors for radiance 1 of the ground and each patch of the sky: (n, patches, 3), and its standard errors.

    The order is that of Radiance's gendaymtx: the ground, then `patches` x `patches` parts of Tregenza's 145 from the horizon up,
    clockwise from north.
    """
    library, texts = _lighting(), Texts()
    lib = library.lib
    loaded, where, along = _scene(scene, definitions), rows(positions, 3, "positions"), rows(normals, 3, "normals")
    if len(where) != len(along):
        raise ArgumentError(f"{len(where)} positions and {len(along)} normals")
    view = library.options("sensors_view", count=len(where), positions=library.input(where), normals=library.input(along))
    found = np.zeros((2, len(where), lib.aur_daylight_patch_count(patches), 3))
    with _Call(progress) as call:
        options = library.options(
            "daylight_options", set=texts(set), directions=directions, max_depth=max_depth, subdivision=patches,
            up=tuple(np.asarray(up, float)), north=tuple(np.asarray(north, float)), seed=seed, threads=threads,
        )  # fmt: skip
        library.call(
            lib.aur_daylight_coefficients, loaded._scene, view, call.attach(options), library.output(found[0]), library.output(found[1])
        )
    return found[0], found[1]


class Bifacial(NamedTuple):
    """Irradiance of the fronts and rears of solar modules: arrays (n, hours) in W/m2, 0 in hours without a normal."""

    front: Array
    rear: Array
    front_error: Array  #: standard errors
    rear_error: Array
    gain: Array  #: (n,): bifacial gain, percent: the sum of `rear` for that of `front`
    gain_error: Array  #: (n,): its standard error at most: as if the errors of all hours had one sign


def bifacial(
    scene: Union[Scene, Path, Callable[[Array], Union[Scene, Path]]],
    positions: Union[ArrayLike, Callable[[Array], ArrayLike]], normals: ArrayLike, weather: Path, **options: Any,
) -> Bifacial:  # fmt: skip
    """Irradiance of the fronts and rears of solar modules through the hours of a weather file, also of trackers.

    `normals` is one normal of the fronts, or a table (hours, 3) with zeros for hours to leave out. `positions` (n, 3) on the modules,
    and `scene`, may be functions of a normal, which return the places and the scene with the modules turned to it. Each distinct normal
    is one run: round the angles of a tracker, say to 5 degrees. `options` are those of `daylight`.
    """
    table = np.nan_to_num(np.atleast_2d(np.asarray(normals, dtype=float)))
    if table.ndim != 2 or table.shape[1] != 3:
        raise ArgumentError(f"normals must have the shape (3,) or (hours, 3), not {np.shape(normals)}")
    distinct, which = np.unique(table.round(9), axis=0, return_inverse=True)
    sums: Optional[np.ndarray] = None
    for i, normal in enumerate(distinct):
        if not normal.any():
            continue
        origins = rows(positions(normal) if callable(positions) else positions, 3, "positions")
        count = len(origins)
        year = daylight(
            scene(normal) if callable(scene) else scene, np.vstack([origins, origins]),
            np.repeat([normal, -normal], count, axis=0), weather, **{**options, "efficacy": "none"},
        )  # fmt: skip
        if len(table) not in (1, year.hours.shape[1]):
            raise ArgumentError(f"normals has {len(table)} rows, and the weather {year.hours.shape[1]} hours")
        if sums is None:
            sums = np.zeros((2, 2 * count, year.hours.shape[1]))
        here = np.broadcast_to(which.reshape(-1) == i, year.hours.shape[1])
        sums[:, :, here] = np.stack([year.hours, year.hours_error])[:, :, here]
    if sums is None:
        raise ArgumentError("no hour has a normal")
    count = sums.shape[1] // 2
    front, rear = np.nansum(sums[0, :count], 1), np.nansum(sums[0, count:], 1)
    errors = np.nansum(sums[1], 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        gain = rear / front
        gain_error = (errors[count:] + gain * errors[:count]) / front
    return Bifacial(sums[0, :count], sums[0, count:], sums[1, :count], sums[1, count:], 100 * gain, 100 * gain_error)

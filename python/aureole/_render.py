"""Images and irradiance by libaureole-lighting and libaureole-render, which are loaded when they are first used."""

from __future__ import annotations

import importlib.util
import os
import pathlib
from typing import Any, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._bridge import ArgumentError, Bridge, Call, Error, Progress, Rebuilt, encode, renamed_keyword, rows, view_of
from ._core import core
from ._library import ffi
from ._sets import attach
from ._tables import Row, read_tables

Array = NDArray[np.float64]
ImageArray = NDArray[np.float32]
Path = Union[str, os.PathLike[str]]

_NAMES = "libaureole-lab.so.1", "libaureole-lighting.so.1", "libaureole-render.so.1"  # each loads those after it
_opened: dict[str, Bridge] = {}


def render_library() -> str:
    """Where libaureole-lab, which loads libaureole-lighting and libaureole-render, was found; or one of these, which has no
    experiments, or no view factors and no irradiance either.

    It is looked for in the file that the environment's AUREOLE_RENDER_LIBRARY names, in the package aureole-render, and
    where the system has its libraries. Raises ImportError, with what was tried, where there is none.
    """
    _library()
    return next(iter(_opened))


def _library() -> Bridge:
    if _opened:
        return next(iter(_opened.values()))
    named = os.environ.get("AUREOLE_RENDER_LIBRARY")
    package = importlib.util.find_spec("aureole_render")
    candidates = [named] if named else []
    if not named and package is not None and package.origin is not None:
        candidates += [str(pathlib.Path(package.origin).with_name(name)) for name in _NAMES]
    if not named:
        candidates += _NAMES
    tried = []
    for candidate in candidates:
        try:
            # It stays until the process ends: its threads and what it made may outlive this module.
            library = ffi.dlopen(candidate, ffi.RTLD_NOW | ffi.RTLD_NODELETE)
        except OSError as error:
            tried.append(str(error))
            continue
        bridge = Bridge(ffi, library)
        version, expected = bridge.text(library.aur_version()), core.text(core.lib.aur_version())
        if version != expected:
            raise ImportError(f"{candidate} is of version {version}, and this package of {expected}: install the same of both")
        _opened[candidate] = bridge
        attach(bridge)
        return bridge
    raise ImportError(
        "rendering, view factors and irradiance need libaureole-lighting or libaureole-render, which were not found. "
        "Install the package aureole-render (pip install ./python/render in the source tree, or the wheel aureole_render-*.whl), "
        "install the tree (cmake --install build/release; in another prefix than /usr set LD_LIBRARY_PATH=PREFIX/lib), "
        "or set AUREOLE_RENDER_LIBRARY to build/release/libaureole-lab.so. Tried: "
        + "; ".join(tried)
    )


def _lighting() -> Bridge:
    library = _library()
    try:
        library.lib.aur_irradiance_estimate
    except (AttributeError, ffi.error) as error:
        raise ImportError(f"view factors and irradiance need libaureole-lighting: {error}") from None
    return library


class _Call(Call):
    """A call of libaureole-render with the functions that it calls back."""

    def attach(self, options: Any, progress: bool = True) -> Any:
        library = _library()
        self._report = ffi.callback(
            "int(void *, const char *, uint64_t, uint64_t)",
            lambda user, what, done, total: self.report(library.text(what) or "", done, total),
            error=1,
            onerror=self.interrupt,
        )
        self._warn = ffi.callback(
            "void(void *, const char *)", lambda user, message: self.messages.append(library.text(message) or "")
        )
        if progress:
            options.progress.function = self._report
        options.warnings.function = self._warn
        return options


def render_tables() -> dict[str, dict[str, Row]]:
    """Every table of what images are made with by its kind: integrators, materials, shapes, lights, ..."""
    library = _library()
    return read_tables(library, library.lib.aur_render_table_at)


class Texts:
    """C texts that live as long as this."""

    def __init__(self) -> None:
        self.alive: list[Any] = []

    def __call__(self, text: Any) -> Any:
        if text is None:
            return ffi.NULL
        self.alive.append(ffi.new("char[]", encode(text)))
        return self.alive[-1]

    def definitions(self, definitions: Optional[Mapping[str, Any]]) -> dict[str, Any]:
        pairs = [(self(name), self(str(value))) for name, value in (definitions or {}).items()]
        self.alive.append(ffi.new("aur_definition[]", pairs))
        return {"definition_count": len(pairs), "definitions": self.alive[-1]}


class SceneDescription(NamedTuple):
    shapes: int
    triangles: int
    emitters: int
    materials: int
    width: int
    height: int
    samples_per_pixel: int
    lower: tuple[float, float, float]  #: corners of the bounding box, in scene units
    upper: tuple[float, float, float]
    integrator: str
    sampler: str
    filter: str


class Scene(Rebuilt):
    """A scene: Mitsuba 3's XML, Radiance's .rad, or a model (.glb, .obj, ...); loaded once, for any number of images.

    `definitions`: values for the scene's <default>s. `confine`: no file outside of the scene's folder is read. `text`: the
    scene itself; `path` is then its name in messages, and where its files are looked for. `model_light`: whether a
    studio's light is added to a model: "auto" where it has no light source but emitting surfaces, "always", "none".
    `further`: more files of the scene, as Radiance has them. `diffuse`: materials of Radiance that are not supported become
    their diffuse part.
    """

    def __init__(
        self, path: Path, *, definitions: Optional[Mapping[str, Any]] = None, confine: bool = False,
        text: Union[str, bytes, None] = None, model_light: str = "auto", further: Sequence[Path] = (), diffuse: bool = False,
    ):  # fmt: skip
        library, texts, pointer = _library(), Texts(), ffi.new("aur_scene **")
        options = library.options("scene_options", confine=confine, diffuse=diffuse, **texts.definitions(definitions))
        more = ffi.new("const char *[]", [texts(os.fspath(name)) for name in further] or [ffi.NULL])
        options.further_count, options.further = len(further), more
        options.model_light = library.value("model_light", model_light)
        with _Call() as call:
            call.attach(options)
            if text is None:
                library.call(library.lib.aur_scene_load, encode(path), options, pointer)
            else:
                data = text.encode() if isinstance(text, str) else text
                library.call(library.lib.aur_scene_load_memory, encode(path), len(data), data, options, pointer)
            self._scene = library.own("scene", pointer)

    def describe(self) -> SceneDescription:
        """What is in the scene."""
        library = _library()
        found = library.options("scene_description")
        library.call(library.lib.aur_scene_get_description, self._scene, found)
        values = {name: getattr(found, name) for name in SceneDescription._fields}
        for name in ("integrator", "sampler", "filter"):
            values[name] = library.text(values[name]) or ""
        for name in ("lower", "upper"):
            values[name] = tuple(values[name])
        return SceneDescription(**values)


def _scene(scene: Union[Scene, Path], definitions: Optional[Mapping[str, Any]]) -> Scene:
    if not isinstance(scene, Scene):
        return Scene(scene, definitions=definitions)
    if definitions:
        raise ArgumentError("definitions are for a scene that is loaded here: give them to Scene")
    return scene


def render(
    scene: Union[Scene, Path], *, integrator: Optional[str] = None, sampler: Optional[str] = None,
    filter: Optional[str] = None, spp: int = 0, width: int = 0, height: int = 0,
    crop: Optional[tuple[int, int, int, int]] = None, seed: int = 0, threads: int = 0,
    error: Optional[float] = None, error_measure: str = "relative", channels: Optional[Sequence[str]] = None,
    clamp: float = 0.0, definitions: Optional[Mapping[str, Any]] = None, progress: Optional[Progress] = None,
) -> ImageArray:  # fmt: skip
    """An image of a scene, (height, width, channels) of float32: linear radiance, Rec. 709 primaries, the top row first.

    Parameters
    ----------
    scene : a Scene or the path of one.
    integrator, sampler, filter : NAME[:key=value,...] in the place of the scene's; `render_tables()` lists them.
    spp : samples per pixel; 0: the scene's.
    width, height : in pixels; 0: the scene's, or its shape where the other one is given.
    crop : (x0, x1, y0, y1): the pixels x0 <= x < x1, y0 <= y < y1 alone.
    error : render until the error by `error_measure` is below this, such as .05; `spp` has no meaning then.
    error_measure : "relative" to each pixel's surroundings, to the image's "mean", or of the image as on a "display".
    channels : their names; None: R, G, B. An integrator such as `aov` adds others.
    clamp : limit of what light after the first surface adds to a sample of `path` or `volpath`; 0: none. The channels
        "clamped.R", "clamped.G", "clamped.B" are what it takes away.
    threads : 0: all. No bit depends on it.
    """
    library = _library()
    loaded, texts = _scene(scene, definitions), Texts()
    options = library.options(
        "render_options", integrator=texts(integrator), sampler=texts(sampler), filter=texts(filter),
        samples_per_pixel=spp, seed=seed, threads=threads, width=width, height=height, clamp=clamp,
    )  # fmt: skip
    if crop is not None:
        options.crop_x0, options.crop_x1, options.crop_y0, options.crop_y1 = crop
    image = ffi.new("aur_image **")
    renderer = library.make("renderer", loaded._scene, alive=(loaded,))
    with _Call(progress) as call:
        call.attach(options)
        if error is None:
            library.call(library.lib.aur_renderer_render, renderer, options, image, ffi.NULL)
        else:
            measure = ffi.new("aur_error_measure *")
            library.call(library.lib.aur_error_measure_from_name, texts(error_measure), measure)
            target = library.options("adaptive_options", error=error, measure=measure[0])
            adaptive = library.make("adaptive", renderer, options, target, alive=(renderer, call))
            library.call(library.lib.aur_adaptive_run, adaptive)
            library.call(library.lib.aur_adaptive_develop, adaptive, False, image)
    array, names = _image_array(library.own("image", image))
    return _select(array, names, channels or ("R", "G", "B"))


def _image_array(image: Any) -> tuple[ImageArray, list[str]]:
    """The library's image as it lies there, and the names of its channels."""
    library = _library()
    lib = library.lib
    shape = lib.aur_image_height(image), lib.aur_image_width(image), lib.aur_image_channel_count(image)
    names = [library.text(lib.aur_image_channel_name(image, index)) or "" for index in range(shape[2])]
    return view_of(library, image, lib.aur_image_data(image), shape, "<f4"), names


def _select(array: ImageArray, names: list[str], chosen: Sequence[str]) -> ImageArray:
    for name in chosen:
        if name not in names:
            raise ArgumentError(f"no channel {name!r}; there are {', '.join(names)}")
    indices = [names.index(name) for name in chosen]
    first = indices[0]
    if indices == list(range(first, first + len(indices))):
        return array[:, :, first : first + len(indices)]
    return array[:, :, indices]


def read_image(path: Path) -> tuple[ImageArray, list[str]]:
    """An image (height, width, channels) of float32 and the names of its channels: EXR, PFM, HDR, PNG or JPEG.

    PNG and JPEG are decoded from sRGB to linear.
    """
    library, image = _library(), ffi.new("aur_image **")
    library.call(library.lib.aur_image_read, encode(path), image)
    return _image_array(library.own("image", image))


def _wrap(image: Union[ArrayLike, Path]) -> tuple[Any, Any]:
    """The library's image about an array, without a copy where it is of float32, and the array; or about a file's."""
    library, pointer = _library(), ffi.new("aur_image **")
    if isinstance(image, (str, os.PathLike)):
        library.call(library.lib.aur_image_read, encode(image), pointer)
        return library.own("image", pointer), None
    array = np.ascontiguousarray(image, dtype=np.float32)
    if array.ndim == 2:
        array = array[:, :, np.newaxis]
    if array.ndim != 3:
        raise ArgumentError(f"an image must have the shape (height, width, channels), not {array.shape}")
    height, width, channels = array.shape
    library.call(library.lib.aur_image_wrap, width, height, channels, library.output(array, "float"), pointer)
    return library.own("image", pointer), array


@renamed_keyword("picture", "image")
def write_image(
    path: Path, image: ArrayLike, *, channels: Optional[Sequence[str]] = None, exposure: float = 0.0,
    tone: str = "srgb", half: bool = False,
) -> None:  # fmt: skip
    """Writes an image (height, width, channels), by the end of the file's name: .exr, .pfm, .hdr or .png.

    `channels`: their names, for EXR; None: Y; Y, A; R, G, B; R, G, B, A. `exposure` in stops and `tone` ("srgb", "filmic")
    are for PNG; `half`: 16-bit floats in EXR.
    """
    library = _library()
    wrapped, _array = _wrap(image)
    for index, name in enumerate(channels or ()):
        library.call(library.lib.aur_image_name_channel, wrapped, index, encode(name))
    options = library.options("image_write_options", exposure=exposure, tone=library.value("tone", tone), half=half)
    library.call(library.lib.aur_image_write, encode(path), wrapped, options)


@renamed_keyword("picture", "image")
def compare(reference: Union[ArrayLike, Path], image: Union[ArrayLike, Path], metric: str = "rmse") -> float:
    """A figure of the difference of two images of one size, over R, G and B: arrays (height, width, 3) or files.

    `metric`: "rmse", "mse", "mae", "relmse", "mrse", "relative-rmse" or "flip" (Andersson et al. 2020).
    """
    library = _library()
    (first, _a), (second, _b), value = _wrap(reference), _wrap(image), ffi.new("double[4]")
    kind = ffi.new("aur_image_metric *")
    library.call(library.lib.aur_image_metric_from_name, encode(metric), kind)
    library.call(library.lib.aur_image_compare, first, second, kind[0], value)
    return value[3]


@renamed_keyword("picture", "image")
def flip(reference: Union[ArrayLike, Path], image: Union[ArrayLike, Path]) -> ImageArray:
    """LDR-FLIP of each pixel (height, width), in [0, 1] (Andersson et al. 2020)."""
    library = _library()
    (first, _a), (second, _b), pointer = _wrap(reference), _wrap(image), ffi.new("aur_image **")
    library.call(library.lib.aur_image_flip, first, second, pointer)
    return _image_array(library.own("image", pointer))[0][:, :, 0]


class Irradiance(NamedTuple):
    """What sensors receive: arrays (n, 4) of r, g, b and luminance, in the scene's radiance times steradians."""

    total: Array
    direct: Array  #: straight from lights
    sky: Array  #: straight from the sky
    reflected: Array  #: reflected or refracted on its way
    sun: Array  #: straight from the sun
    error: dict[str, Array]  #: standard errors of each of these, by name
    half_width: Array  #: of the interval of the total
    directions: NDArray[np.uint64]  #: (n,)
    dark: Array  #: (n,): the share of directions that meet the black back of a surface
    on_surface: NDArray[np.bool_]  #: (n,): the sensor lay on one, and looked from just above
    doubtful: NDArray[np.bool_]  #: (n,): surfaces there are too near to each other to tell what covers the sensor


def irradiance(
    scene: Union[Scene, Path], positions: ArrayLike, normals: ArrayLike, *, directions: int = 0, error: float = 0.0,
    confidence: float = 0.0, max_depth: int = 0, set: Optional[str] = None, reflected: str = "paths",
    particles: int = 0, seed: int = 0, threads: int = 0, definitions: Optional[Mapping[str, Any]] = None,
    progress: Optional[Progress] = None,
) -> Irradiance:  # fmt: skip
    """The light that arrives at sensors: positions (n, 3) in scene units that look along normals (n, 3).

    `directions` from each sensor, 0: 16384; or `error`: each goes on until half of its interval is at most this part of its
    luminance. `max_depth`: edges of a light path, 1 is light straight from lights and sky, 0: no limit. `reflected`: "paths",
    "map" (a photon map) or "radiosity", with `particles` of these. Without bias at a given number of directions.
    """
    library, texts = _lighting(), Texts()
    lib = library.lib
    loaded, where, along = _scene(scene, definitions), rows(positions, 3, "positions"), rows(normals, 3, "normals")
    if len(where) != len(along):
        raise ArgumentError(f"{len(where)} positions and {len(along)} normals")
    view = library.options(
        "sensors_view", count=len(where), positions=library.input(where), normals=library.input(along)
    )
    options = library.options(
        "irradiance_options", set=texts(set), directions=directions, error=error, confidence=confidence,
        max_depth=max_depth, seed=seed, threads=threads, reflected=library.value("reflected", reflected), particles=particles,
    )  # fmt: skip
    row = np.dtype(
        {
            "names": ["value", "error", "half_width", "directions", "dark", "on_surface", "doubtful"],
            "formats": [("<f8", (5, 4)), ("<f8", (5, 4)), ("<f8", 4), "<u8", "<f8", "?", "?"],
            "offsets": [ffi.offsetof("aur_irradiance", name) for name in
                        ("value", "error", "half_width", "directions", "dark", "on_surface", "doubtful")],
            "itemsize": ffi.sizeof("aur_irradiance"),
        }
    )  # fmt: skip
    found = np.zeros(len(where), dtype=row)
    with _Call(progress) as call:
        library.call(
            lib.aur_irradiance_estimate, loaded._scene, view, call.attach(options), row.itemsize,
            library.output(found, "aur_irradiance"),
        )  # fmt: skip
    values = found["value"]
    return Irradiance(
        values[:, 0], values[:, 1], values[:, 2], values[:, 3], values[:, 4],
        {name: found["error"][:, part] for part, name in enumerate(("total", "direct", "sky", "reflected", "sun"))},
        found["half_width"], found["directions"], found["dark"], found["on_surface"],
        found["doubtful"],
    )  # fmt: skip

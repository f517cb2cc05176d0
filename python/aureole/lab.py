"""The lab: the papers' experiments, and new ones as functions of Python.

An experiment fills a table row by row; verdicts on published values, claims, intervals, plots, the report and going on after an
interruption follow from what it declares:

    from aureole import lab

    @lab.experiment(columns="set points rmse", plots=[lab.Plot("rmse", x="points", y="rmse", series="set", log_x=True, log_y=True)])
    def my_errors(run):
        for name in run.sets("sobol", "r2"):
            for n in (16, 64, 256):
                run.row(name, n, error_of(name, n))
        run.claim(True, "something that a paper states")

    if __name__ == "__main__":
        lab.main(my_errors)  # python mine.py --quick --set 'file:mine-%d.csv' -o results --report report

All of this module may change in any version. It needs libaureole-lab (see `aureole.render_library`).
"""

from __future__ import annotations

import argparse
import contextlib
import csv
import math
import os
import pathlib
from typing import Any, Callable, Iterator, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._bridge import CANCELLED, Bridge, Error, Progress, UnknownNameError, encode, renamed_keyword
from ._library import ffi
from ._render import Path, Texts, _Call, _library, _wrap

Cell = Union[str, float, int, None]


def _lab() -> Bridge:
    library = _library()
    try:
        library.lib.lab_add
    except (AttributeError, ffi.error) as error:
        raise ImportError(f"experiments need libaureole-lab, which has not been loaded: {error}") from None
    return library


class Plot(NamedTuple):
    """Which columns are drawn, and how. Where several make a name, commas stand between them."""

    name: str  #: a part of file names
    x: str
    y: str
    title: str = ""
    low: Optional[str] = None  #: the interval of y
    high: Optional[str] = None
    series: Optional[str] = None  #: columns whose words name a line
    panel: Optional[str] = None  #: columns whose words name a panel
    table: Optional[str] = None  #: a further table; None: the first
    log_x: bool = False
    log_y: bool = False
    points: bool = False  #: no lines between the points


class Interval(NamedTuple):
    value: float
    low: float
    high: float


class Table:
    """A further table of a run: NAME-<name>.csv."""

    def __init__(self, pointer: Any):
        self._pointer = pointer

    def row(self, *cells: Cell) -> None:
        """Texts, and numbers after them."""
        texts = Texts()
        split = next((i for i, cell in enumerate(cells) if not isinstance(cell, str)), len(cells))
        numbers = [math.nan if cell is None else float(cell) for cell in cells[split:]]
        words = ffi.new("const char *[]", [texts(cell) for cell in cells[:split]] + [ffi.NULL])
        _lab().lib.lab_table_row(self._pointer, words, len(numbers), ffi.new("double[]", numbers))


class Run:
    """What an experiment's function is given."""

    def __init__(self, pointer: Any):
        self._lib, self._pointer = _lab(), pointer
        self._options = self._lib.lib.lab_run_options(pointer)

    @property
    def quick(self) -> bool:
        """Whether a form that takes seconds is wanted."""
        return bool(self._options.quick)

    @property
    def set(self) -> Optional[str]:
        """One more set to compare."""
        return self._lib.text(self._options.set)

    @property
    def threads(self) -> int:
        return int(self._options.threads)

    def sets(self, *names: str) -> list[str]:
        """The names, and the set of the run after them."""
        return [*names, self.set] if self.set is not None else list(names)

    def __getitem__(self, name: str) -> Any:
        """The value of a parameter: an int, a float, or a text."""
        text = self._lib.text(self._lib.lib.lab_parameter_text(self._pointer, encode(name)))
        if text is None:
            raise KeyError(name)
        for kind in (int, float):
            try:
                return kind(text)
            except ValueError:
                continue
        return text

    def row(self, *cells: Cell) -> None:
        """A row of the table: texts and numbers in the order of the columns; None and NaN leave a cell empty."""
        for cell in cells:
            if cell is None or isinstance(cell, str):
                self._lib.lib.lab_text(self._pointer, ffi.NULL if cell is None else encode(cell))
            elif math.isnan(cell):
                self._lib.lib.lab_text(self._pointer, ffi.NULL)
            else:
                self._lib.lib.lab_number(self._pointer, float(cell))

    def note(self, text: str) -> None:
        self._lib.lib.lab_note(self._pointer, b"%s", ffi.new("char[]", encode(text)))

    def claim(self, holds: bool, text: str) -> None:
        """A claim in words, in a note that says whether it holds in what was measured."""
        self._lib.lib.lab_claim(self._pointer, bool(holds), b"%s", ffi.new("char[]", encode(text)))

    def requested(self, name: str) -> bool:
        """Whether the row of that name is to be computed: --rows selects rows."""
        return bool(self._lib.lib.lab_row_requested(self._pointer, encode(name)))

    def cached(self, key: str, count: int, function: Callable[[], ArrayLike]) -> NDArray[np.float64]:
        """The `count` numbers of `function()`, or those that an interrupted run stored under this key.

        For work of a second and more. `key` is a line without a colon at its end, and used once.
        """
        values = ffi.new("double[]", count)
        if not self._lib.lib.lab_recall(self._pointer, encode(key), count, values):
            found = np.asarray(function(), dtype=np.float64).ravel()
            if found.shape != (count,):
                raise ValueError(f"{key}: expected {count} numbers, not {found.size}")
            values[0:count] = list(found)
            self._lib.call(self._lib.lib.lab_save, self._pointer, encode(key), count, values)
        return np.array(list(values))

    def table(self, name: str, columns: Union[str, Sequence[str]]) -> Table:
        texts = Texts()
        words = ffi.new("const char *[]", [texts(column) for column in _columns(columns)] + [ffi.NULL])
        _alive.append(texts(name))
        pointer = self._lib.lib.lab_table(self._pointer, _alive[-1], words)
        if pointer == ffi.NULL:
            raise MemoryError("too many tables")
        return Table(pointer)

    @renamed_keyword("picture", "image")
    def image(
        self, name: str, image: ArrayLike, *, view: Optional[str] = None, reference: bool = False, exposure: float = 0.0
    ) -> None:
        """An image of the report (height, width, channels). Those of one view are compared with its reference."""
        texts = Texts()
        wrapped, _array = _wrap(image)
        position = ffi.new("lab_image_position *", {"view": texts(view), "name": texts(name), "reference": reference})
        position.exposure = exposure
        self._lib.call(self._lib.lib.lab_image, self._pointer, position, wrapped)

    wants, keep, picture = requested, cached, image  # names of version 0.1, to be removed in the next version

    @contextlib.contextmanager
    def forgive(self, set: str) -> Iterator[None]:
        """Lets the set of the run fail, as at a size without a file: a note says so."""
        try:
            yield
        except Error as error:
            failure = ffi.new("aur_error *")
            text = str(error).encode()[:1000]
            ffi.memmove(failure.message, text + b"\0", len(text) + 1)
            if self._lib.lib.lab_forgive(self._pointer, encode(set), -10, failure) != 0:
                raise


def _columns(columns: Union[str, Sequence[str]]) -> list[str]:
    return columns.split() if isinstance(columns, str) else list(columns)


_alive: list[Any] = []  # experiments stay known to the lab, by their names


class Experiment:
    """A function and what it declares; `experiment` makes it."""

    def __init__(self, function: Callable[[Run], None], name: str, **declared: Any):
        self.function, self.name, self._declared = function, name, declared
        self._pointer: Any = None
        self.raised: Optional[BaseException] = None

    def __call__(self, **options: Any) -> "Result":
        return run(self, **options)

    def _call(self, pointer: Any, error: Any) -> int:
        try:
            self.function(Run(pointer))
            return 0
        except BaseException as reason:
            self.raised = reason
            return CANCELLED

    def add(self) -> Any:
        """Makes the experiment known to the lab, for `run` by its name and `report`."""
        if self._pointer is not None:
            return self._pointer
        library, texts, d = _lab(), Texts(), self._declared
        plots = ffi.new("report_plot[]", len(d["plots"]) + 1)
        for plot_row, plot in zip(plots, d["plots"]):
            for field, value in plot._asdict().items():
                setattr(plot_row, field, value if isinstance(value, bool) else texts(value))
            plot_row.title = texts(plot.title or plot.name)
        parameters = ffi.new("lab_parameter[]", len(d["parameters"]) + 1)
        for parameter_row, (name, value) in zip(parameters, d["parameters"].items()):
            parameter_row.name, parameter_row.default_text, parameter_row.help = texts(name), texts(str(value)), texts("")
        columns = ffi.new("const char *[]", [texts(column) for column in d["columns"]] + [ffi.NULL])
        call = ffi.callback("aur_result(lab_run *, aur_error *)", self._call, error=CANCELLED)
        pointer = ffi.new("lab_experiment *", {"columns": columns, "plots": plots, "parameters": parameters, "run": call})
        pointer.name = texts(self.name)
        for field in ("reproduces", "summary", "rows", "measured", "low", "high", "published", "takes_no_set"):
            setattr(pointer, field, texts(d[field]))
        pointer.factor, pointer.seconds, pointer.quick_seconds = d["factor"], d["seconds"], d["quick_seconds"]
        one = ffi.new("const lab_experiment *[]", [pointer])
        _add(library, texts, experiment_count=1, experiments=one)
        _alive.append((self, texts, plots, parameters, columns, call, pointer, one))
        self._pointer = pointer
        return pointer


def _add(library: Bridge, texts: Texts, **fields: Any) -> None:
    module = ffi.new("lab_module *", {"size": ffi.sizeof("lab_module"), **fields})
    module.version = texts(library.text(library.lib.aur_version()))
    library.call(library.lib.lab_add, module)


def experiment(
    *, columns: Union[str, Sequence[str]], name: Optional[str] = None, reproduces: str = "none", summary: Optional[str] = None,
    measured: Optional[str] = None, low: Optional[str] = None, high: Optional[str] = None, published: Optional[str] = None,
    factor: float = 1.1, plots: Sequence[Plot] = (), parameters: Optional[Mapping[str, Any]] = None, rows: Optional[str] = None,
    takes_no_set: Optional[str] = None, seconds: float = 1.0, quick_seconds: float = 1.0,
) -> Callable[[Callable[[Run], None]], Experiment]:  # fmt: skip
    """Makes an experiment of a function, which is called with a `Run`.

    `columns` of the table. `measured`, `low`, `high` and `published` name columns: where something is published, the row gets a
    verdict, "agrees" where it lies in the interval, "within a factor of ..." up to `factor`, or "differs". `parameters`: names
    and defaults. `rows` says what rows are named by, for `Run.wants`; `takes_no_set` why no set is added. `seconds` and
    `quick_seconds` of processor time are for the estimate before it starts. The name is the function's, with "-" for "_".
    """

    def make(function: Callable[[Run], None]) -> Experiment:
        return Experiment(
            function, name or function.__name__.replace("_", "-"), columns=_columns(columns), reproduces=reproduces,
            summary=summary or (function.__doc__ or "").strip().split("\n")[0].rstrip("."), measured=measured, low=low,
            high=high, published=published, factor=factor, plots=list(plots), parameters=dict(parameters or {}), rows=rows,
            takes_no_set=takes_no_set, seconds=seconds, quick_seconds=quick_seconds,
        )  # fmt: skip

    return make


class Result(NamedTuple):
    table: dict[str, list[Any]]  #: column by column: numbers, texts, None for an empty cell
    notes: list[str]
    verdicts: dict[str, int]  #: rows that agree, are within the factor, differ, have nothing published
    claims: int
    claims_held: int
    files: list[str]  #: what was written
    seconds: float  #: of the processors


def _cell(text: str) -> Any:
    try:
        return float(text) if text else None
    except ValueError:
        return text


def integrand(
    name: str, function: Callable[[NDArray[np.float64]], ArrayLike], *, domain: str = "square", dimension: int = 0,
    mean: float = math.nan,
) -> None:  # fmt: skip
    """Makes a function of points, (n, d) to n values, an integrand of the experiment aureole-integrand.

    `mean` over the domain (square, cube of `dimension`, disk, hemisphere, sphere), where it is known.
    """
    library, texts = _lab(), Texts()

    def evaluate(user: Any, count: int, width: int, points: Any, values: Any, error: Any) -> int:
        try:
            given = np.frombuffer(ffi.buffer(points, 8 * count * width)).reshape(count, width).copy()
            np.frombuffer(ffi.buffer(values, 8 * count))[:] = np.asarray(function(given), dtype=np.float64).reshape(count)
            return 0
        except Exception as reason:
            text = f"integrand '{name}': {type(reason).__name__}: {reason}".encode()[:1000]
            ffi.memmove(error.message, text + b"\0", len(text) + 1)
            return -10

    call = ffi.callback(
        "aur_result(void *, size_t, size_t, const double *, double *, aur_error *)", evaluate, error=CANCELLED
    )
    pointer = ffi.new("lab_named_integrand *", {"dimension": dimension, "evaluate": call, "mean": mean})
    pointer.name, pointer.domain = texts(name), library.value("domain", domain)
    _add(library, texts, integrand_count=1, integrands=pointer)
    _alive.append((texts, call, pointer))


def run(
    experiment: Union[Experiment, str], *, folder: Path = "lab-results", quick: bool = False, set: Optional[str] = None,
    rows: Optional[str] = None, scenes: Optional[Path] = None, threads: int = 0, progress: Optional[Progress] = None,
    **parameters: Any,
) -> Result:  # fmt: skip
    """Runs an experiment, one of the papers by its name or a new one, and writes FOLDER/NAME.

    A run that was interrupted goes on. `set`: one more set to compare, also "callback:NAME" (`register_set`). Parameters of the
    experiment are further keywords.
    """
    library, texts, result = _lab(), Texts(), ffi.new("lab_result *")
    pointer = experiment.add() if isinstance(experiment, Experiment) else library.lib.lab_find_experiment(encode(experiment))
    if pointer == ffi.NULL:
        raise UnknownNameError(f"unknown experiment '{experiment}'")
    os.makedirs(folder, exist_ok=True)
    options = ffi.new("lab_options *", {"quick": quick, "threads": threads})
    for field, value in {"set": set, "rows": rows, "scenes": scenes, "folder": folder}.items():
        setattr(options, field, texts(value))
    definitions = texts.definitions(parameters)
    options.parameter_count, options.parameters = definitions["definition_count"], definitions["definitions"]
    if isinstance(experiment, Experiment):
        experiment.raised = None
    with _Call(progress) as call:
        call.attach(options)
        try:
            library.call(library.lib.lab_run_experiment, pointer, options, result)
        except Error:
            if isinstance(experiment, Experiment) and experiment.raised is not None:
                raise experiment.raised from None
            raise
        finally:
            found = Result(
                {}, (library.text(result.notes) or "").splitlines(),
                dict(zip(("agrees", "within", "differs", "unpublished"), map(int, result.verdicts))), int(result.claims),
                int(result.claims_held), (library.text(result.files) or "").splitlines(), float(result.seconds),
            )  # fmt: skip
            library.lib.lab_result_release(result)
    name = library.text(pointer.name) or ""
    lines = pathlib.Path(folder, name, f"{name}.csv").read_text().splitlines()
    read = list(csv.reader(line for line in lines if not line.startswith("#")))
    return found._replace(table={title: [_cell(row[i]) for row in read[1:]] for i, title in enumerate(read[0])})


def report(results: Path = "lab-results", folder: Path = "lab-report", *, small: bool = False) -> str:
    """Writes the page of all results in a folder, of experiments that this process knows; returns its path."""
    library, path = _lab(), ffi.new("char[1024]")
    os.makedirs(folder, exist_ok=True)
    library.call(library.lib.lab_publish, encode(results), encode(folder), small, path)
    return library.text(path) or ""


def root_mean(squares: ArrayLike) -> Interval:
    """The root of the mean of squared errors of independent randomisations, with its interval of 95 %."""
    return _interval("root_mean", squares)


def slope(x: ArrayLike, y: ArrayLike) -> Interval:
    """The slope of log y against log x by least squares, with its interval of 95 %."""
    return _interval("slope", x, y)


def _interval(kind: str, *arrays: ArrayLike) -> Interval:
    given = [ffi.new("double[]", list(np.asarray(array, dtype=np.float64).ravel())) for array in arrays]
    found = getattr(_lab().lib, f"lab_{kind}")(len(given[0]), *given)
    return Interval(found.value, found.low, found.high)


def main(*experiments: Experiment, argv: Optional[Sequence[str]] = None) -> None:
    """A command line for experiments: all of them, or those that are named; prints the notes and what was written."""
    parser = argparse.ArgumentParser()
    parser.add_argument("name", nargs="*", help=", ".join(e.name for e in experiments))
    parser.add_argument("-o", "--output", default="lab-results", metavar="DIR")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--set")
    parser.add_argument("--rows", metavar="PATTERN")
    parser.add_argument("-D", "--define", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("-t", "--threads", type=int, default=0, metavar="N")
    parser.add_argument("--report", metavar="DIR", help="make a page of the results")
    given = parser.parse_args(argv)
    named = {e.name: e for e in experiments}
    for name in given.name or named:
        if name not in named:
            parser.error(f"unknown experiment '{name}'")
        found = run(
            named[name], folder=given.output, quick=given.quick, set=given.set, rows=given.rows, threads=given.threads,
            **dict(definition.split("=", 1) for definition in given.define),
        )  # fmt: skip
        print(f"{name}:", *found.notes, "written:", *found.files, sep="\n  ")
    if given.report:
        print(report(given.output, given.report))

"""Calls of the C libraries: errors become exceptions, warnings Python's warnings, arrays pointers without copies."""

from __future__ import annotations

import functools
import operator
import os
import warnings
from typing import Any, Callable, Optional, TypeVar, Union

import numpy as np

Progress = Callable[[str, int, int], Any]
Seed = Union[None, int, np.integer, np.random.SeedSequence, np.random.BitGenerator, np.random.Generator, np.random.RandomState]
_Self = TypeVar("_Self", bound="Call")
_Rebuilt = TypeVar("_Rebuilt", bound="Rebuilt")
_Function = TypeVar("_Function", bound=Callable[..., Any])


def renamed_keyword(old: str, new: str) -> Callable[[_Function], _Function]:
    """For functions whose parameter has a new name: the old one is accepted in this version, with a DeprecationWarning."""

    def decorate(function: _Function) -> _Function:
        @functools.wraps(function)
        def renamed(*arguments: Any, **keywords: Any) -> Any:
            if old in keywords and new not in keywords:
                warnings.warn(f"{function.__name__}: {old}= is {new}= now", DeprecationWarning, stacklevel=2)
                keywords[new] = keywords.pop(old)
            return function(*arguments, **keywords)

        return renamed  # type: ignore[return-value]

    return decorate


class Error(Exception):
    """What a function of Aureole raises: the message is the library's own.

    `result` is the kind of error in a few words; `file` is the file concerned or "", `line` and `column` count from 1
    and are 0 where there is none.
    """

    result = ""
    file = ""
    line = 0
    column = 0


class ArgumentError(Error, ValueError):
    """An argument is out of its range, or is given in a form that cannot be meant."""


class UnknownNameError(Error, ValueError):
    """There is no such set, measure, plugin or key; the message suggests the nearest name."""


class UnsupportedError(Error, ValueError):
    """Each argument is valid, but together they have no meaning or no implementation."""


class FormatError(Error, ValueError):
    """A file or text is not what it should be."""


class OpenError(Error, OSError):
    """A file cannot be opened or read."""


class WriteError(Error, OSError):
    """A file cannot be written."""


class OutOfMemoryError(Error, MemoryError):
    """An allocation failed."""


class CancelledError(Error):
    """The progress function asked to stop."""


class InternalError(Error, RuntimeError):
    """A defect of the library."""


class AureoleWarning(UserWarning):
    """What is worth saying and is no error, such as a size at which a set is not as even as at others."""


class IntegrationWarning(AureoleWarning):
    """A reason not to trust the interval of an integral, or a target that was not reached."""


_ERRORS = {
    -1: InternalError, -2: OutOfMemoryError, -3: CancelledError, -10: ArgumentError, -11: ArgumentError,
    -12: UnknownNameError, -13: UnsupportedError, -20: FormatError, -30: OpenError, -31: WriteError,
}  # fmt: skip

CANCELLED = -3


class Bridge:
    """One C library: `ffi` knows its types, `lib` its functions."""

    def __init__(self, ffi: Any, lib: Any):
        self.ffi = ffi
        self.lib = lib

    def text(self, pointer: Any) -> Optional[str]:
        return None if pointer == self.ffi.NULL else self.ffi.string(pointer).decode("utf-8", "replace")

    def check(self, result: int, error: Any) -> None:
        """Raises what `error` says unless the result is 0."""
        if result == 0:
            return
        message = self.text(error.message) or self.text(self.lib.aur_result_string(result)) or ""
        file = self.text(error.file) or ""
        location = ":".join([file] * bool(file) + [str(n) for n in (error.line, error.column) if n])
        raised = _ERRORS.get(result, InternalError)(f"{location}: {message}" if location else message)
        raised.result = self.text(self.lib.aur_result_string(result)) or ""
        raised.file, raised.line, raised.column = file, error.line, error.column
        raise raised

    def call(self, function: Any, *arguments: Any) -> None:
        """Calls a function whose last argument is an aur_error, and raises what it says."""
        error = self.ffi.new("aur_error *")
        try:
            result = function(*arguments, error)
        except OverflowError as reason:
            raise ArgumentError(f"a number is out of range: {reason}") from reason
        self.check(result, error)

    def make(self, kind: str, *arguments: Any, alive: Any = None) -> Any:
        """What `aur_KIND_create(..., &made, error)` makes; it is destroyed with the last reference to it, before `keep`."""
        pointer = self.ffi.new(f"aur_{kind} **")
        self.call(getattr(self.lib, f"aur_{kind}_create"), *arguments, pointer)
        return self.own(kind, pointer, alive)

    def own(self, kind: str, pointer: Any, alive: Any = None) -> Any:
        destroy = getattr(self.lib, f"aur_{kind}_destroy")
        return self.ffi.gc(pointer[0], destroy if alive is None else lambda pointer, alive=alive: destroy(pointer))

    def value(self, kind: str, name: str) -> int:
        """The value of the enumeration aur_KIND that a name stands for."""
        found = self.ffi.new(f"aur_{kind} *")
        self.call(getattr(self.lib, f"aur_{kind}_from_name"), encode(name), found)
        return found[0]

    def options(self, kind: str, **fields: Any) -> Any:
        """A new aur_KIND, zero but for its size and the fields given; texts and arrays in it live as long as it does."""
        struct = self.ffi.new(f"aur_{kind} *")
        struct.size = self.ffi.sizeof(f"aur_{kind}")
        return self.fill(struct, **fields)

    def initialize(self, struct: Any, init: Any, *inputs: Any) -> None:
        """Fills a struct of options with its defaults by `aur_KIND_init(*inputs, struct, error)`."""
        struct.size = self.ffi.sizeof(struct[0])
        self.call(init, *inputs, struct)

    def fill(self, struct: Any, **fields: Any) -> Any:
        for name, value in fields.items():
            try:
                setattr(struct, name, seed_number(value) if name == "seed" else value)
            except OverflowError as error:
                raise ArgumentError(f"{name}: {value} is out of range") from error
        return struct

    def input(self, array: np.ndarray, kind: str = "double") -> Any:
        """A pointer to an array that is only read. The caller keeps the array."""
        return self.ffi.cast(f"const {kind} *", array.__array_interface__["data"][0])

    def output(self, array: np.ndarray, kind: str = "double") -> Any:
        return self.ffi.cast(f"{kind} *", array.__array_interface__["data"][0])


class Call:
    """What one call of a library may call back: its progress, its warnings, a function; and what these raise."""

    def __init__(self, progress: Optional[Progress] = None, function: Optional[Callable[..., Any]] = None):
        self.progress = progress
        self.function = function
        self.count = 0  # of values that the function returns, where the library does not say it
        self.messages: list[str] = []
        self.category: type = AureoleWarning  # of the messages
        self.depth = 3  # frames from the warning to the user's
        self.raised: Optional[BaseException] = None

    def report(self, what: str, done: int, total: int) -> int:
        """What the library's progress function returns: not 0 to stop."""
        if self.raised is not None:
            return 1
        try:
            return 1 if self.progress is not None and self.progress(what, done, total) else 0
        except BaseException as error:  # also KeyboardInterrupt: it goes on where the call ends
            self.raised = error
            return 1

    def interrupt(self, kind: Any, error: Any, trace: Any) -> None:
        """An interrupt that arrived before `report` could note it."""
        self.raised = error

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        if self.raised is not None:
            raise self.raised
        for message in self.messages if error is None else ():
            warnings.warn(message, self.category, stacklevel=self.depth)


class Rebuilt:
    """Pickled, copied and printed by the arguments that it was made with; what the library has of it is made again."""

    _arguments: tuple[tuple[Any, ...], dict[str, Any]]

    def __new__(cls: type[_Rebuilt], *arguments: Any, **named: Any) -> _Rebuilt:
        rebuilt = super().__new__(cls)
        rebuilt._arguments = arguments, named
        return rebuilt

    def __reduce__(self) -> tuple[Any, ...]:
        arguments, named = self._arguments
        return functools.partial(type(self), **named), arguments

    def __repr__(self) -> str:
        arguments, named = self._arguments
        texts = [*map(repr, arguments), *(f"{name}={value!r}" for name, value in named.items())]
        return f"{type(self).__name__}({', '.join(texts)})"

    def _reseed(self, seed: Seed) -> int:
        """The number that `seed` gives now, which copies are made with too."""
        number = seed_number(seed)
        if "seed" in self._arguments[1]:
            self._arguments[1]["seed"] = number
        return number


def seed_number(seed: Seed) -> int:
    """A seed as the library takes it, 64 bits. Integers below 2^64 are themselves, larger ones are hashed.

    A Generator or RandomState draws a number, so that each use gives another one; None takes one of the system's.
    """
    try:
        number = operator.index(seed)  # type: ignore[arg-type]
    except TypeError:
        return _draw(seed)
    if number < 0:
        raise ArgumentError(f"seed must be at least 0, not {number}")
    return number if number < 2**64 else _draw(np.random.SeedSequence(number))


def _draw(seed: Any) -> int:
    if isinstance(seed, np.random.BitGenerator):
        seed = np.random.Generator(seed)
    if isinstance(seed, np.random.Generator):
        return int(seed.integers(2**63))
    if isinstance(seed, np.random.RandomState):
        return int(seed.randint(2**63, dtype=np.int64))
    if seed is None or isinstance(seed, np.random.SeedSequence):
        return int((seed or np.random.SeedSequence()).generate_state(1, np.uint64)[0])
    raise TypeError(f"seed must be an integer, None or one of NumPy's random generators, not {type(seed).__name__} {seed!r}")


def as_array(array: Any, dtype: Any = np.float64) -> np.ndarray:
    """An array of NumPy's of what is one, is like one, or exports one by DLPack; without a copy where the type is right."""
    if not hasattr(array, "__array__") and hasattr(array, "__dlpack__"):
        try:
            array = np.from_dlpack(array)
        except (BufferError, RuntimeError, TypeError, ValueError) as error:
            raise ArgumentError(f"{type(array).__name__}: not in the memory of this processor ({error}): copy it first") from error
    if np.ma.is_masked(array) or np.iscomplexobj(array) and np.dtype(dtype).kind != "c":
        raise ArgumentError("masked values are no numbers" if np.ma.is_masked(array) else "complex numbers are not real ones")
    return np.asarray(array, dtype=dtype)


def encode(text: Any) -> bytes:
    """A text or path as the library takes it."""
    if not isinstance(text, (str, bytes, os.PathLike)):
        raise TypeError(f"expected a text or a path, not {type(text).__name__}")
    coded = os.fsencode(text)
    if b"\0" in coded:
        raise ArgumentError("a text with a zero byte in it")
    return coded


def rows(array: Any, dimension: int = 0, name: str = "points") -> np.ndarray:
    """An array of double precision with a row a point; it is copied only where its type or layout asks for it."""
    converted = as_array(array)
    if converted.ndim == 1 and dimension == 1:
        converted = converted[:, np.newaxis]
    if converted.ndim != 2 or (dimension and converted.shape[1] != dimension):
        expected = dimension if dimension else "d"
        raise ArgumentError(f"{name} must have the shape (n, {expected}), not {converted.shape}")
    return np.ascontiguousarray(converted)


def vector(array: Any, count: int, name: str) -> np.ndarray:
    converted = np.ascontiguousarray(as_array(array))
    if converted.shape != (count,):
        raise ArgumentError(f"{name} must have the shape ({count},), not {converted.shape}")
    return converted


class _View:
    """An array of the library's, for NumPy to look at in its place; it keeps what owns the array."""

    def __init__(
        self, owner: Any, address: int, shape: tuple[int, ...], kind: str, strides: Optional[tuple[int, ...]],
        domain: Optional[str],
    ):  # fmt: skip
        self.owner = owner
        self.domain = domain
        self.__array_interface__ = {
            "version": 3, "data": (address, False), "shape": shape, "typestr": kind, "strides": strides,
        }  # fmt: skip


def view_of(
    bridge: Bridge, owner: Any, pointer: Any, shape: tuple[int, ...], kind: str = "<f8",
    strides: Optional[tuple[int, ...]] = None, domain: Optional[str] = None,
) -> np.ndarray:  # fmt: skip
    """The library's array at `pointer` without a copy; `owner` lives as long as the array, which knows its `domain`."""
    if 0 in shape:
        return np.empty(shape, dtype=kind)
    return np.asarray(_View(owner, int(bridge.ffi.cast("uintptr_t", pointer)), shape, kind, strides, domain))


def view_domain(array: Any) -> Optional[str]:
    """The domain of points that the library made, where `array` is such an array or rows of one; else None."""
    while isinstance(array, np.ndarray):
        array = array.base
    return array.domain if isinstance(array, _View) else None

"""libaureole, which is part of the extension, and what it calls back."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np

from ._bridge import CANCELLED, Bridge, Call, Progress
from ._native import ffi as ffi
from ._native import lib as lib

core = Bridge(ffi, lib)


class CoreCall(Call):
    """A call of libaureole; the library hands `handle` back to the functions below."""

    def __init__(self, progress: Optional[Progress] = None, function: Optional[Callable[..., Any]] = None):
        super().__init__(progress, function)
        self.coordinates = 3  # of a point that the function is called with
        self.handle = ffi.new_handle(self)

    def attach(self, options: Any, progress: bool = True, warnings: bool = True) -> Any:
        """Lets an option struct report to this call."""
        if progress:
            options.progress = (lib.aureole_progress, self.handle)
        if warnings:
            options.warnings = (lib.aureole_warning, self.handle)
        return options


def _interrupt(kind: Any, error: Any, trace: Any) -> None:
    ffi.from_handle(trace.tb_frame.f_locals["user"]).interrupt(kind, error, trace)


@ffi.def_extern(error=1, onerror=_interrupt)
def aureole_progress(user, what, done, total):
    return ffi.from_handle(user).report(core.text(what), done, total)


@ffi.def_extern()
def aureole_warning(user, message):
    ffi.from_handle(user).messages.append(core.text(message))


def _values(user: Any, arguments: tuple, values: Any, count: int) -> int:
    """The user's function of `arguments` into values[count]."""
    call = ffi.from_handle(user)
    try:
        made = np.asarray(call.function(*arguments))
        if made.dtype.kind not in "biufO":  # NumPy would make numbers of strings, dates and records
            raise TypeError(f"the function must return real numbers, not {made.dtype}")
        np.frombuffer(ffi.buffer(values, 8 * count))[:] = made
    except BaseException as error:
        call.raised = error
        return CANCELLED
    return 0


def _copy(pointer: Any, *shape: int) -> np.ndarray:
    """The library's numbers in an array that the user's function may keep: theirs are gone after the call."""
    return np.frombuffer(ffi.buffer(pointer, 8 * int(np.prod(shape)))).reshape(shape).copy()


@ffi.def_extern(error=CANCELLED)
def aureole_integrand(user, count, points, along, values, error):
    call = ffi.from_handle(user)
    arguments = (_copy(points, count, call.coordinates),)
    if along != ffi.NULL:
        arguments += (_copy(along, count),)
    return _values(user, arguments, values, count * call.count)


@ffi.def_extern(error=CANCELLED)
def aureole_functional(user, points, values, error):
    arguments = (_copy(points.points, points.count, points.dimension), _copy(points.weights, points.count))
    return _values(user, arguments, values, ffi.from_handle(user).count)


@ffi.def_extern(error=CANCELLED)
def aureole_density(user, count, directions, values, error):
    return _values(user, (_copy(directions, count, 3),), values, count)

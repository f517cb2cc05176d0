"""Point sets that are functions of Python: callback:NAME for all that takes the name of a set."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np

from ._bridge import Bridge, FormatError, encode
from ._core import core, ffi, lib

_FORMAT = -20
_registered: dict[str, tuple[Any, ...]] = {}
_others: list[Bridge] = []  # libaureole-render has a libaureole of its own
_alive: list[Any] = []


def _fill(bridge: Bridge, source: Any, count: int, dimension: int, points: Any, weights: Any, error: Any) -> int:
    """Calls the function, and copies what it returns; what it raises becomes the library's message."""
    function, name, cube = source
    try:
        returned = function(count, dimension) if cube else function(count)
        array, given = returned if isinstance(returned, tuple) else (returned, None)
        found = np.ascontiguousarray(array, dtype=np.float64)
        if found.shape != (count, dimension):
            raise FormatError(f"expected an array of the shape ({count}, {dimension}), not {found.shape}")
        np.frombuffer(bridge.ffi.buffer(points, 8 * count * dimension)).reshape(count, dimension)[:] = found
        if weights != bridge.ffi.NULL:
            values = np.ascontiguousarray(given, dtype=np.float64)
            if values.shape != (count,):
                raise FormatError(f"expected {count} weights, not the shape {values.shape}")
            np.frombuffer(bridge.ffi.buffer(weights, 8 * count))[:] = values
        return 0
    except Exception as reason:
        text = f"set 'callback:{name}': {type(reason).__name__}: {reason}".encode()[:1000]
        error.result = _FORMAT
        bridge.ffi.memmove(error.message, text + b"\0", len(text) + 1)
        return _FORMAT


@ffi.def_extern(error=_FORMAT)
def aureole_set(user, count, dimension, points, weights, error):
    return _fill(core, ffi.from_handle(user), count, dimension, points, weights, error)


def _register(bridge: Bridge, name: str) -> None:
    source, domain, weighted, handle = _registered[name]
    text = bridge.ffi.new("char[]", encode(name))
    options = bridge.options("set_callback", name=text, weighted=weighted)
    options.domain = bridge.value("domain", domain)
    if bridge is core:
        options.user, options.generate = handle, lib.aureole_set
    elif source is not None:
        call = bridge.ffi.callback(
            "aur_result(void *, uint64_t, size_t, double *, double *, aur_error *)",
            lambda user, *arguments: _fill(bridge, source, *arguments),
            error=_FORMAT,
        )
        options.generate = call
        _alive.append(call)
    if source is None:
        options.generate = bridge.ffi.NULL
    bridge.call(bridge.lib.aur_set_register, options)


def attach(bridge: Bridge) -> None:
    """Lets the renderer's libraries know the sets, those registered later too."""
    _others.append(bridge)
    for name in _registered:
        _register(bridge, name)


def register_set(name: str, function: Optional[Callable[..., Any]], *, domain: str = "square", weighted: bool = False) -> None:
    """Makes a function the set "callback:NAME", which `points`, `measure`, `weights`, integrators of scenes and the lab take.

    `function(n)` returns the n points, an array (n, 2) on the square and the disk, (n, 3) of unit vectors, (n, 4) of quaternions
    w, x, y, z; with `domain` "cube" it is `function(n, dimension)`, of (n, dimension). With `weighted` it returns points and n
    weights, which should add up to 1. It is called from any thread, also more than once for the same n, and must give the same
    points then. `name`: letters, digits, "-", "_" and "."; the function takes the place of an earlier one, and None removes that.

    >>> import numpy as np
    >>> register_set("grid", lambda n: np.stack([(np.arange(n) + 0.5) / n, np.arange(n) * 0.618 % 1], axis=1))
    >>> points("callback:grid", 4).shape
    (4, 2)
    """
    source = None if function is None else (function, name, domain == "cube")
    handle = ffi.new_handle(source)
    _alive.append(handle)  # sets may be made of it at any time
    _registered[name] = source, domain, weighted, handle
    for bridge in (core, *_others):
        _register(bridge, name)

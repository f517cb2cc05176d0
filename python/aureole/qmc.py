"""Engines for scipy.stats.qmc: every set of the square and the cube, and the sets of the sphere in equal-area coordinates.

The name of a class is that of the set: `larcher-pillichshammer` is `LarcherPillichshammer`. `engines()` lists them.

>>> import aureole.qmc
>>> from scipy.stats import qmc
>>> engine = aureole.qmc.Sobol(d=2, scramble="owen", seed=7)
>>> isinstance(engine, qmc.QMCEngine), engine.random(4).shape
(True, (4, 2))
>>> sample = aureole.qmc.FibonacciLattice(d=2, n=89).random(89)
>>> bool(qmc.discrepancy(sample, method="L2-star") < 0.02)
True
"""

from __future__ import annotations

import re
from typing import Any, Optional, Union

import numpy as np
from scipy.stats import qmc as _qmc

from ._bridge import ArgumentError
from ._maps import map_from_directions
from ._points import Array, Directions, PointSet
from ._tables import Set, sets


class Engine(_qmc.QMCEngine):
    """Points of one of Aureole's sets, in their order: a subclass for each set gives it its name.

    Parameters
    ----------
    d : the dimension.
    n : the size of the set, for sets whose points depend on it: their first points alone are no even set. Others go on
        without end.
    scramble : True: Owen's scrambling where the set is a net in base 2, else a shift modulo 1 (a random rotation for sets
        of the sphere); False: none; or "digit", "owen", "shift", "rotate".
    optimization, seed : as for scipy's engines; the seed may be an integer or a numpy.random.Generator.
    keys : of the set, as in "halton:permute=random".
    """

    row: Set

    def __init__(
        self, d: int = 2, *, n: Optional[int] = None, scramble: Union[bool, str] = False,
        optimization: Optional[str] = None, seed: Any = None, **keys: Any,
    ):  # fmt: skip
        row = self.row
        super().__init__(d=d, optimization=optimization, **_seed(seed))
        if n is None and not row.extensible:
            raise ArgumentError(f"{type(self).__name__}: n must be given: other points for every size ({row.sizes})")
        if scramble is True:
            scramble = "rotate3d" if row.native else "owen" if row.binary_net else "shift"
        number = seed if isinstance(seed, (int, np.integer)) else int(self.rng.integers(2**63))
        name = row.name + ":" * bool(keys) + ",".join(f"{key.replace('_', '-')}={value}" for key, value in keys.items())
        scrambled = {"scramble": scramble or "none", "seed": int(number)}
        self._n = n
        if row.native:
            if d != 2:
                raise ArgumentError(f"{type(self).__name__}: directions have 2 coordinates, not {d}")
            self._set: Any = Directions(name, n or row.maximum_size or 2**48, domain="sphere", **scrambled)
        else:
            most = row.maximum_size or 2**48
            while True:  # streams of numbers end after so many numbers
                try:
                    self._set = PointSet(name, n or most, dimension=d, **scrambled)
                    break
                except ArgumentError:
                    if n or most < 2 or row.maximum_size is None:
                        raise
                    most //= 2

    def _random(self, n: int = 1, *, workers: int = 1) -> Array:
        if self.num_generated + n > len(self._set):
            raise ArgumentError(f"{type(self).__name__}: {len(self._set)} points are all there are")
        found = self._set.points(self.num_generated, n)
        return map_from_directions(found) if self.row.native else found

    def fast_forward(self, n: int) -> "Engine":
        """Leaves out n points; no time goes by."""
        self.num_generated += n
        return self


def _seed(seed: Any) -> dict[str, Any]:
    """The base class's seed, under the name that its version knows."""
    import inspect

    return {"rng" if "rng" in inspect.signature(_qmc.QMCEngine.__init__).parameters else "seed": seed}


def engines() -> dict[str, type[Engine]]:
    """The engine of each set, by the set's name.

    >>> engines()["spherical-fibonacci"].__name__
    'SphericalFibonacci'
    """
    return dict(_ENGINES)


def _engine(row: Set) -> type[Engine]:
    name = "".join(word.capitalize() for word in re.split("[-_]", row.name))
    doc = f"{row.summary} ({row.source}).\n\nSizes: {row.sizes}." if row.source else row.summary
    if row.native:
        doc += "\nCoordinates are those of Lambert's equal-area map: z = 1 - 2u, phi = 2 pi v."
    return type(name, (Engine,), {"row": row, "__doc__": f"{doc}\n\n{Engine.__doc__}", "__module__": __name__})


_ENGINES = {
    row.name: _engine(row)
    for row in sets().values()
    if row.name not in ("file", "matrices") and {"square", "cube", "sphere"} & {*row.domains}
}
globals().update({engine.__name__: engine for engine in _ENGINES.values()})
__all__ = ["Engine", "engines", *(engine.__name__ for engine in _ENGINES.values())]  # pyright: ignore

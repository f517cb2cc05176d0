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
import warnings
from typing import Any, Optional, Union

import numpy as np
from scipy.stats import qmc as _qmc

from ._bridge import ArgumentError, AureoleWarning
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
    optimization, rng : as for scipy's engines; rng may be an integer of any size, a numpy.random.Generator, SeedSequence or
        RandomState. seed is another name of it, as in scipy before 1.15.
    keys : of the set, as in "halton:permute=random".
    """

    row: Set

    def __init__(
        self, d: int = 2, *, n: Optional[int] = None, scramble: Union[bool, str] = False,
        optimization: Optional[str] = None, seed: Any = None, rng: Any = None, **keys: Any,
    ):  # fmt: skip
        row = self.row
        if seed is not None and rng is not None:
            raise TypeError("rng and seed are two names of one argument: give one of them")
        seed = rng if seed is None else seed
        if isinstance(seed, np.random.RandomState):  # which has no successors that qmc_quad could take
            seed = np.random.default_rng(seed.randint(2**32, size=4, dtype=np.uint32))
        super().__init__(d=d, optimization=optimization, **_seed(seed))
        # How qmc_quad makes independent engines like this one: randomised, as scipy's do.
        self._init_quad = {"d": d, "n": n, "scramble": scramble or True, "optimization": optimization, **keys}
        if n is None and not row.extensible:
            raise ArgumentError(f"{type(self).__name__}: n must be given: other points for every size ({row.sizes})")
        if scramble is True:
            scramble = "rotate3d" if row.native else "owen" if row.binary_net else "shift"
        name = row.name + ":" * bool(keys) + ",".join(f"{key.replace('_', '-')}={value}" for key, value in keys.items())
        if row.native and d != 2:
            raise ArgumentError(f"{type(self).__name__}: directions have 2 coordinates, not {d}")
        self._made_of = (name, n, {"scramble": scramble or "none", "seed": _number(seed, self.rng)})
        self._set = self._make()

    def _make(self) -> Any:
        name, n, scrambled = self._made_of
        most = self.row.maximum_size or 2**48
        if self.row.native:
            return Directions(name, n or most, domain="sphere", **scrambled)
        while self.d > 0:  # streams of numbers end after so many numbers
            try:
                return PointSet(name, n or most, dimension=self.d, **scrambled)
            except ArgumentError:
                if n or most < 2 or self.row.maximum_size is None:
                    raise
                most //= 2
        return None

    def __getstate__(self) -> dict[str, Any]:
        """For pickle and copy: the points are made again from what they were made of."""
        return {name: value for name, value in self.__dict__.items() if name != "_set"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._set = self._make()

    def _random(self, n: int = 1, *, workers: int = 1) -> Array:
        if self._set is None:
            return np.empty((n, 0))
        if self.num_generated + n > len(self._set):
            raise ArgumentError(f"{type(self).__name__}: {len(self._set)} points are all there are")
        if self.num_generated == 0 < n < len(self._set) and not self.row.extensible:
            part = f"{type(self).__name__}: the first {n} of {len(self._set)} points are no even set: draw all of them"
            warnings.warn(part, AureoleWarning, stacklevel=3)
        found = self._set.points(self.num_generated, n)
        return map_from_directions(found) if self.row.native else found

    def fast_forward(self, n: int) -> "Engine":
        """Leaves out n points; no time goes by."""
        self.num_generated += n
        return self

    def random_base2(self, m: int) -> Array:
        """The next 2**m points, where the number of all points is a power of two then, as scipy's Sobol asks for."""
        total = self.num_generated + 2**m
        if total & (total - 1):
            raise ValueError(f"{total} points in all are no power of 2: random() takes any number of them")
        return self.random(2**m)


def _seed(seed: Any) -> dict[str, Any]:
    """The base class's seed, under the name that its version knows."""
    import inspect

    return {"rng" if "rng" in inspect.signature(_qmc.QMCEngine.__init__).parameters else "seed": seed}


def _number(seed: Any, rng: Any) -> int:
    """The seed as the library takes it, 64 bits: small integers are themselves."""
    if isinstance(seed, (int, np.integer)):
        small = 0 <= seed < 2**64
        return int(seed) if small else int(np.random.SeedSequence(int(seed)).generate_state(1, np.uint64)[0])
    return int(rng.integers(2**63))


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

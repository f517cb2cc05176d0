"""Engines for scipy.stats.qmc: every set of the square and the cube, and the sets of the sphere in equal-area coordinates.

The name of a class is that of the set: `larcher-pillichshammer` is `LarcherPillichshammer`. `engines()` lists them. They are
called as SciPy's own engines are; `Sobol` and `Halton` give the points of SciPy's classes of these names, for the same `rng`.

>>> import aureole.qmc
>>> from scipy.stats import qmc
>>> engine = aureole.qmc.Sobol(d=2, scramble="owen", seed=7)
>>> isinstance(engine, qmc.QMCEngine), engine.random(4).shape
(True, (4, 2))
>>> bool((aureole.qmc.Sobol(d=2, seed=7).random(8) == qmc.Sobol(d=2, seed=7).random(8)).all())
True
>>> sample = aureole.qmc.FibonacciLattice(d=2, n=89, scramble=False).random(89)
>>> bool(qmc.discrepancy(sample, method="L2-star") < 0.02)
True
"""

from __future__ import annotations

import inspect
import math
import re
import warnings
from typing import Any, Optional, Union

import numpy as np
from scipy.stats import qmc as _qmc

from ._bridge import ArgumentError, AureoleWarning, Seed, seed_number
from ._core import core, lib
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
    scramble : True: the scrambling of SciPy's engine of this name. Of other sets: Owen's for nets in base 2, random lower
        triangular matrices and a digital shift for Faure's, a random rotation for sets of the sphere, a shift modulo 1 for all
        others. False: none. Or "digit", "owen", "shift", "rotate".
    optimization, rng : as for SciPy's engines; rng may be an integer of any size, a numpy.random.Generator, SeedSequence or
        RandomState. seed is another name of it, as in SciPy before 1.15.
    keys : of the set, as in "halton:permute=random".
    """

    row: Set

    def __init__(
        self, d: int = 2, *, n: Optional[int] = None, scramble: Union[bool, str] = True,
        optimization: Optional[str] = None, seed: Seed = None, rng: Seed = None, **keys: Any,
    ):  # fmt: skip
        row = self.row
        if seed is not None and rng is not None:
            raise TypeError("__init__() got multiple values for argument now known as `rng`: seed is another name of it")
        name = "seed" if rng is None else _RNG  # SciPy makes others of an integer by each name
        seed = _for_scipy(rng if seed is None else seed)
        super().__init__(d=d, optimization=optimization, **{name: seed})
        # How qmc_quad makes independent engines like this one: randomised, as SciPy's do.
        self._init_quad = {"d": d, "n": n, "scramble": scramble or True, "optimization": optimization, **keys}
        if n is None and not row.extensible:
            raise ArgumentError(f"{type(self).__name__}: n must be given: other points for every size ({row.sizes})")
        if row.native and d != 2:
            raise ArgumentError(f"{type(self).__name__}: directions have 2 coordinates, not {d}")
        self._shown = {"d": d, **({} if n is None else {"n": n}), "scramble": scramble, **keys}
        scrambled = self._scramble(keys) if scramble is True else scramble or "none"
        drawn = scrambled is not None and (seed is None or isinstance(seed, np.random.Generator))
        number = seed_number(self.rng) if drawn else 0 if scrambled is None else seed_number(seed)
        name = row.name + ":" * bool(keys) + ",".join(f"{key.replace('_', '-')}={value}" for key, value in keys.items())
        self._set_arguments = (name, n, {"scramble": scrambled or "none", "seed": number})
        self._set = self._make()

    def _scramble(self, keys: dict[str, Any]) -> Optional[str]:
        """The library's word for scramble=True; None: it is made ready here."""
        return "rotate3d" if self.row.native else "owen" if self.row.binary_net else "shift"

    def _most(self) -> int:
        """Points of a set that goes on without end."""
        return self.row.maximum_size or 2**48

    def _make(self) -> Any:
        name, n, scrambled = self._set_arguments
        most = self._most()
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

    def __repr__(self) -> str:
        arguments = ", ".join(f"{name}={value!r}" for name, value in self._shown.items())
        return f"<{type(self).__name__}({arguments}), {self.num_generated} points drawn>"

    def _points(self, first: int, n: int) -> Array:
        found = self._set.points(first, n)
        return map_from_directions(found) if self.row.native else found

    def _random(self, n: int = 1, *, workers: int = 1) -> Array:
        if self._set is None:
            return np.empty((n, 0))
        if self.num_generated + n > self._set.size:
            raise ArgumentError(f"{type(self).__name__}: {self._set.size} points are all there are")
        if self.num_generated == 0 < n < self._set.size and not self.row.extensible:
            part = f"{type(self).__name__}: the first {n} of {self._set.size} points are no even set: draw all of them"
            warnings.warn(part, AureoleWarning, stacklevel=3)
        return self._points(self.num_generated, n)

    def fast_forward(self, n: int) -> "Engine":
        """Leaves out n points; no time goes by."""
        self.num_generated += n
        return self

    def random_base2(self, m: int) -> Array:
        """The next 2**m points, where the number of all points is a power of two then, as SciPy's Sobol asks for."""
        total = self.num_generated + 2**m
        if total & (total - 1):
            raise ValueError(
                "The balance properties of Sobol' points require n to be a power of 2, "
                f"not {total} in all: random() takes any number of them"
            )
        return self.random(2**m)


class _Sobol(Engine):
    """Unscrambled and with scramble=True in the order of SciPy's Sobol, Gray code's: aligned runs of 2^k points are the same
    points as in natural order, in which "owen", "digit" and "shift" give them.

    Parameters
    ----------
    scramble : True: SciPy's, a random lower triangular matrix of `bits` rows and a digital shift (Matousek 1998), with the
        numbers that SciPy draws from `rng`. "owen" is random in all digits of a double.
    bits : at most 2**bits points, and as many binary digits of scramble=True; None: 30 for these, else the set's.
    """

    MAXDIM = 21201
    _directions: Optional[tuple[np.ndarray, np.ndarray]] = None

    def __init__(self, d: int = 2, *, bits: Optional[int] = None, **arguments: Any):
        if d > self.MAXDIM:
            raise ValueError(f"Maximum supported dimensionality is {self.MAXDIM}.")
        if bits is not None and not 1 <= bits <= 64:
            raise ValueError("Maximum supported 'bits' is 64")
        self.bits = bits
        self._linear: Optional[tuple[np.ndarray, np.ndarray]] = None
        super().__init__(d, **arguments)
        self._init_quad["bits"] = bits
        if self._linear is not None:
            self.bits = bits or 30
        if self._linear is not None or not arguments.get("scramble", True):
            self._directions = self._direction_numbers()

    def _scramble(self, keys: dict[str, Any]) -> None:
        bits = self.bits or 30
        kind = np.uint32 if bits <= 32 else np.uint64
        shift = self.rng.integers(2, size=(self.d, bits), dtype=kind) @ (2 ** np.arange(bits, dtype=kind))
        rows = np.tril(self.rng.integers(2, size=(self.d, bits, bits), dtype=kind), -1) + np.eye(bits, dtype=kind)
        self._linear = rows, shift.astype(np.uint64) << np.uint64(64 - bits)

    def _direction_numbers(self) -> tuple[np.ndarray, np.ndarray]:
        """Of each bit of an index (bits, d), and of index 0 (d,): binary digits after the point, 64 of them."""
        bits = min(self.bits or 53, 53)
        whole = self.d and PointSet(self.row.name, 2**53, dimension=self.d)
        points = [whole.points(2**k, 1)[0] for k in range(bits)] if whole else []
        numbers = (np.reshape(points, (bits, self.d)) * 2.0**53).astype(np.uint64) << np.uint64(11)
        if self._linear is None:
            return numbers, np.zeros(self.d, dtype=np.uint64)
        rows, shift = self._linear
        digits = np.uint64(63) - np.arange(rows.shape[1], dtype=np.uint64)
        columns = np.bitwise_or.reduce(rows.astype(np.uint64) << digits[:, np.newaxis], axis=1)  # (d, bits)
        product = np.zeros_like(numbers)
        for digit, column in zip(digits, columns.T):
            product ^= np.where(numbers >> digit & np.uint64(1), column, np.uint64(0))
        return product, shift

    def _random(self, n: int = 1, *, workers: int = 1) -> Array:
        total = self.num_generated + n
        if self.bits is not None and total > 2**self.bits:
            raise ArgumentError(
                f"At most 2**{self.bits} distinct points can be generated: {self.num_generated} and {n} are more. "
                "Consider increasing `bits`."
            )
        if self.num_generated == 0 and n & (n - 1):
            message = "The balance properties of Sobol' points require n to be a power of 2."
            warnings.warn(message, AureoleWarning, stacklevel=3)
        return super()._random(n)

    def _points(self, first: int, n: int) -> Array:
        if self._directions is None:
            return super()._points(first, n)
        numbers, shift = self._directions
        found = np.empty((n, self.d))
        state = shift.copy()
        for k in np.flatnonzero([(first ^ first >> 1) >> k & 1 for k in range(len(numbers))]):
            state ^= numbers[k]
        lib.aureole_gray_code(
            first, n, self.d, core.input(numbers, "uint64_t"), core.output(state, "uint64_t"), core.output(found)
        )
        return found


class _Digits(Engine):
    """Digits of each coordinate in its base through a permutation for each place, as `_permute` draws them."""

    _tables: Optional[list[tuple[float, Array]]] = None

    def _permute(self, bases: list[int], permutations: list[np.ndarray]) -> None:
        """`permutations`: of each coordinate (places, base). A table adds up what several digits give."""
        self._tables = []
        for base, permutation in zip(bases, permutations):
            digit_count = max(1, int(51 / math.log2(base) + 1e-9))  # so that a coordinate says its digits in spite of rounding
            width = max(1, int(math.log(1024, base)))
            parts = permutation * float(base) ** -np.arange(1.0, len(permutation) + 1.0)[:, np.newaxis]
            digits = np.arange(base**width)
            tables = np.zeros((-(-digit_count // width), base**width))
            for digit in range(digit_count):  # from the last one on
                tables[digit // width] += parts[digit_count - 1 - digit][digits // base ** (digit % width) % base]
            tables[-1] += parts[digit_count:, 0].sum()  # of the zeros after them
            self._tables.append((float(base) ** digit_count, tables))

    def _points(self, first: int, n: int) -> Array:
        found = super()._points(first, n)
        for d, (denominator, tables) in enumerate(self._tables or ()):
            lib.aureole_digit_tables(
                n, self.d, denominator, len(tables), tables.shape[1], core.input(tables), core.output(found[:, d:])
            )
        return found


class _Halton(_Digits):
    """With random permutations of all digits, as SciPy's (Owen 2017); SciPy before 1.11 has the same ones in all dimensions."""

    def _scramble(self, keys: dict[str, Any]) -> Optional[str]:
        if "permute" in keys:
            return "none"
        bases = _primes(self.d)
        self._permute(bases, [self._permutations(base) for base in bases])
        return None

    def _permutations(self, base: int) -> np.ndarray:
        permutations = np.repeat(np.arange(base)[np.newaxis], math.ceil(54 / math.log2(base)) - 1, axis=0)
        for permutation in permutations:
            self.rng.shuffle(permutation)
        return permutations


class _Faure(_Digits):
    """With random lower triangular matrices (Matousek 1998) and a digital shift."""

    def __init__(self, d: int = 2, *, base: Union[int, str] = "auto", **arguments: Any):
        auto = next(prime for prime in _primes(d + 1) if prime >= d)
        self._base = auto if base == "auto" else int(base)
        super().__init__(d, base=self._base, **arguments)

    def _scramble(self, keys: dict[str, Any]) -> str:
        digit_count = math.ceil(54 / math.log2(self._base)) - 1
        shifts = self.rng.integers(self._base, size=(self.d, digit_count, 1))
        self._permute([self._base] * self.d, [*((np.arange(self._base) + shifts) % self._base)])
        keys["scramble"] = "lower-triangular"
        return "none"

    def _most(self) -> int:
        return self._base ** int(48 / math.log2(self._base))


def _primes(count: int) -> list[int]:
    primes = np.ones(max(16, int(2 * count * math.log(count + 2))), dtype=bool)
    for i in range(2, math.isqrt(len(primes)) + 1):
        primes[i * i :: i] = False
    return np.flatnonzero(primes)[2 : count + 2].tolist()


# The name that the base class of SciPy's version has for random numbers.
_RNG = "rng" if "rng" in inspect.signature(_qmc.QMCEngine.__init__).parameters else "seed"


def _for_scipy(seed: Seed) -> Any:
    """A seed that every version of SciPy takes: an integer, a Generator or None."""
    if isinstance(seed, np.random.RandomState):  # which has no successors that qmc_quad could take
        return np.random.default_rng(seed.randint(2**32, size=4, dtype=np.uint32))
    if seed is None or isinstance(seed, np.random.Generator):
        return seed
    if isinstance(seed, (np.random.SeedSequence, np.random.BitGenerator)):
        return np.random.default_rng(seed)
    seed_number(seed)
    return seed


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
    base = {"sobol": _Sobol, "halton": _Halton, "faure": _Faure}.get(row.name, Engine)
    doc += "".join(f"\n\n{part.__doc__}" for part in (base, Engine)[: 1 + (base is not Engine)])
    return type(name, (base,), {"row": row, "__doc__": doc, "__module__": __name__})


_ENGINES = {
    row.name: _engine(row)
    for row in sets().values()
    if row.name not in ("file", "matrices") and {"square", "cube", "sphere"} & {*row.domains}
}
globals().update({engine.__name__: engine for engine in _ENGINES.values()})
__all__ = ["Engine", "engines", *(engine.__name__ for engine in _ENGINES.values())]  # pyright: ignore

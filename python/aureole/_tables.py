"""The tables of the library as data: sets, measures, and what images are made with."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

from ._bridge import Bridge
from ._core import core


class Key(NamedTuple):
    """What may be written as key=value."""

    name: str
    type: str  #: "boolean", "integer", "number", "choice", "text", "vector", "color", "transform" or "item"
    help: str
    default: Optional[str]  #: as it would be written, or in words where it follows from others; None: there is none
    range: str  #: "1 .. 65536", "ratio, equal"; "" where there is none


class Row(NamedTuple):
    """One row of a table: a set, a measure, an integrator, a material, ..."""

    name: str
    summary: str
    source: str  #: "author year, ..."; "" for none
    keys: dict[str, Key]


class Set(NamedTuple):
    """A set of points. Every set of the square comes to the disk, the hemisphere and the sphere by a map."""

    name: str
    summary: str
    source: str
    keys: dict[str, Key]
    domains: tuple[str, ...]  #: where its points are by themselves
    dimensions: tuple[int, int]  #: least and most
    sizes: str  #: in words, such as "1..2^48; a lattice at F_k"
    maximum_size: Optional[int]  #: None: as many as are asked for
    extensible: bool  #: the first n points of a larger set are the smaller set
    binary_net: bool  #: 2^k points are a net in base 2
    native: bool  #: made on the sphere, for axes or for rotations, and not on the square or the cube


class Measure(NamedTuple):
    """A figure of merit of points."""

    name: str
    summary: str
    source: str
    parameter: str  #: ":S" for riesz:S, "[:B]" where it may be left out, "" for none
    domains: str
    bound: bool  #: the value is a lower bound of what is measured
    series: bool  #: a table rather than one value


def _sized_text(bridge: Bridge, function: Any, *arguments: Any) -> str:
    text = bridge.ffi.new("char[256]")
    function(*arguments, 256, text)
    return bridge.text(text) or ""


def _row(bridge: Bridge, row: Any) -> Row:
    lib = bridge.lib
    keys = {}
    for index in range(row.key_count):
        key = lib.aur_row_key(bridge.ffi.addressof(row), index)
        name = bridge.text(key.name) or ""
        keys[name] = Key(
            name, bridge.text(lib.aur_key_type_name(key.type)) or "", bridge.text(key.help) or "",
            bridge.text(key.default_text), _sized_text(bridge, lib.aur_key_range, key),
        )  # fmt: skip
    return Row(bridge.text(row.name) or "", bridge.text(row.summary) or "", bridge.text(row.source) or "", keys)


def read_tables(bridge: Bridge, table_at: Any) -> dict[str, dict[str, Row]]:
    tables: dict[str, dict[str, Row]] = {}
    while (table := table_at(len(tables))) != bridge.ffi.NULL:
        common = _row(bridge, table.common[0]).keys if table.common != bridge.ffi.NULL else {}
        rows = (_row(bridge, table.rows[index][0]) for index in range(table.count))
        tables[bridge.text(table.kind) or ""] = {row.name: row._replace(keys={**row.keys, **common}) for row in rows}
    return tables


def tables() -> dict[str, dict[str, Row]]:
    """Every table of the core by its kind: "set" and "measure". Those of images are `render_tables`'.

    >>> sorted(tables())
    ['measure', 'set']
    >>> tables()["set"]["halton"].keys["permute"].range
    'none, random'
    """
    return read_tables(core, core.lib.aur_table_at)


def sets() -> dict[str, Set]:
    """All sets of points by name, in the order of the table.

    >>> sets()["spherical-fibonacci"].domains
    ('disk', 'hemisphere', 'sphere', 'axes')
    >>> sets()["sobol"].source
    'Sobol 1967; Joe, Kuo 2008; Burley 2020'
    """
    found = {}
    for index in range(core.lib.aur_set_count()):
        row = core.lib.aur_set_at(index)
        domains = tuple(name for value, name in enumerate(names("domain")) if row.domains >> value & 1)
        found[core.text(row.row.name) or ""] = Set(
            *_row(core, row.row), domains, (row.dimensions[0], row.dimensions[1]), _sized_text(core, core.lib.aur_set_sizes, row),
            row.maximum_size if row.maximum_size < 2**64 - 1 else None, row.extensible, row.binary_net,
            not {"square", "cube"} & {*domains},
        )  # fmt: skip
    return found


def measures() -> dict[str, Measure]:
    """All measures of points by name.

    >>> measures()["energy"].domains
    'sphere, hemisphere, axes, rotations'
    """
    found = {}
    for index in range(core.lib.aur_measure_count()):
        row = core.lib.aur_measure_at(index)
        name, summary, source, _ = _row(core, row.row)
        found[name] = Measure(
            name, summary, source, core.text(row.parameter) or "", core.text(row.domains) or "", row.bound, row.series
        )
    return found


def names(kind: str) -> list[str]:
    """The names of an enumeration of the library's ("domain", "map", "scramble", ...), in the order of its values."""
    found: list[str] = []
    while (name := core.text(getattr(core.lib, f"aur_{kind}_name")(len(found)))) is not None:
        found.append(name)
    return found

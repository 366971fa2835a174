"""A town in three steps, for engines that run on many machines.

>>> tiles = hsd.town.plan("kyoto.hsd", "work")          # doctest: +SKIP
>>> hsd.town.tile("work", [tile.key for tile in tiles])  # doctest: +SKIP
>>> hsd.town.seal("work", "kyoto")                       # doctest: +SKIP

Each step is a function over files and may be repeated; a tile may be made by any number of processes at a time, on any machine
that sees the folder of the work and that of the town. The result is that of `hsd town kyoto.hsd -o kyoto/`, to the byte.
Diagnostics go to standard error.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from . import _hsd

__all__ = ["Sealed", "Tile", "TownError", "plan", "planned", "seal", "tile"]

_Path = str | PathLike[str]


class TownError(Exception):
    """A step has failed. `status` is the exit status of the command line: 1 errors in the input, or a tile that cannot be made;
    2 there is no such work or tile, tiles are missing, or the town has changed; 3 a file could not be read or written."""

    def __init__(self, status: int, message: str) -> None:
        super().__init__(status, message)
        self.status = status
        self.message = message

    def __str__(self) -> str:
        return self.message or f"hsd ended with status {self.status}; standard error says why"

    @property
    def may_pass(self) -> bool:
        """True if it is of use to try again."""
        return self.status == 3


@dataclass(frozen=True)
class Tile:
    """A tile, or a piece of ground, to be made."""

    #: Its name.
    key: str
    #: The number of its features, 0 for ground: about what it takes to make it.
    features: int
    #: The bytes of its inputs.
    bytes: int
    #: The hash of its inputs: the same hash gives the same tile.
    inputs: str


@dataclass(frozen=True)
class Sealed:
    """A town that has been put together."""

    #: Its folder, in which `tileset.json` is.
    folder: Path
    #: False if a feature has no house that nobody asked to skip, or a house has errors.
    complete: bool

    def report(self) -> dict[str, Any]:
        """Returns what became of the features: `features`, `built`, `skipped`, `corrected`."""
        with open(self.folder / "report.json", encoding="utf-8") as file:
            return json.load(file)


def _run(arguments: Sequence[str]) -> tuple[int, str]:
    return _hsd.call(["hsd", "town", *arguments])


def plan(
    town: _Path,
    work: _Path,
    *,
    params: Mapping[str, object] | None = None,
    seed: int | None = None,
    detail: Sequence[int] | None = None,
    compress: bool = False,
) -> list[Tile]:
    """Divides a town into tiles, and puts into the folder `work` all that each needs. Reads the maps, as no later step does.

    Repeated after a change of the town, it plans anew; tiles whose inputs are the same stay made.
    """
    from . import _pairs

    arguments = ["plan", fspath(town), "-o", fspath(work), "--quiet"]
    for name, value in _pairs(params):
        arguments += ["--param", f"{name}={value}"]
    if seed is not None:
        arguments += ["--seed", str(seed)]
    if detail is not None:
        arguments += ["--detail", ",".join(map(str, detail))]
    if compress:
        arguments.append("--compress")
    status, message = _run(arguments)
    if status:
        raise TownError(status, message)
    return planned(work)


def planned(work: _Path) -> list[Tile]:
    """Returns the tiles of planned work, in their order."""
    try:
        with open(Path(work) / "work.json", encoding="utf-8") as file:
            tiles = json.load(file)["tiles"]
    except FileNotFoundError as error:
        raise TownError(2, f"{fspath(work)} is no folder of planned work") from error
    return [Tile(t["key"], t["features"], t["bytes"], t["inputs"]) for t in tiles]


def tile(work: _Path, keys: str | Iterable[str], *, threads: int = 1) -> None:
    """Makes tiles, unless they are there. Each is put into `work` whole or not at all.

    A house with errors gets a plain body and is reported by `seal`. Raises `TownError` if a tile cannot be made; the others are.
    """
    keys = [keys] if isinstance(keys, str) else list(keys)
    if not keys:
        return
    status, message = _run(["tile", fspath(work), "--quiet", "--threads", str(threads), "--", *keys])
    if status:
        raise TownError(status, message)


def seal(work: _Path, output: _Path, *, lacking: bool = False) -> Sealed:
    """Puts the town together in the folder `output`, the tileset last.

    Raises `TownError` with status 2 if tiles are missing, unless `lacking` leaves them out; their features are in the report.
    """
    arguments = ["seal", fspath(work), "-o", fspath(output), "--quiet"]
    status, message = _run(arguments + (["--lacking"] if lacking else []))
    if status > 1:
        raise TownError(status, message)
    return Sealed(Path(output), status == 0)

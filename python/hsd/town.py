"""Towns on maps: one that a notebook shows, and large ones in three steps, for engines that run on many machines.

    tiles = hsd.town.plan("kyoto.hsd", "work")
    hsd.town.tile("work", [tile.key for tile in tiles])
    hsd.town.seal("work", "kyoto")

Each step is a function over files and may be repeated. A tile may be made by any number of processes at a time, on any machine that
sees the folder of the work and that of the town; the result is that of `hsd town kyoto.hsd -o kyoto/`, to the byte. What is found in
the text `hsd.check` tells, what became of its features the report of `seal`.
"""

from __future__ import annotations

import csv
import json
import os
import re
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

from . import _native
from ._show import Model
from ._text import Error, Message, Parameters, Text, is_text, job, messages_of, pairs, require

__all__ = ["Sealed", "StepError", "Tile", "Town", "plan", "planned", "seal", "show", "tile", "write"]

_Path = Union[str, "os.PathLike[str]"]


class Town(Model):
    """The model of a town, its text, and for each feature of its maps what was built on it and why."""

    def __init__(self, glb: bytes, messages: list[Message], height: int, text: str, decisions: list[dict[str, str]]) -> None:
        super().__init__(glb, messages, height)
        #: The text, also where `hsd town init` has written it.
        self.text = text
        #: The lines of `decisions.csv`.
        self.decisions = decisions

    def frame(self) -> Any:
        """The decisions as a DataFrame of pandas, which `houses.merge(town.frame(), on="key")` joins to their features."""
        return _frame(self.decisions)


class StepError(Error):
    """A step that failed. `status`: 1 errors in the input, or a tile that cannot be made; 2 no such work or tile, tiles are missing, or
    the town has changed; 3 a file could not be read or written, so it is of use to try again (`may_pass`)."""

    def __init__(self, status: int, text: str, messages: list[Message] | None = None) -> None:
        super().__init__(text.strip() or f"hsd ended with status {status}", messages)
        self.status = status

    def __reduce__(self) -> tuple[type[StepError], tuple[int, str, list[Message]]]:
        # Engines send errors between processes.
        return type(self), (self.status, str(self), self.messages)

    @property
    def may_pass(self) -> bool:
        return self.status == 3


@dataclass(frozen=True)
class Tile:
    """A tile to be made."""

    #: Its name.
    key: str
    #: The number of its features, 0 for ground: a measure of the work.
    features: int
    #: The bytes of its inputs.
    bytes: int
    #: The hash of its inputs: the same hash gives the same tile.
    inputs: str


@dataclass(frozen=True)
class Sealed:
    """A town that is put together."""

    #: The folder of its `tileset.json`.
    folder: Path
    #: Whether every feature that should has a house.
    complete: bool

    def report(self) -> dict[str, Any]:
        """What became of the features: `features`, `built`, `skipped`, `corrected`."""
        report: dict[str, Any] = json.loads((self.folder / "report.json").read_text(encoding="utf-8"))
        return report

    def decisions(self) -> list[dict[str, str]]:
        """A line for each feature: what was built on it and why."""
        return _decisions(self.folder / "decisions.csv")

    def frame(self) -> Any:
        """The same as a DataFrame of pandas, which `houses.merge(sealed.frame(), on="key")` joins to their features."""
        return _frame(self.decisions())


def _decisions(path: Path) -> list[dict[str, str]]:
    with open(path, encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


def _frame(decisions: list[dict[str, str]]) -> Any:
    import pandas

    frame = pandas.DataFrame(decisions)
    for name in frame.columns.difference(["layer", "key"]):
        # Keys stay texts: 007 is no 7.
        numbers = pandas.to_numeric(frame[name].replace("", None), errors="coerce")
        if numbers.notna().any() and (numbers.notna() == (frame[name].fillna("") != "")).all():
            frame[name] = numbers
    return frame


def _call(words: Sequence[object], threads: int | None = None) -> tuple[int, str]:
    return _native.call(["hsd", "town", *map(str, words)], threads or 0)


def _settings(parameters: Parameters | None, seed: int | None) -> list[str]:
    words = [] if seed is None else ["--seed", str(seed)]
    for name, value in pairs(parameters):
        words += ["--param", f"{name}={value}"]
    return words


def plan(
    town: _Path,
    work: _Path,
    *,
    parameters: Parameters | None = None,
    seed: int | None = None,
    detail: Sequence[int] | None = None,
    threads: int | None = None,
) -> list[Tile]:
    """Divides a town file into tiles, and puts into the folder `work` all that each needs; it reads the maps, as no later step does.
    `detail` lists levels, as `[0, 1]`. After a change of the town it plans anew, and tiles with the same inputs stay made."""
    levels = [] if detail is None else ["--detail", ",".join(map(str, detail))]
    status, message = _call(["plan", "-o", work, "--quiet", *levels, *_settings(parameters, seed), "--", town], threads)
    if status:
        told, report = _native.check(job(town, parameters, seed), 0) if status == 1 else ([], "")
        raise StepError(status, message or report, messages_of(told))
    return planned(work)


def planned(work: _Path) -> list[Tile]:
    """The tiles of planned work, in their order."""
    try:
        tiles = json.loads(Path(work, "work.json").read_text(encoding="utf-8"))["tiles"]
    except FileNotFoundError as error:
        raise StepError(2, f"{os.fspath(work)} is no folder of planned work") from error
    return [Tile(t["key"], t["features"], t["bytes"], t["inputs"]) for t in tiles]


def tile(work: _Path, keys: str | Iterable[str], *, threads: int | None = None) -> None:
    """Makes tiles, one key or several, unless they are there. Each comes into `work` whole or not at all; where one cannot be made, the
    others are. `threads` are those of tiles at a time, one per processor without: engines that count processors want 1."""
    keys = [keys] if isinstance(keys, str) else list(keys)
    if not keys:
        return
    # Options stand first, since keys may begin with `-`.
    status, message = _call(["tile", "--quiet", work, *keys], threads)
    if status == 1 and not message:
        inputs = {one.key: one.inputs for one in planned(work)}
        unmade = [key for key in keys if not Path(work, "made", f"{key}-{inputs[key]}.json").exists()]
        message = f"cannot be made: {' '.join(unmade)}"
    if status:
        raise StepError(status, message)


def seal(work: _Path, out: _Path, *, lacking: bool = False) -> Sealed:
    """Puts the town together in the folder `out`. While tiles are missing it fails and names them; `lacking` leaves them out."""
    status, message = _call(["seal", "-o", out, "--quiet", *(["--lacking"] if lacking else []), "--", work])
    if status > 1:
        raise StepError(status, message)
    return Sealed(Path(out), status == 0)


def _write(layer: Any, path: Path) -> None:
    """Writes a map: a GeoDataFrame, a table of Arrow with geometries, an object that is GeoJSON, or its text."""
    if hasattr(layer, "__arrow_c_stream__") and not hasattr(layer, "to_json"):
        import geopandas

        layer = geopandas.GeoDataFrame.from_arrow(layer)
    if hasattr(layer, "to_json"):
        layer = (layer.to_crs(4326) if getattr(layer, "crs", None) is not None else layer).to_json()
    elif hasattr(layer, "__geo_interface__") or isinstance(layer, dict):
        layer = json.dumps(getattr(layer, "__geo_interface__", layer))
    path.write_text(layer, encoding="utf-8")


def write(layers: Mapping[str, Any], folder: _Path) -> list[Path]:
    """Writes maps into a folder, as NAME.geojson, for a town file there to name: GeoDataFrames, tables of Arrow with geometries (such
    as `geopandas.to_arrow` gives), or GeoJSON. In degrees where a layer knows its reference system."""
    maps = []
    for name, layer in layers.items():
        if not re.fullmatch(r"[\w-]+", name):
            raise Error(f"{name!r} is no name for a file: use letters, digits and -")
        maps.append(Path(folder, f"{name}.geojson"))
        _write(layer, maps[-1])
    return maps


def show(
    source: Text | None = None,
    layers: Mapping[str, Any] | None = None,
    *,
    detail: int = 1,
    parameters: Parameters | None = None,
    seed: int | None = None,
    height: int = 480,
) -> Town:
    """Shows a town in a notebook: `layers` are maps by name as `write` takes them, which the text names as NAME.geojson.

    Without a text `hsd town init` writes a first one from the maps; it is the `text` of the result.
    """
    with tempfile.TemporaryDirectory(prefix="hsd-") as temporary:
        folder = Path(temporary)
        maps = write(layers or {}, folder)
        path = folder / "town.hsd"
        if source is None:
            status, message = _call(["init", *maps, "-o", path])
            if status:
                raise StepError(status, message)
        elif is_text(source):
            path.write_text(str(source).removeprefix("\n"), encoding="utf-8")
        else:
            path = Path(source)
        messages = require(path, parameters, seed)
        model = folder / "out" / "town.glb"
        model.parent.mkdir()
        status, message = _call(["--quiet", "--detail", detail, *_settings(parameters, seed), path, "-o", model])
        # 1 when a feature has no house that nobody asked to skip: the town is there.
        if status > 1 or not model.exists():
            raise StepError(status, message)
        text = path.read_text(encoding="utf-8")
        return Town(model.read_bytes(), messages, height, text, _decisions(model.with_suffix(".decisions.csv")))

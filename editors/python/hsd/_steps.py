"""A large town in three steps, for engines that run on many machines.

    tiles = hsd.town.plan("kyoto.hsd", "work")
    hsd.town.tile("work", [tile.key for tile in tiles])
    hsd.town.seal("work", "kyoto")

Each step is a function over files and may be repeated. A tile may be made by any number of processes at a time, on any machine that
sees the folder of the work and that of the town; the result is that of `hsd town kyoto.hsd -o kyoto/`, to the byte. Each call runs
the program, so threads help: Python's lock is free meanwhile.
"""

import dataclasses
import json
import pathlib

from ._program import Error, run, settings


class StepError(Error):
    """A step that failed. `status`: 1 errors in the input, or a tile that cannot be made; 2 no such work or tile, tiles are missing, or the
    town has changed; 3 a file could not be read or written, so it is of use to try again (`may_pass`)."""

    def __init__(self, status: int, text: str) -> None:
        super().__init__(text.strip() or f"hsd ended with status {status}")
        self.status = status

    @property
    def may_pass(self) -> bool:
        return self.status == 3


@dataclasses.dataclass(frozen=True)
class Tile:
    """A tile to be made: its key, the number of its features (0 for ground) as a measure of the work, the bytes of its inputs, and
    their hash: the same hash gives the same tile."""

    key: str
    features: int
    bytes: int
    inputs: str


@dataclasses.dataclass(frozen=True)
class Sealed:
    """A town that is put together: the folder of its `tileset.json`, and whether every feature that should has a house."""

    folder: pathlib.Path
    complete: bool

    def report(self) -> dict:
        """What became of the features: `features`, `built`, `skipped`, `corrected`."""
        return json.loads((self.folder / "report.json").read_text(encoding="utf-8"))


def _step(words: list, accepted: tuple = (0,)) -> int:
    status, _, errors = run(["town", *words])
    if status not in accepted:
        raise StepError(status, errors)
    return status


def plan(town, work, parameters=None, seed=None, detail=None) -> list[Tile]:
    """Divides a town file into tiles, and puts into the folder `work` all that each needs; it reads the maps, as no later step does.
    `detail` lists levels, as `[0, 1]`. After a change of the town it plans anew, and tiles with the same inputs stay made."""
    levels = [] if detail is None else ["--detail", ",".join(map(str, detail))]
    _step(["plan", town, "-o", work, "--quiet", *levels, *settings(parameters, seed)])
    return planned(work)


def planned(work) -> list[Tile]:
    """The tiles of planned work, in their order."""
    path = pathlib.Path(work, "work.json")
    try:
        tiles = json.loads(path.read_text(encoding="utf-8"))["tiles"]
    except FileNotFoundError as error:
        raise StepError(2, f"{work} is no folder of planned work") from error
    return [Tile(t["key"], t["features"], t["bytes"], t["inputs"]) for t in tiles]


def tile(work, keys) -> None:
    """Makes tiles, one key or several, unless they are there. Each comes into `work` whole or not at all."""
    keys = [keys] if isinstance(keys, str) else list(keys)
    if keys:
        _step(["tile", work, *keys])


def seal(work, out, lacking: bool = False) -> Sealed:
    """Puts the town together in the folder `out`. While tiles are missing it fails and names them; `lacking` leaves them out."""
    status = _step(["seal", work, "-o", out, "--quiet", *(["--lacking"] if lacking else [])], (0, 1))
    return Sealed(pathlib.Path(out), status == 0)

"""hsd, a compiler for houses and towns.

>>> import hsd
>>> glb = hsd.compile("0 0 180\\n\\nGSI  GSI  GDE 2KKS\\n")
>>> glb[:4]
b'glTF'

`compile` makes a model of a house file, `check` reports what is wrong with it, `show` draws it in a notebook, and `hsd.town`
has the three steps of a large town. All of them release Python's lock while they work, so threads help.
"""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike

from . import _hsd, town
from ._hsd import CompileError, Diagnostic, __version__

__all__ = ["CompileError", "Diagnostic", "Picture", "check", "compile", "show", "town", "__version__"]

Parameters = Mapping[str, object]


def _pairs(params: Parameters | None) -> list[tuple[str, str]]:
    """Returns parameters as the language writes them: truth values are `yes` and `no`."""
    def word(value: object) -> str:
        if isinstance(value, bool):
            return "yes" if value else "no"
        return str(value)

    return [(name, word(value)) for name, value in (params or {}).items()]


def compile(
    text: str,
    *,
    name: str = "house.hsd",
    folder: str | PathLike[str] | None = None,
    params: Parameters | None = None,
    seed: int | None = None,
    detail: int = 3,
    language: str = "en",
) -> bytes:
    """Compiles a house file to a model: the bytes of a `.glb`.

    `name` stands in diagnostics. Images and included files are looked for in `folder` and below it; without, there are none.
    `params` sets parameters of the file, `seed` the seed of every house, `detail` the level from 0 (walls and roofs) to 3
    (everything as geometry).

    Raises `CompileError` if the file has errors: its `args` are a line on the first one, and all diagnostics.
    """
    return _hsd.compile(text, name, folder, _pairs(params), seed, detail, language)


def check(
    text: str,
    *,
    name: str = "house.hsd",
    folder: str | PathLike[str] | None = None,
    params: Parameters | None = None,
    seed: int | None = None,
    language: str = "en",
) -> list[Diagnostic]:
    """Returns what is wrong with a house file, in the order of its lines; an empty list if nothing is.

    The rules of a town are evaluated by `hsd.town`, which reads its maps; of a town file this reads the text alone.
    """
    return _hsd.check(text, name, folder, _pairs(params), seed, language)


class Picture:
    """An image that notebooks show: `data` is a PNG."""

    def __init__(self, data: bytes) -> None:
        self.data = data

    def _repr_png_(self) -> bytes:
        return self.data


def show(
    text: str,
    *,
    name: str = "house.hsd",
    folder: str | PathLike[str] | None = None,
    params: Parameters | None = None,
    seed: int | None = None,
    width: int = 640,
    height: int = 480,
    language: str = "en",
) -> Picture:
    """Draws a house file; a notebook shows the result. Raises `CompileError` as `compile` does."""
    size = (width, height)
    return Picture(_hsd.draw(text, name, folder, _pairs(params), seed, size, language))

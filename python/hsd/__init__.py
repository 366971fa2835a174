"""Houses and towns of hsd in Python and in notebooks.

    import hsd
    hsd.show('''0 0 180
    9.5

    KKS  TKD 2MRE
    KSK  MRE  KSK
    KKS  TIT 2KKS
    KSK  KSK  KSK
    ''')

`compile` gives the bytes of a model, `show` a model that a notebook shows, `check` what is wrong with a text; `hsd.town` has towns on
maps, and the three steps of large ones. All of it runs in this process with Python's lock free, so threads help; a signal such as
Ctrl-C ends the waiting. The package brings the program `hsd` too, which `python -m hsd` runs as well.
"""

from __future__ import annotations

from . import _native, town
from ._show import House, Model, show
from ._text import Error, Message, Parameters, Text, check, compile
from ._native import __version__

__all__ = [
    "Error", "House", "Message", "Model", "Parameters", "Text", "check", "compile", "parts", "show", "town", "__version__",
]


def parts(filter: str | None = None, *, language: str = "en") -> str:
    """The parts whose code or names hold a word, one a line; a capital letter is a class. All of them without."""
    return _native.parts(filter, language)

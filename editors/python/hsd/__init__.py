"""Houses and towns of hsd in Python and in notebooks.

    import hsd
    hsd.show('''0 0 180
    9.5

    KKS  TKD 2MRE
    KSK  MRE  KSK
    KKS  TIT 2KKS
    KSK  KSK  KSK
    ''')

The module runs the program `hsd`, which the wheel brings along.
"""

from ._program import Error, Message, check, parts, program, version
from ._show import House, Town, build, show, town
from ._steps import Sealed, StepError, Tile, plan, planned, seal, tile

# The steps of a large town stand where one looks for them: hsd.town.plan, .tile, .seal.
town.plan, town.planned, town.tile, town.seal = plan, planned, tile, seal


def compile(source, **how) -> bytes:
    """The bytes of a `.glb`, the model of a text or a file, as `build` makes it."""
    return build(source, **how).glb


__all__ = ["Error", "House", "Message", "Sealed", "StepError", "Tile", "Town", "build", "check", "compile", "parts", "program", "show", "town", "version"]

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

__all__ = ["Error", "House", "Message", "Town", "build", "check", "parts", "program", "show", "town", "version"]

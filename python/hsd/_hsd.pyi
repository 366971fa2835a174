from os import PathLike
from typing import final

__version__: str

class CompileError(Exception):
    args: tuple[str, list[Diagnostic]]

@final
class Diagnostic:
    @property
    def code(self) -> str: ...
    @property
    def severity(self) -> str: ...
    @property
    def message(self) -> str: ...
    @property
    def help(self) -> str: ...
    @property
    def file(self) -> str: ...
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...

def compile(
    text: str,
    name: str,
    folder: str | PathLike[str] | None,
    parameters: list[tuple[str, str]],
    seed: int | None,
    detail: int,
    language: str,
) -> bytes: ...
def check(
    text: str,
    name: str,
    folder: str | PathLike[str] | None,
    parameters: list[tuple[str, str]],
    seed: int | None,
    language: str,
) -> list[Diagnostic]: ...
def draw(
    text: str,
    name: str,
    folder: str | PathLike[str] | None,
    parameters: list[tuple[str, str]],
    seed: int | None,
    size: tuple[int, int],
    language: str,
) -> bytes: ...
def call(arguments: list[str]) -> tuple[int, str]: ...

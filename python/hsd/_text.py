"""Texts: what is wrong with them, and the bytes of their models."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Union

from . import _native

#: A text of more than one line, or the path of a file.
Text = Union[str, "os.PathLike[str]"]

#: Values of parameters by their names; truth values are `yes` and `no`.
Parameters = Mapping[str, object]


@dataclass(frozen=True)
class Message:
    """What hsd says of a place in a text, or of a feature of a map."""

    #: The stable code, such as `HSD0301`; `hsd explain` tells more.
    code: str
    #: `error`, `warning` or `note`.
    severity: str
    #: The problem.
    message: str
    #: How to mend it; empty if nothing can be said.
    fix: str
    #: The file, or `<text>`; None for a feature.
    file: str | None
    #: Line and column of its beginning, from 1.
    line: int | None
    column: int | None
    #: Layer and key of a feature.
    feature: tuple[str, str] | None

    def __str__(self) -> str:
        place = f"{self.line}:{self.column}: " if self.line else f"{' '.join(self.feature)}: " if self.feature else ""
        return f"{place}{self.severity}[{self.code}]: {self.message}" + (f"\n  help: {self.fix}" if self.fix else "")


class Error(Exception):
    """A text with errors, or a step that failed. `messages` are those of the text."""

    def __init__(self, text: str, messages: list[Message] | None = None) -> None:
        super().__init__(text)
        self.messages = messages or []

    def _render_traceback_(self) -> list[str]:
        # In a notebook what counts is the place in the text, not that in this package.
        return str(self).splitlines()


@dataclass(frozen=True)
class Job:
    """A text and how it is read, as the native half takes it."""

    text: str | None
    name: str
    folder: str
    parameters: list[tuple[str, str]]
    seed: int | None
    detail: int
    cutaway: bool
    storey: int | None
    japanese: bool


def is_text(source: Text) -> bool:
    """Whether a source is a text itself, not the path of one: it has more than one line."""
    return isinstance(source, str) and "\n" in source.strip("\n")


def pairs(parameters: Parameters | None) -> list[tuple[str, str]]:
    """Values as the language writes them."""
    def word(value: object) -> str:
        if isinstance(value, bool):
            return "yes" if value else "no"
        return str(value)

    return [(name, word(value)) for name, value in (parameters or {}).items()]


def messages_of(told: list[_native.Told]) -> list[Message]:
    return [Message(*one) for one in told]


def job(
    source: Text,
    parameters: Parameters | None = None,
    seed: int | None = None,
    detail: int = 3,
    cutaway: bool = False,
    storey: int | None = None,
    language: str = "en",
) -> Job:
    if detail not in (0, 1, 2, 3):
        raise ValueError("detail is 0, 1, 2 or 3")
    if storey is not None and storey < 1:
        raise ValueError("storeys are counted from 1")
    if language not in ("en", "ja"):
        raise ValueError("language is `en` or `ja`")
    if is_text(source):
        # A line break right after the quotes is no line of the text.
        text, name, folder = str(source).removeprefix("\n"), "<text>", "."
    else:
        text, name = None, os.fspath(source)
        folder = str(Path(name).parent)
    return Job(text, name, folder, pairs(parameters), seed, detail, cutaway, storey, language == "ja")


def made(job: Job, threads: int | None) -> tuple[bytes, list[Message]]:
    """The model of a text and its messages."""
    glb, told, report = _native.compile(job, threads or 0)
    messages = messages_of(told)
    if glb is None:
        raise Error(report.strip(), messages)
    return glb, messages


def compile(
    source: Text,
    *,
    detail: int = 3,
    parameters: Parameters | None = None,
    seed: int | None = None,
    cutaway: bool = False,
    storey: int | None = None,
    language: str = "en",
    threads: int | None = None,
) -> bytes:
    """Builds the model of a text, or of a file where `source` has one line: the bytes of a `.glb`, those of `hsd build`.

    `detail` is 0 (walls and roofs) to 3 (all joinery), `cutaway` leaves out roofs, `storey` all that is above one, counted from 1.
    Images and included files are found beside the file, or in the current folder. `threads` are one per processor without.

    Raises `Error` with line, reason and fix if the text has errors, and `OSError` if the file cannot be read.
    """
    return made(job(source, parameters, seed, detail, cutaway, storey, language), threads)[0]


def check(
    source: Text, *, parameters: Parameters | None = None, seed: int | None = None, language: str = "en", threads: int | None = None
) -> list[Message]:
    """Finds what is wrong with a text or a file, as `hsd check` does: rules of a town are evaluated with its maps. Errors are first."""
    return messages_of(_native.check(job(source, parameters, seed, language=language), threads or 0)[0])


def require(path: Text, parameters: Parameters | None, seed: int | None) -> list[Message]:
    """The messages on a file without errors; raises `Error` for one with errors."""
    told, report = _native.check(job(path, parameters, seed), 0)
    messages = messages_of(told)
    if any(message.severity == "error" for message in messages):
        raise Error(report.strip(), messages)
    return messages

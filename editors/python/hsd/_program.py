"""The program hsd: where it is, what it says of a text, and its errors."""

import dataclasses
import json
import os
import pathlib
import shutil
import subprocess
import sys
import sysconfig

_NAME = "hsd.exe" if sys.platform == "win32" else "hsd"


@dataclasses.dataclass(frozen=True)
class Message:
    """What hsd says of a place in a text: severity `error`, `warning` or `note`, reason, and fix."""

    code: str
    severity: str
    message: str
    fix: str
    file: str
    line: int
    column: int

    def __str__(self):
        place = f"{self.line}:{self.column}: " if self.line else ""
        return f"{place}{self.severity}[{self.code}]: {self.message}" + (f"\n  help: {self.fix}" if self.fix else "")


class Error(Exception):
    """A text with errors, or a program that cannot be run. `messages` are those of the text."""

    def __init__(self, text, messages=()):
        super().__init__(text)
        self.messages = list(messages)

    def _render_traceback_(self):
        # In a notebook what counts is the place in the text, not that in this module.
        return str(self).splitlines()


def program():
    """The path of the program: HSD in the environment, else that which pip installed, that on the path, or that of cargo."""
    chosen = os.environ.get("HSD")
    if chosen:
        return chosen
    scripts = [sysconfig.get_path("scripts"), sysconfig.get_path("scripts", f"{os.name}_user")]
    for folder in [*scripts, os.environ.get("PATH"), str(pathlib.Path.home() / ".cargo" / "bin")]:
        found = folder and shutil.which(_NAME, path=folder)
        if found:
            return found
    raise Error("the program hsd is not here: install the wheel that brings it, or set HSD to its path")


def plain():
    """The environment for a program whose words are not for a terminal: without colours."""
    return {**{k: v for k, v in os.environ.items() if k not in ("CLICOLOR_FORCE", "FORCE_COLOR")}, "NO_COLOR": "1"}


def run(words, text=None, folder=None):
    """Runs hsd; returns exit status, standard output as bytes, standard error."""
    try:
        done = subprocess.run([program(), *map(str, words)], input=(text or "").encode(), capture_output=True, cwd=folder, env=plain())
    except OSError as error:
        raise Error(f"{program()} cannot be run: {error.strerror or error}") from error
    return done.returncode, done.stdout, done.stderr.decode("utf-8", "replace")


def version():
    """The version of the program, such as `hsd 0.1.0`."""
    return run(["-V"])[1].decode().strip()


def is_text(source):
    """Whether a source is a text itself, not the path of one: it has more than one line."""
    return isinstance(source, str) and "\n" in source.strip("\n")


def words_of(source):
    """The argument for a source and what goes to standard input."""
    if is_text(source):
        # A line break right after the quotes is no line of the text.
        return "-", source[1:] if source.startswith("\n") else source
    return str(source), None


def settings(parameters, seed):
    """Arguments for values of parameters and the seed."""
    words = [] if seed is None else ["--seed", seed]
    for name, value in (parameters or {}).items():
        words += ["--param", f"{name}={('yes' if value else 'no') if isinstance(value, bool) else value}"]
    return words


def check(source, parameters=None, seed=None):
    """What hsd says of a text, or of a file: a list of `Message`."""
    name, text = words_of(source)
    status, out, errors = run(["check", "--format", "json", *settings(parameters, seed), name], text)
    try:
        found = json.loads(out)
    except ValueError as error:
        raise Error(errors.strip() or f"hsd check ended with {status}") from error
    return [Message(m["code"], m["severity"], m["message"], m.get("help") or "", m["file"], m["line"], m["column"]) for m in found]


def require(source, parameters=None, seed=None):
    """The messages on a text without errors; raises `Error` with the excerpts of `hsd check` for one with errors."""
    messages = check(source, parameters, seed)
    if any(m.severity == "error" for m in messages):
        name, text = words_of(source)
        _, out, errors = run(["check", *settings(parameters, seed), name], text)
        raise Error((out.decode("utf-8", "replace") + errors).strip(), messages)
    return messages


def parts(filter=""):
    """The parts whose code or names hold a word, one a line."""
    return run(["parts", *([filter] if filter else [])])[1].decode()

# SPDX-License-Identifier: MIT OR Apache-2.0
"""The program hsd for add-ons of other programs: where it is, and how it is started. Packed into each of them."""

import os
import pathlib
import shutil
import subprocess
import sys

NAME = "hsd.exe" if sys.platform == "win32" else "hsd"


class Failure(Exception):
    """hsd could not be run, or did not do what was asked; the text is for the user."""


def find(chosen, settings):
    """The program: the chosen one, that on the path, or that of cargo. `settings` says where the user chooses it."""
    if chosen:
        if pathlib.Path(chosen).is_file():
            return chosen
        raise Failure(f"there is no program {chosen}: choose hsd in {settings}")
    found = shutil.which(NAME) or shutil.which(NAME, path=str(pathlib.Path.home() / ".cargo" / "bin"))
    if not found:
        raise Failure(f"hsd is not on the path: install it, or choose it in {settings}")
    return found


def plain():
    """The environment for a program whose words are not for a terminal: without colours."""
    return {**{k: v for k, v in os.environ.items() if k not in ("CLICOLOR_FORCE", "FORCE_COLOR")}, "NO_COLOR": "1"}


def start(words):
    """Starts a command without a window, with its output and its errors in pipes."""
    hidden = {"creationflags": subprocess.CREATE_NO_WINDOW} if sys.platform == "win32" else {}
    words = [str(word) for word in words]
    try:
        return subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
                                errors="replace", env=plain(), **hidden)
    except OSError as error:
        raise Failure(f"{words[0]} cannot be run: {error.strerror or error}") from error

# SPDX-License-Identifier: GPL-2.0-or-later
"""The program hsd: where it is, and what it says. Nothing here needs QGIS."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import threading

NAME = "hsd.exe" if sys.platform == "win32" else "hsd"


class Failure(Exception):
    """hsd could not be run, or did not do what was asked; the text is for the user."""


def find(chosen=""):
    """The program: the chosen one, that on the path, or that of cargo."""
    if chosen:
        if pathlib.Path(chosen).is_file():
            return chosen
        raise Failure(f"there is no program {chosen}: choose hsd in Settings > Options > Processing > Providers > hsd")
    found = shutil.which(NAME) or shutil.which(NAME, path=str(pathlib.Path.home() / ".cargo" / "bin"))
    if not found:
        raise Failure("hsd is not on the path: install it, or choose it in Settings > Options > Processing > Providers > hsd")
    return found


def plain():
    """The environment for a program whose words are not for a terminal: without colours."""
    return {**{k: v for k, v in os.environ.items() if k not in ("CLICOLOR_FORCE", "FORCE_COLOR")}, "NO_COLOR": "1"}


def run(words, tell=lambda line: None, stopped=lambda: False):
    """Runs a command and tells each line of its standard error; ends it when the user stops. Status and standard output."""
    hidden = {"creationflags": subprocess.CREATE_NO_WINDOW} if sys.platform == "win32" else {}
    try:
        process = subprocess.Popen([str(w) for w in words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, encoding="utf-8", errors="replace", env=plain(), **hidden)
    except OSError as error:
        raise Failure(f"{words[0]} cannot be run: {error.strerror or error}") from error
    out = []
    readers = [threading.Thread(target=lambda: out.append(process.stdout.read())),
               threading.Thread(target=lambda: [tell(line.rstrip()) for line in process.stderr])]
    for reader in readers:
        reader.start()
    while True:
        try:
            process.wait(0.2)
            break
        except subprocess.TimeoutExpired:
            if stopped():
                process.kill()
    for reader in readers:
        reader.join()
    process.stdout.close()
    process.stderr.close()
    return process.returncode, "".join(out)


def messages(program, source, language):
    """What `hsd check` says of a source file."""
    said = []
    status, out = run([program, "check", "--lang", language, "--format", "json", source], said.append)
    try:
        return json.loads(out)
    except ValueError as error:
        raise Failure("\n".join(said) or f"hsd check ended with {status}") from error


def line_of(message):
    """A message in a line: place, reason, fix."""
    place = f"{message['file']}:{message['line']}:{message['column']}: " if message.get("line") else ""
    fix = f" ({message['help']})" if message.get("help") else ""
    return f"{place}{message['severity']}[{message['code']}]: {message['message']}{fix}"


def build(program, town, out, detail, language, tell, stopped):
    """Builds a town in tiles into a folder and returns the path of its tileset and of its table of decisions."""
    words = [program, "town", "--lang", language, town, "-o", f"{out}{os.sep}"]
    if detail:
        words += ["--detail", detail]
    status, _ = run(words, tell, stopped)
    if stopped():
        raise Failure("stopped")
    tileset = pathlib.Path(out) / "tileset.json"
    # 1 is the status when a feature has no house that nobody asked to skip: the town is there.
    if status not in (0, 1) or not tileset.exists():
        raise Failure(f"hsd town ended with {status}")
    return tileset, tileset.with_name("decisions.csv")

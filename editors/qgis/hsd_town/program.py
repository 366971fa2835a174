# SPDX-License-Identifier: GPL-2.0-or-later
"""The program hsd: where it is, and what it says. Nothing here needs QGIS."""

import json
import os
import pathlib
import subprocess
import threading

from . import executable
from .executable import Failure


def find(chosen=""):
    """The program: the chosen one, that on the path, or that of cargo."""
    return executable.find(chosen, "Settings > Options > Processing > Providers > hsd")


def run(words, tell=lambda line: None, stopped=lambda: False, heard=lambda line: None):
    """Runs a command, hears each line of its standard output and tells each of its standard error; ends it when the user stops.
    Returns its status."""
    process = executable.start(words)

    def read(stream, take):
        for line in stream:
            take(line.rstrip())

    readers = [threading.Thread(target=read, args=pair) for pair in ((process.stdout, heard), (process.stderr, tell))]
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
    return process.returncode


def line_of(message):
    """A message in a line: place, reason, fix."""
    place = f"{message['file']}:{message['line']}:{message['column']}: " if message.get("line") else ""
    fix = f" ({message['help']})" if message.get("help") else ""
    return f"{place}{message['severity']}[{message['code']}]: {message['message']}{fix}"


def build(program, town, out, detail, language, tell, progress, stopped):
    """Builds a town in tiles into a folder; calls `progress` with the features that are done and all of them. Returns the messages and
    the paths of its tileset and of its table of decisions, which are None after errors."""
    words = [program, "town", "--messages", "json", "--lang", language, town, "-o", f"{out}{os.sep}"]
    if detail:
        words += ["--detail", detail]
    said, built = [], []

    def heard(line):
        one = json.loads(line)
        if one["kind"] == "progress":
            progress(one["done"], one["of"])
        else:
            built.append(one)

    def kept(line):
        said.append(line)
        tell(line)

    status = run(words, kept, stopped, heard)
    if stopped():
        raise Failure("stopped")
    if not built:
        raise Failure("\n".join(said) or f"hsd town ended with {status}")
    messages = built[0]["messages"]
    if built[0]["output"] is None or any(m["severity"] == "error" for m in messages):
        return messages, None, None
    tileset = pathlib.Path(out) / "tileset.json"
    return messages, tileset, tileset.with_name("decisions.csv")

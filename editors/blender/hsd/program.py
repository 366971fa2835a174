# SPDX-License-Identifier: GPL-3.0-or-later
"""The program hsd: where it is, and what it says and builds. Nothing here needs Blender."""

import dataclasses
import json
import os
import pathlib
import re

from . import executable
from .executable import Failure

IMAGES = {".png", ".jpg", ".jpeg", ".webp"}


@dataclasses.dataclass
class Options:
    """How a source file is built. Parameters are those that are not left to the text."""

    detail: int = 3
    cutaway: bool = False
    storey: int = 0
    seed: str = ""
    parameters: dict = dataclasses.field(default_factory=dict)
    language: str = "en"

    def common(self):
        """Arguments that every command understands."""
        words = ["--lang", self.language]
        if self.seed:
            words += ["--seed", self.seed]
        for name, value in sorted(self.parameters.items()):
            words += ["--param", f"{name}={spell(value)}"]
        return words


@dataclasses.dataclass
class Built:
    """What came of a source file: messages, a model or a folder of tiles (None after errors), and the files read."""

    messages: list
    output: pathlib.Path | None
    files: list
    parameters: list


def spell(value):
    """A value as `--param` takes it."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6f}".rstrip("0").rstrip(".")
    return str(value)


def find(chosen=""):
    """The program: the chosen one, that on the path, or that of cargo."""
    return executable.find(chosen, "the preferences of the add-on")


def run(program, *words):
    """Runs hsd and returns exit status, standard output and standard error."""
    process = executable.start([program, *words])
    out, errors = process.communicate()
    return process.returncode, out, errors


def answer(program, *words):
    """The JSON on standard output, whatever the exit status says of the source."""
    status, out, errors = run(program, *words)
    try:
        return json.loads(out)
    except ValueError as error:
        raise Failure(errors.strip() or f"hsd {words[0]} ended with {status} and no answer") from error


def is_town(source):
    """Whether a source file describes a town: it has an element of that name."""
    try:
        text = pathlib.Path(source).read_bytes()
    except OSError as error:
        raise Failure(f"{source} cannot be read: {error.strerror}") from error
    return re.search(rb"<Town[\s>]", re.sub(rb"<!--.*?-->", b"", text, flags=re.S)) is not None


def model_files(path):
    """The files that a .glb names as its sources, as it writes them."""
    data = path.read_bytes()
    length = int.from_bytes(data[12:16], "little")
    extras = json.loads(data[20:20 + length])["asset"].get("extras", {})
    return extras.get("files", [])


def failed(status, errors):
    """A message of the form of `hsd check` for what a command wrote to standard error."""
    text = errors.strip() or f"hsd ended with exit status {status}"
    return {"code": "", "severity": "error", "message": text, "file": "", "line": 0, "column": 0, "help": ""}


def seen_from(folder, name):
    """The name of a file as a model names it: from the folder of its source file."""
    path = pathlib.Path(name)
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else path.as_posix()


def build(program, source, out, options, tiles=False):
    """Builds a source file, tells what hsd says of it, and lists its parameters: `out` is a .glb, or a folder for the tiles of a town."""
    source = pathlib.Path(source)
    parameters = answer(program, "params", "--format", "json", "--lang", options.language, source) or []
    town = is_town(source)
    words = ["town" if town else "build", "--messages", "json", "--detail", options.detail, *options.common()]
    if not town:
        # What stands above a storey is left out with its roofs, so the one goes before the other.
        if options.storey:
            words += ["--storey", options.storey]
        elif options.cutaway:
            words.append("--cutaway")
    target = f"{out}{os.sep}" if tiles else str(out)
    status, said, errors = run(program, *words, source, "-o", target)
    built = next((line for line in map(json.loads, said.splitlines()) if line["kind"] == "built"), None)
    if built is None:
        return Built([failed(status, errors)], None, [], parameters)
    messages, files = built["messages"], [seen_from(source.parent, name) for name in built["files"]]
    files += sorted({m["file"] for m in messages if m["file"]} - {*files})
    # A town with a feature that nothing was built of ends with 1, and is there.
    if built["output"] is None or any(m["severity"] == "error" for m in messages):
        return Built(messages, None, files, parameters)
    # What stands in a model names its file by a number of this list.
    numbered = [] if tiles else model_files(pathlib.Path(out))
    return Built(messages, pathlib.Path(out), list(dict.fromkeys([*numbered, *files])), parameters)


def stamp(source, files):
    """Times and sizes of a source file and of what it depends on: included files, own parts, and images beside it."""
    source = pathlib.Path(source)
    folder = source.parent
    paths = {source, folder / "catalog.hsd"}
    paths.update(folder / name for name in files if not name.startswith("hsd:"))
    for place in (folder, folder / "textures"):
        if place.is_dir():
            paths.update(p for p in place.iterdir() if p.suffix.lower() in IMAGES)
    seen = []
    for path in sorted(paths):
        try:
            told = path.stat()
        except OSError:
            continue
        seen.append(f"{path}:{told.st_mtime_ns}:{told.st_size}")
    return "|".join(seen)

"""Folders of towns: whether two are the same, and whether a tileset names each of its tiles once."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from pathlib import Path


def tree(folder: Path) -> str:
    """Returns the hash of names and bytes of all files in a folder."""
    total = hashlib.sha256()
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        with open(path, "rb") as file:
            own = hashlib.file_digest(file, "sha256") if hasattr(hashlib, "file_digest") else hashlib.sha256(file.read())
        total.update(str(path.relative_to(folder)).encode() + b"\0" + own.digest())
    return total.hexdigest()


def contents(tileset: Path) -> list[str]:
    """Returns the files that a tileset and its branches name."""
    found = []

    def visit(node: dict) -> None:
        uri = node.get("content", {}).get("uri")
        if uri and uri.endswith(".json"):
            visit(json.loads((tileset.parent / uri).read_text())["root"])
        elif uri:
            found.append(uri)
        for child in node.get("children", []):
            visit(child)

    visit(json.loads(tileset.read_text())["root"])
    return found


def faults(town: Path) -> list[str]:
    """Returns the tiles that a town names twice, those that it names and lacks, and those that it has and does not name."""
    named = Counter(contents(town / "tileset.json"))
    there = {f"tiles/{path.name}" for path in (town / "tiles").glob("*.glb")}
    twice = [f"{uri} is named twice" for uri, count in named.items() if count > 1]
    missing = [f"{uri} is missing" for uri in set(named) - there]
    return sorted(twice + missing + [f"{uri} is not named" for uri in there - set(named)])

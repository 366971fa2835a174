"""Puts what was made into an object store, each file only if it is not there: `python upload.py OUT URL`.

    python upload.py out s3://bucket/kyoto            any store that fsspec has (`pip install s3fs`, gcsfs, adlfs)
    python upload.py out file:///mnt/kyoto

The store decides who was first (`If-None-Match: *` and the like), so any number of machines may put up the same town at a time and
again: names of tiles and images tell what is in them. What whoever reads begins with, the tables and the root of the tileset, comes last
and is written over.
"""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

#: Folders whose files never change under their names, those that others name first.
NAMED_BY_CONTENT = ("textures", "tiles")

#: What readers begin with.
ROOT = "tileset.json"


def put(store: Any, source: Path, target: str) -> str:
    """Puts a file, whole or not at all, where there is none; returns `put` or `there`."""
    from fsspec.implementations.local import LocalFileSystem

    try:
        if isinstance(store, LocalFileSystem):
            # A folder shows half a file, unlike a store of objects.
            with tempfile.TemporaryDirectory(prefix=".", dir=Path(target).parent) as folder:
                own = shutil.copyfile(source, Path(folder, source.name))
                os.link(own, target)
        else:
            store.pipe_file(target, source.read_bytes(), mode="create")
        return "put"
    except FileExistsError:
        return "there"


def upload(out: Path, url: str, threads: int = 16) -> Counter[str]:
    """Puts a town up; returns how many of its files were put and how many were there."""
    import fsspec

    store, base = fsspec.core.url_to_fs(url)
    counted: Counter[str] = Counter()
    store.makedirs(base, exist_ok=True)
    for folder in NAMED_BY_CONTENT:
        files = sorted(path for path in (out / folder).iterdir() if path.is_file()) if (out / folder).is_dir() else []
        store.makedirs(f"{base}/{folder}", exist_ok=True)
        with ThreadPoolExecutor(threads) as pool:
            counted.update(pool.map(lambda path: put(store, path, f"{base}/{folder}/{path.name}"), files))
    others = sorted((path for path in out.iterdir() if path.is_file()), key=lambda path: path.name == ROOT)
    for path in others:
        store.put_file(str(path), f"{base}/{path.name}")
    counted["written"] += len(others)
    return counted


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(", ".join(f"{count} {word}" for word, count in upload(Path(sys.argv[1]), sys.argv[2]).items()))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Towns in tiles: each tile is a collection in a .blend file of its own, linked and put up by an empty.

The .blend files lie in a folder `blender` of the town, since hsd sweeps those of its tiles. The name of a tile holds a hash
of what is in it, so a tile that has not changed keeps its .blend file.
"""

import json
import pathlib
import re
from urllib.parse import unquote

import bpy

from . import model


def contents(folder, name="tileset.json"):
    """The models that a tileset names, through the further files of its tree, in their order."""
    tree = json.loads((folder / name).read_text(encoding="utf-8"))
    found, open_nodes = [], [tree["root"]]
    while open_nodes:
        node = open_nodes.pop(0)
        for one in [*([node["content"]] if "content" in node else []), *node.get("contents", [])]:
            uri = unquote(one["uri"])
            found += contents(folder, uri) if uri.endswith(".json") else [uri]
        open_nodes += node.get("children", [])
    return list(dict.fromkeys(found))


def key_of(uri):
    """The key of a tile: its name without the hash of its content and the level of detail."""
    return re.sub(r"-[0-9a-f]{16}(-\d)?$", "", pathlib.PurePosixPath(uri).stem)


def library(path):
    """The .blend file of a tile, made from its model where it is not there yet. Returns it and the name of the collection."""
    blend, name = path.parents[1] / "blender" / f"{path.stem}.blend", path.stem
    if blend.exists():
        return blend, name
    blend.parent.mkdir(exist_ok=True)
    fresh, stuff, images = model.import_file(path)
    holder = bpy.data.collections.new(name)
    name = holder.name
    for thing in fresh:
        model.link_to(thing, holder)
    # Its images lie beside all tiles of the town, so the file names them and does not hold them.
    for image in images:
        if image.packed_file and not image.filepath.startswith("//") and pathlib.Path(image.filepath).is_file():
            image.unpack(method="REMOVE")
    half = blend.with_suffix(".part.blend")
    bpy.data.libraries.write(str(half), {holder}, path_remap="RELATIVE_ALL", compress=True)
    half.replace(blend)
    meshes = [o.data for o in fresh if o.data]
    for thing in fresh:
        bpy.data.objects.remove(thing)
    bpy.data.collections.remove(holder)
    bpy.data.batch_remove([*dict.fromkeys(m for m in meshes if m), *stuff, *images])
    return blend, path.stem


def link(blend, name):
    """The linked collection of a tile."""
    for collection in bpy.data.collections:
        if collection.library and collection.name == name and pathlib.Path(bpy.path.abspath(collection.library.filepath)) == blend:
            return collection
    with bpy.data.libraries.load(str(blend), link=True, relative=bool(bpy.data.filepath)) as (inside, wanted):
        wanted.collections = [n for n in inside.collections if n == name] or list(inside.collections)[:1]
    return wanted.collections[0]


def load(collection, folder):
    """Puts the tiles of a folder up in a collection, or what has changed of them; empties that were moved stay moved."""
    uid, report = collection.hsd.uid, model.Report()
    there = {o.hsd.key: o for o in bpy.data.objects if o.hsd.uid == uid}
    uris = contents(folder)
    for uri in uris:
        key = key_of(uri)
        tile = link(*library(folder / uri))
        empty = there.pop(key, None)
        if empty is None:
            empty = bpy.data.objects.new(f"tile {key}", None)
            empty.instance_type = "COLLECTION"
            empty.empty_display_size = 10
            collection.objects.link(empty)
            empty.instance_collection = tile
            empty["tile"] = key
            model.remember(empty, uid, key)
            report.added += 1
            continue
        report.kept += 1
        report.moved += not model.same(empty.hsd.place, model.place(empty.matrix_basis))
        empty.instance_collection = tile
    model.drop(list(there.values()), report)
    used = {o.instance_collection for o in bpy.data.objects if o.instance_collection}
    unused = [c for c in bpy.data.collections if c.library and c not in used and not c.users]
    for one in {c.library for c in unused}:
        if folder in pathlib.Path(bpy.path.abspath(one.filepath)).parents:
            bpy.data.libraries.remove(one)
    stems = {pathlib.PurePosixPath(uri).stem for uri in uris}
    for blend in (folder / "blender").glob("*.blend"):
        if blend.stem not in stems:
            blend.unlink()
    return report

# SPDX-License-Identifier: GPL-3.0-or-later
"""Source files in a scene: each is a collection that knows its file, its settings and what hsd said of it."""

import json
import pathlib
import shutil
import tempfile
import uuid
from concurrent.futures import ThreadPoolExecutor

import bpy

from . import model, program, town

# Building runs beside Blender; only what touches the scene waits for it.
_pool = ThreadPoolExecutor(max_workers=2)
_jobs = {}
_seen = {}


def preferences():
    """The preferences of the add-on; None in a Blender that has loaded it without enabling it."""
    entry = bpy.context.preferences.addons.get(__package__)
    return entry.preferences if entry else None


def program_path():
    own = preferences()
    return program.find(bpy.path.abspath(own.program) if own and own.program else "")


def language():
    return "ja" if bpy.app.translations.locale.startswith("ja") else "en"


def sources():
    """The collections that come from source files."""
    return [c for c in bpy.data.collections if c.hsd.path and not c.library]


def path_of(collection):
    return pathlib.Path(bpy.path.abspath(collection.hsd.path))


def of_object(thing):
    """The collection that an object came into the scene with."""
    uid = thing.hsd.uid if thing else ""
    return next((c for c in sources() if uid and c.hsd.uid == uid), None)


def current(context):
    """The source file that panels speak of: that of the active object, that of the active collection, or the only one."""
    found = of_object(context.object)
    active = context.collection
    if found is None and active and active.hsd.path:
        found = active
    rest = sources()
    return found or (rest[0] if len(rest) == 1 else None)


def create(path):
    """A collection for a source file, empty yet."""
    collection = bpy.data.collections.new(pathlib.Path(path).stem)
    bpy.context.scene.collection.children.link(collection)
    collection.hsd.uid = uuid.uuid4().hex
    collection.hsd.path = str(path)
    collection.hsd.is_town = program.is_town(bpy.path.abspath(str(path)))
    return collection


def value_key(name):
    """The custom property of the collection that holds the value of a parameter."""
    return f"hsd {name}"


def value_of(collection, parameter):
    """The value of a parameter as hsd takes it."""
    value = collection.get(value_key(parameter.name))
    if parameter.kind == "choice":
        return json.loads(parameter.choices)[int(value)]
    if parameter.kind == "switch":
        return bool(value)
    return value


def options(collection):
    own = collection.hsd
    given = {p.name: value_of(collection, p) for p in own.parameters if p.given}
    return program.Options(int(own.detail), own.cutaway, own.storey, own.seed.strip(), given, language())


def list_parameters(collection, listed):
    """Makes sliders of the parameters that hsd lists; what the user has set stays set."""
    given = {p.name: value_of(collection, p) for p in collection.hsd.parameters if p.given}
    collection.hsd.parameters.clear()
    for one in listed:
        parameter = collection.hsd.parameters.add()
        name, default = one["name"], one["value"]
        parameter.name = name
        parameter.unit = one["unit"] or ""
        parameter.random = one["random"]
        parameter.given = name in given
        value = given.get(name, default)
        told = (one.get("doc_ja") if language() == "ja" else None) or one.get("doc") or ""
        key, look = value_key(name), {"description": told}
        if one["choices"] and all(isinstance(c, str) for c in one["choices"]):
            parameter.kind, parameter.choices = "choice", json.dumps(one["choices"])
            at = one["choices"].index(value) if value in one["choices"] else 0
            collection[key] = at
            look["items"] = [(c, c, "", i) for i, c in enumerate(one["choices"])]
            look["default"] = one["choices"].index(default) if default in one["choices"] else 0
        elif isinstance(default, bool):
            parameter.kind = "switch"
            collection[key] = bool(value)
        elif isinstance(default, (int, float)):
            parameter.kind = "number"
            collection[key] = float(value)
            for word, bound in (("min", one["min"]), ("max", one["max"])):
                if bound is not None:
                    look[word] = look[f"soft_{word}"] = float(bound)
            look["default"], look["precision"] = float(default), 2
            if one["step"]:
                look["step"] = float(one["step"])
        else:
            parameter.kind = "text"
            collection[key] = str(value)
        collection.id_properties_ui(key).update(**look)
        parameter.shown = spell(collection, parameter)


def spell(collection, parameter):
    return program.spell(value_of(collection, parameter))


def mark_changes(collection):
    """A parameter whose value the user has changed is given from then on."""
    for parameter in collection.hsd.parameters:
        now = spell(collection, parameter)
        if now != parameter.shown:
            parameter.shown, parameter.given = now, True


def signature(collection):
    """What a model depends on: its files, its settings and parameters. Another one asks for another model."""
    own = collection.hsd
    mark_changes(collection)
    files = program.stamp(path_of(collection), [f.name for f in own.files])
    return json.dumps([files, vars(options(collection)), own.as_tiles], default=str, sort_keys=True)


def tiles_folder(collection):
    """Where the tiles of a town are kept: as set, or beside the source file."""
    chosen = collection.hsd.folder
    path = path_of(collection)
    return pathlib.Path(bpy.path.abspath(chosen)) if chosen else path.with_name(f"{path.stem}.tiles")


def begin(collection):
    """What a build needs, gathered where the scene may be read; the result is a function that may run anywhere."""
    executable, path, how = program_path(), path_of(collection), options(collection)
    tiles = collection.hsd.is_town and collection.hsd.as_tiles
    out = tiles_folder(collection) if tiles else pathlib.Path(tempfile.mkdtemp(prefix="hsd-")) / f"{path.stem}.glb"
    return lambda: program.build(executable, path, out, how, tiles)


def say(collection, messages):
    collection.hsd.messages.clear()
    for one in messages:
        message = collection.hsd.messages.add()
        for word in ("code", "severity", "file"):
            setattr(message, word, one.get(word) or "")
        message.text, message.fix = one["message"], one.get("help") or ""
        message.line, message.column = one.get("line") or 0, one.get("column") or 0


def complain(collection, text):
    say(collection, [program.failed(3, text)])
    collection.hsd.status = text


def finish(collection, built):
    """Brings what was built into the scene. After errors the scene stays as it is."""
    say(collection, built.messages)
    list_parameters(collection, built.parameters)
    # Included files that only a broken source names must be looked at too, so names are added to those known.
    known = [f.name for f in collection.hsd.files] if built.output is None else []
    collection.hsd.files.clear()
    for name in dict.fromkeys([*known, *built.files]):
        collection.hsd.files.add().name = name
    if built.output is None:
        collection.hsd.status = f"{sum(m['severity'] == 'error' for m in built.messages)} errors: the model is the last good one"
        return None
    if built.output.is_dir():
        report = town.load(collection, built.output)
    else:
        report = model.load(collection, built.output)
        shutil.rmtree(built.output.parent, ignore_errors=True)
    for lost in report.lost:
        message = collection.hsd.messages.add()
        message.severity, message.text = "note", f"gone from the text, with notes of yours: {lost}"
    collection.hsd.status = report.line()
    return report


def build(collection):
    """Builds and reads a source file now, and waits for it. Returns the report, or None after errors."""
    _jobs.pop(collection.hsd.uid, None)
    try:
        collection.hsd.is_town = program.is_town(path_of(collection))
        report = finish(collection, begin(collection)())
    except program.Failure as failure:
        complain(collection, str(failure))
        report = None
    collection.hsd.stamp = signature(collection)
    return report


def tick():
    """Looks at every source that is watched: begins a build where something has changed, ends one that is done."""
    for collection in sources():
        own = collection.hsd
        job = _jobs.get(own.uid)
        if job is not None:
            if job.done():
                end_job(collection, job)
            continue
        if not own.watch:
            continue
        now = signature(collection)
        # A file may be in the middle of being written: it has to look the same twice.
        if now != own.stamp and _seen.get(own.uid) == now:
            start_job(collection)
        _seen[own.uid] = now


def start_job(collection):
    collection.hsd.stamp = signature(collection)
    try:
        collection.hsd.is_town = program.is_town(path_of(collection))
        _jobs[collection.hsd.uid] = _pool.submit(begin(collection))
    except program.Failure as failure:
        complain(collection, str(failure))
        redraw()


def end_job(collection, job):
    del _jobs[collection.hsd.uid]
    before = json.loads(collection.hsd.stamp)
    try:
        finish(collection, job.result())
    except program.Failure as failure:
        complain(collection, str(failure))
    # What the build itself has found, included files, is no change.
    after = json.loads(signature(collection))
    if before[1:] == after[1:]:
        collection.hsd.stamp = json.dumps(after, sort_keys=True)
    if not bpy.app.background and bpy.context.window_manager.windows:
        bpy.ops.ed.undo_push(message="hsd: reload")
    redraw()


def redraw():
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            area.tag_redraw()


def timer():
    """The timer that Blender calls; nothing in it may end it."""
    try:
        # What draws or edits the scene must not have it changed below it.
        busy = any(bpy.app.is_job_running(job) for job in ("RENDER", "OBJECT_BAKE"))
        if bpy.context.mode == "OBJECT" and not busy:
            tick()
    except ReferenceError:
        pass
    except Exception as error:  # noqa: BLE001: told, and tried again at the next change
        print(f"hsd: {error!r}")
    return 0.5


def where(collection, thing):
    """File, line and column of a thing in the text of the user: its own, or those of the thing that it is part of."""
    root, names = path_of(collection).parent, [f.name for f in collection.hsd.files]
    while thing is not None:
        line, number = thing.get("line"), int(thing.get("file", 0))
        if line:
            name = names[number] if number < len(names) else ""
            # Texts that come with the program have no file: the place that asks for them counts.
            if name and not name.startswith("hsd:"):
                return root / name, int(line), int(thing.get("column", 1))
        thing = thing.parent
    return None


def forget_jobs():
    _jobs.clear()
    _seen.clear()

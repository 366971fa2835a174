# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user does: import, reload, jump to a line."""

import pathlib
import shlex
import subprocess

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from . import program, source
from .properties import DETAILS


def tell(operator, collection, report):
    """Says what a build has done; an error is told with its line and its fix."""
    if report is not None:
        operator.report({"INFO"}, f"{collection.name}: {collection.hsd.status}")
        return {"FINISHED"}
    errors = [m for m in collection.hsd.messages if m.severity == "error"]
    first = errors[0] if errors else None
    text = f"{first.line}:{first.column} {first.text}" if first and first.line else (first.text if first else collection.hsd.status)
    operator.report({"WARNING"}, f"{collection.name}: {text}")
    return {"FINISHED"}


class HSD_OT_import(bpy.types.Operator, ImportHelper):
    """Import a house or a town from its text"""

    bl_idname = "import_scene.hsd"
    bl_label = "Import House Text"
    bl_options = {"REGISTER", "UNDO"}
    filename_ext = ".hsd"

    filter_glob: StringProperty(default="*.hsd", options={"HIDDEN"})
    detail: EnumProperty(name="Detail", items=DETAILS, default="3")
    watch: BoolProperty(name="Reload on Save", default=True)
    as_tiles: BoolProperty(name="Towns as Tiles", default=True)

    def execute(self, _context):
        path = pathlib.Path(bpy.path.abspath(self.filepath))
        try:
            collection = source.create(path)
        except program.Failure as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        collection.hsd.detail, collection.hsd.watch, collection.hsd.as_tiles = self.detail, self.watch, self.as_tiles
        return tell(self, collection, source.build(collection))


class Rebuild:
    """What operators have in common that build the current source file again."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return source.current(context) is not None

    def prepare(self, collection):
        """What is done before."""

    def execute(self, context):
        collection = source.current(context)
        self.prepare(collection)
        return tell(self, collection, source.build(collection))


class HSD_OT_reload(Rebuild, bpy.types.Operator):
    """Build the text again and read the model; what you have moved, painted and noted stays"""

    bl_idname = "hsd.reload"
    bl_label = "Reload"


class HSD_OT_reset(Rebuild, bpy.types.Operator):
    """Leave all parameters to the text again"""

    bl_idname = "hsd.reset_parameters"
    bl_label = "Values of the Text"

    def prepare(self, collection):
        for parameter in collection.hsd.parameters:
            parameter.given = False


def open_text(context, path, line, column):
    """Opens a place in Blender's text editor: in one that is on the screen, else in a new window."""
    there = [t for t in bpy.data.texts if t.filepath and pathlib.Path(bpy.path.abspath(t.filepath)) == path]
    text = there[0] if there else bpy.data.texts.load(str(path))
    if there and text.is_modified and not text.is_dirty:
        text.clear()
        text.write(path.read_text(encoding="utf-8", errors="replace"))
    text.cursor_set(max(line - 1, 0), character=max(column - 1, 0))
    windows = context.window_manager.windows
    if bpy.app.background or not windows:
        return text
    areas = [a for w in windows for a in w.screen.areas if a.type == "TEXT_EDITOR"]
    if not areas:
        bpy.ops.wm.window_new()
        areas = [windows[-1].screen.areas[0]]
        areas[0].type = "TEXT_EDITOR"
    areas[0].spaces.active.text = text
    areas[0].spaces.active.show_line_numbers = True
    areas[0].spaces.active.top = max(line - 10, 0)
    return text


def go(operator, context, path, line, column):
    own = source.preferences()
    if not path.is_file():
        operator.report({"ERROR"}, f"{path} is not there")
        return {"CANCELLED"}
    if own and own.editor:
        words = [w.format(file=path, line=line, column=column) for w in shlex.split(own.editor)]
        try:
            subprocess.Popen(words)
        except OSError as error:
            operator.report({"ERROR"}, f"{words[0]}: {error.strerror}")
            return {"CANCELLED"}
    else:
        open_text(context, path, line, column)
    operator.report({"INFO"}, f"{path.name}, line {line}")
    return {"FINISHED"}


class HSD_OT_jump(bpy.types.Operator):
    """Go to the line that the active object is written in"""

    bl_idname = "hsd.jump"
    bl_label = "Go to Line"

    @classmethod
    def poll(cls, context):
        return source.of_object(context.object) is not None

    def execute(self, context):
        place = source.where(source.of_object(context.object), context.object)
        if place is None:
            self.report({"WARNING"}, "the text says nothing of this object")
            return {"CANCELLED"}
        return go(self, context, *place)


class HSD_OT_open(bpy.types.Operator):
    """Go to the place that a message speaks of"""

    bl_idname = "hsd.open"
    bl_label = "Go to Place"

    file: StringProperty()
    line: IntProperty()
    column: IntProperty()

    def execute(self, context):
        return go(self, context, pathlib.Path(self.file), self.line, self.column)


class HSD_OT_find(bpy.types.Operator):
    """Select what is written in the line of the cursor"""

    bl_idname = "hsd.find"
    bl_label = "Select What This Line Makes"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        space = context.space_data
        return space is not None and space.type == "TEXT_EDITOR" and space.text is not None and space.text.filepath

    def execute(self, context):
        text = context.space_data.text
        path, line = pathlib.Path(bpy.path.abspath(text.filepath)), text.current_line_index + 1
        found = select(context, path, line)
        self.report({"INFO"}, f"line {line}: {found} objects")
        return {"FINISHED"}


def select(context, path, line):
    """Selects the objects that a line makes and returns how many they are."""
    for thing in context.selected_objects:
        thing.select_set(False)
    found = 0
    for collection in source.sources():
        for thing in collection.all_objects:
            if thing.get("line") == line and source.where(collection, thing) == (path, line, thing.get("column", 1)):
                thing.select_set(True)
                context.view_layer.objects.active = thing
                found += 1
    return found


class HSD_OT_decisions(bpy.types.Operator):
    """Open the table that says for each feature of the maps what was built and why"""

    bl_idname = "hsd.decisions"
    bl_label = "Table of Decisions"

    @classmethod
    def poll(cls, context):
        collection = source.current(context)
        return collection is not None and (source.tiles_folder(collection) / "decisions.csv").is_file()

    def execute(self, context):
        return go(self, context, source.tiles_folder(source.current(context)) / "decisions.csv", 1, 1)


CLASSES = (HSD_OT_import, HSD_OT_reload, HSD_OT_reset, HSD_OT_jump, HSD_OT_open, HSD_OT_find, HSD_OT_decisions)

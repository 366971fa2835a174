# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels in the sidebar of the 3D view."""

import textwrap

import bpy

from . import source

ICONS = {"error": "CANCEL", "warning": "ERROR", "note": "INFO"}


class Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "hsd"


class HSD_PT_source(Panel, bpy.types.Panel):
    bl_label = "House Text"

    def draw(self, context):
        layout, collection = self.layout, source.current(context)
        layout.operator("import_scene.hsd", icon="IMPORT")
        if collection is None:
            layout.label(text="Select a house, or import one")
            return
        own = collection.hsd
        layout.prop(own, "path", text="")
        row = layout.row(align=True)
        row.operator("hsd.reload", icon="FILE_REFRESH")
        row.prop(own, "watch", toggle=True)
        column = layout.column()
        column.prop(own, "detail", text="")
        if own.is_town:
            column.prop(own, "as_tiles")
            if own.as_tiles:
                column.prop(own, "folder")
                column.operator("hsd.decisions", icon="SPREADSHEET")
        else:
            column.prop(own, "storey")
            row = column.row()
            row.enabled = own.storey == 0
            row.prop(own, "cutaway")
        column.prop(own, "seed")
        if own.status:
            layout.label(text=own.status, translate=False)


class HSD_PT_messages(Panel, bpy.types.Panel):
    bl_label = "Messages"

    @classmethod
    def poll(cls, context):
        collection = source.current(context)
        return collection is not None and len(collection.hsd.messages) > 0

    def draw(self, context):
        width = max(int(context.region.width / 8), 24) if context.region else 40
        for message in source.current(context).hsd.messages:
            box = self.layout.box().column(align=True)
            row = box.row()
            row.label(text=message.code or message.severity, icon=ICONS.get(message.severity, "INFO"), translate=False)
            if message.line:
                place = row.operator("hsd.open", text=f"{message.line}:{message.column}", icon="TEXT", translate=False)
                place.file, place.line, place.column = message.file, message.line, message.column
            for line in wrapped(message.text, width):
                box.label(text=line, translate=False)
            for at, line in enumerate(wrapped(message.fix, width)):
                box.label(text=line, icon="LIGHT" if at == 0 else "BLANK1", translate=False)


class HSD_PT_parameters(Panel, bpy.types.Panel):
    bl_label = "Parameters"

    @classmethod
    def poll(cls, context):
        collection = source.current(context)
        return collection is not None and len(collection.hsd.parameters) > 0

    def draw(self, context):
        collection = source.current(context)
        column = self.layout.column(align=True)
        for parameter in collection.hsd.parameters:
            row = column.row(align=True)
            row.prop(parameter, "given", text="")
            text = f"{parameter.name} ({parameter.unit})" if parameter.unit else parameter.name
            row.prop(collection, f'["{source.value_key(parameter.name)}"]', text=text, translate=False)
        self.layout.operator("hsd.reset_parameters", icon="LOOP_BACK")


class HSD_PT_thing(Panel, bpy.types.Panel):
    bl_label = "This Object"

    @classmethod
    def poll(cls, context):
        return source.of_object(context.object) is not None

    def draw(self, context):
        thing, collection = context.object, source.of_object(context.object)
        for key in ("kind", "code", "ja", "en", "storey", "facade", "id", "tile"):
            if thing.get(key) is not None:
                row = self.layout.row()
                row.label(text=key)
                row.label(text=str(thing[key]), translate=False)
        place = source.where(collection, thing)
        if place:
            self.layout.operator("hsd.jump", icon="TEXT", text=f"{place[0].name}:{place[1]}", translate=False)


def wrapped(text, width):
    """Lines of a text; characters of Japanese count twice, since they are as wide."""
    if text.isascii():
        return textwrap.wrap(text, width)
    lines, line, used = [], "", 0
    for letter in text:
        line, used = line + letter, used + (1 if letter.isascii() else 2)
        if used >= width:
            lines, line, used = [*lines, line], "", 0
    return [*lines, line] if line else lines


CLASSES = (HSD_PT_source, HSD_PT_messages, HSD_PT_parameters, HSD_PT_thing)

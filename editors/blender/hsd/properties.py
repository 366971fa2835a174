# SPDX-License-Identifier: GPL-3.0-or-later
"""What the add-on writes down in a .blend file, and its preferences."""

import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatVectorProperty, IntProperty, PointerProperty,
                       StringProperty)

DETAILS = [
    ("0", "0 Walls and roofs", "About a hundred triangles a house"),
    ("1", "1 Pictures of parts", "A picture for each part, baked from its geometry"),
    ("2", "2 Openings", "Openings and heavy bars as geometry"),
    ("3", "3 Everything", "All joinery as geometry"),
]


class HsdFile(bpy.types.PropertyGroup):
    """A file that a model was built from, relative to the folder of the source file."""

    name: StringProperty()


class HsdMessage(bpy.types.PropertyGroup):
    """What hsd says of a place in a source file."""

    code: StringProperty()
    severity: StringProperty()
    text: StringProperty()
    fix: StringProperty()
    file: StringProperty()
    line: IntProperty()
    column: IntProperty()


class HsdParameter(bpy.types.PropertyGroup):
    """A parameter of a source file; its value is a custom property of the collection, which has a slider."""

    name: StringProperty()
    kind: StringProperty()
    choices: StringProperty()
    unit: StringProperty()
    random: BoolProperty()
    shown: StringProperty()
    given: BoolProperty(name="Set", description="Use this value; otherwise that of the text, which may be drawn at random")


class HsdSource(bpy.types.PropertyGroup):
    """A source file that a collection comes from."""

    uid: StringProperty()
    path: StringProperty(name="File", subtype="FILE_PATH")
    watch: BoolProperty(name="Reload on Save", default=True, description="Build again whenever the file, an included file, an image beside it or a setting changes")
    detail: EnumProperty(name="Detail", items=DETAILS, default="3")
    cutaway: BoolProperty(name="Without Roofs", description="Leave out roofs, and the ceilings of the highest storey")
    storey: IntProperty(name="Up to Storey", min=0, soft_max=9, description="Show the storeys up to this one; 0 shows all")
    seed: StringProperty(name="Seed", description="The random seed of every house; empty: that of the text")
    is_town: BoolProperty()
    as_tiles: BoolProperty(name="Tiles", default=True, description="Bring a town in as linked collections, one a tile; otherwise as objects, part by part")
    folder: StringProperty(name="Folder", subtype="DIR_PATH", description="Where tiles are kept; empty: beside the source file")
    files: CollectionProperty(type=HsdFile)
    messages: CollectionProperty(type=HsdMessage)
    parameters: CollectionProperty(type=HsdParameter)
    status: StringProperty()
    stamp: StringProperty()


class HsdThing(bpy.types.PropertyGroup):
    """What an object was like in the text when it was read last."""

    uid: StringProperty()
    key: StringProperty()
    name: StringProperty()
    parent: StringProperty()
    place: FloatVectorProperty(size=10)
    slots: StringProperty()
    text_keys: StringProperty()


class HsdMaterial(bpy.types.PropertyGroup):
    """Which material of a source this is, and what it looked like when it was read."""

    uid: StringProperty()
    name: StringProperty()
    look: StringProperty()


class HsdImage(bpy.types.PropertyGroup):
    """Which source an image came with, and a hash of its content."""

    uid: StringProperty()
    content: StringProperty()


class HsdPreferences(bpy.types.AddonPreferences):
    """Where hsd is, and which editor opens source files."""

    bl_idname = __package__

    program: StringProperty(name="Program", subtype="FILE_PATH", description="The program hsd; empty: that on the path, or that of cargo")
    editor: StringProperty(name="Editor", description="Command that opens a place in a text, such as: code -g {file}:{line}:{column}; empty: Blender's own editor")

    def draw(self, _context):
        self.layout.prop(self, "program")
        self.layout.prop(self, "editor")


CLASSES = (HsdFile, HsdMessage, HsdParameter, HsdSource, HsdThing, HsdMaterial, HsdImage, HsdPreferences)
HOLDERS = ((bpy.types.Collection, HsdSource), (bpy.types.Object, HsdThing), (bpy.types.Material, HsdMaterial), (bpy.types.Image, HsdImage))


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    for holder, group in HOLDERS:
        holder.hsd = PointerProperty(type=group)


def unregister():
    for holder, _ in HOLDERS:
        del holder.hsd
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)

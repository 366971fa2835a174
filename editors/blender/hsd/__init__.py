# SPDX-License-Identifier: GPL-3.0-or-later
"""Houses and towns from the texts of hsd, in Blender."""

import bpy

from . import operators, panels, properties, source, words

CLASSES = (*operators.CLASSES, *panels.CLASSES)


def menu_import(self, _context):
    self.layout.operator("import_scene.hsd", text="House Text (.hsd)")


def menu_text(self, _context):
    self.layout.separator()
    self.layout.operator("hsd.find")


@bpy.app.handlers.persistent
def loaded(*_):
    """Another .blend file is open: what was under way for the last one is no more."""
    source.forget_jobs()


def register():
    properties.register()
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.app.translations.register(__package__, words.TRANSLATIONS)
    bpy.types.TOPBAR_MT_file_import.append(menu_import)
    bpy.types.TEXT_MT_context_menu.append(menu_text)
    bpy.app.handlers.load_post.append(loaded)
    bpy.app.timers.register(source.timer, first_interval=1.0, persistent=True)


def unregister():
    if bpy.app.timers.is_registered(source.timer):
        bpy.app.timers.unregister(source.timer)
    bpy.app.handlers.load_post.remove(loaded)
    bpy.types.TEXT_MT_context_menu.remove(menu_text)
    bpy.types.TOPBAR_MT_file_import.remove(menu_import)
    bpy.app.translations.unregister(__package__)
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
    properties.unregister()

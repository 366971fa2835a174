# SPDX-License-Identifier: GPL-3.0-or-later
"""Models in a collection: read for the first time, and read again so that what the user did to them stays.

Things are found again by the `id` that hsd writes (a place, such as `shop/s1/f2/91`). A thing that is there keeps its
object, with modifiers, constraints, animation, notes and the collections it is in; it gets the new mesh, the new properties
from the text, and its place: that of the text, plus what the user moved, turned and scaled it by.
"""

import dataclasses
import json

import addon_utils
import bpy
from mathutils import Matrix, Quaternion, Vector

from . import materials


@dataclasses.dataclass
class Report:
    """Counts of a reading: things added, kept and gone, and what of the user's was kept or lost."""

    added: int = 0
    kept: int = 0
    gone: int = 0
    moved: int = 0
    materials: int = 0
    lost: list = dataclasses.field(default_factory=list)

    def line(self):
        """One line for the panel."""
        parts = [f"{self.kept} kept", f"{self.added} new", f"{self.gone} gone"]
        if self.moved:
            parts.append(f"{self.moved} moved by you")
        if self.materials:
            parts.append(f"{self.materials} materials of yours")
        return ", ".join(parts)


def own_properties(thing):
    """The names of the custom properties of a thing: those from the text and those of the user."""
    return [key for key in thing.keys() if key not in thing.bl_rna.properties]


def import_file(path):
    """Reads a .glb through Blender's own importer and returns objects, materials and images that are new."""
    if not addon_utils.check("io_scene_gltf2")[1]:
        addon_utils.enable("io_scene_gltf2")
    before = [set(bpy.data.objects), set(bpy.data.materials), set(bpy.data.images), set(bpy.data.collections)]
    # Without this the list of the layer may still name objects that were removed.
    bpy.context.view_layer.update()
    chosen = [o for o in bpy.context.view_layer.objects if o.select_get()]
    active = bpy.context.view_layer.objects.active
    windows = bpy.context.window_manager.windows if not bpy.context.window else []
    with bpy.context.temp_override(**({"window": windows[0]} if windows else {})):
        bpy.ops.import_scene.gltf(filepath=str(path), import_pack_images=True, merge_vertices=False)
    fresh = [[x for x in now if x not in old] for now, old in zip(
        (bpy.data.objects, bpy.data.materials, bpy.data.images, bpy.data.collections), before)]
    for thing in fresh[0]:
        thing.select_set(False)
    for thing in chosen:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = active
    return fresh[:3]


def keys(objects):
    """A key for each object: its id, or the key of its parent with its name, counted where that is not alone."""
    found, counts = {}, {}
    names = {}

    def key(thing):
        if thing in found:
            return found[thing]
        base = thing.get("id")
        if base is None:
            above = key(thing.parent) if thing.parent else ""
            base = f"{above}/{materials.plain(thing.name)}"
        counts[base] = counts.get(base, 0) + 1
        found[thing] = base if counts[base] == 1 else f"{base}~{counts[base]}"
        return found[thing]

    for thing in objects:
        names[thing] = key(thing)
    return names


def place(matrix):
    """A transform as ten numbers: location, rotation, scale."""
    location, rotation, scale = matrix.decompose()
    return [*location, *rotation, *scale]


def placed(numbers):
    return Vector(numbers[:3]), Quaternion(numbers[3:7]), Vector(numbers[7:10])


def same(a, b):
    return all(abs(x - y) < 1e-4 for x, y in zip(a, b))


def remember(thing, uid, key):
    """Writes down what a thing is like in the text, so that changes of the user can be told from it."""
    own = thing.hsd
    own.uid, own.key, own.name = uid, key, thing.name
    own.parent = thing.parent.hsd.key if thing.parent else ""
    own.place = place(thing.matrix_basis)
    own.text_keys = json.dumps(own_properties(thing))
    slots = thing.material_slots
    own.slots = json.dumps([s.material.hsd.name if s.material else "" for s in slots])


def user_materials(thing):
    """The materials that the user has put on a thing, by the names of those that they took the place of."""
    found = {}
    for name, slot in zip(json.loads(thing.hsd.slots or "[]"), thing.material_slots):
        material = slot.material
        if material is None or material.hsd.uid != thing.hsd.uid or material.hsd.name != name:
            found[name] = material
    return found


def notes(thing):
    """The custom properties that the user has added."""
    text = set(json.loads(thing.hsd.text_keys or "[]"))
    return {key: thing[key] for key in own_properties(thing) if key not in text}


def moved_place(thing, new):
    """Where a thing stands now: as the text says, plus what the user has changed. And whether the user has moved it."""
    text, now = list(thing.hsd.place), place(thing.matrix_basis)
    if same(text, now):
        return Matrix.LocRotScale(*placed(new)), False
    (l0, r0, s0), (l1, r1, s1), (l2, r2, s2) = placed(text), placed(now), placed(new)
    scale = Vector(b * c / a if a else c for a, b, c in zip(s0, s1, s2))
    return Matrix.LocRotScale(l2 + (l1 - l0), (r1 @ r0.inverted()) @ r2, scale), True


def take_over(old, new):
    """Gives an object that is there the mesh, the properties and the place of the new one. True if the user moved it."""
    own = user_materials(old)
    if old.type == new.type and new.data is not None and old.data is not new.data:
        old.data = new.data
    for key in json.loads(old.hsd.text_keys or "[]"):
        if key in old:
            del old[key]
    for key in own_properties(new):
        old[key] = new[key]
    for slot, fresh in zip(old.material_slots, new.material_slots):
        name = fresh.material.hsd.name if fresh.material else ""
        if name in own:
            slot.link = "OBJECT"
            slot.material = own[name]
        else:
            slot.link = "DATA"
    # What the user has hung elsewhere stays there.
    if (old.parent.hsd.key if old.parent else "") != old.hsd.parent:
        return True
    text = place(new.matrix_basis)
    old.matrix_basis, moved = moved_place(old, text)
    old.hsd.place = text
    return moved


def record(old, new):
    """As `remember`, for an object that has taken over from a new one and may have been changed by the user."""
    old.hsd.text_keys = json.dumps(own_properties(new))
    old.hsd.slots = json.dumps([s.material.hsd.name if s.material else "" for s in new.material_slots])


def drop(gone, report):
    """Removes things that the text has no more. Things of the user that hang on them stay where they are."""
    for thing in gone:
        lost = notes(thing)
        if lost:
            told = ", ".join(f"{key} = {value}" for key, value in lost.items())
            report.lost.append(f"{thing.hsd.key}: {told}")
    held = set(gone)
    for child in [o for o in bpy.data.objects if o.parent in held and not o.hsd.uid]:
        matrix = child.matrix_world.copy()
        child.parent = None
        child.matrix_world = matrix
    report.gone += len(gone)
    # One by one each removal would look through the whole file.
    bpy.data.batch_remove(gone)


def link_to(thing, collection):
    for other in list(thing.users_collection):
        other.objects.unlink(thing)
    collection.objects.link(thing)


def load(collection, path):
    """Reads a model into a collection, for the first time or again, and reports what became of what was there."""
    uid, report = collection.hsd.uid, Report()
    fresh, stuff, images = import_file(path)
    materials.join_images(images, uid)
    report.materials = materials.join(stuff, uid)
    names = keys(fresh)
    there = {}
    for thing in [o for o in bpy.data.objects if o.hsd.uid == uid]:
        there.setdefault(thing.hsd.key, []).append(thing)
    heirs, spare = {}, []
    meshes = {o.data for olds in there.values() for o in olds if o.type == "MESH"}
    for new in fresh:
        olds = [o for o in there.pop(names[new], []) if o.type == new.type]
        for old in olds:
            report.moved += take_over(old, new)
            record(old, new)
            report.kept += 1
        if olds:
            heirs[new] = olds[0]
            spare.append(new)
    for new in fresh:
        if new in heirs:
            continue
        if new.parent in heirs:
            # A parent of the importer has no inverse of its own, so the local transform stays.
            matrix = new.matrix_basis.copy()
            new.parent = heirs[new.parent]
            new.matrix_parent_inverse.identity()
            new.matrix_basis = matrix
        link_to(new, collection)
        report.added += 1
    added = [new for new in fresh if new not in heirs]
    for new in sorted(added, key=depth):
        remember(new, uid, names[new])
    drop([o for olds in there.values() for o in olds], report)
    bpy.data.batch_remove(spare)
    bpy.data.batch_remove([m for m in meshes if not m.users])
    materials.sweep(uid)
    bpy.context.view_layer.update()
    return report


def depth(thing):
    """How many parents stand above a thing: those first, since things write down the key of their parent."""
    count = 0
    while thing.parent:
        thing, count = thing.parent, count + 1
    return count

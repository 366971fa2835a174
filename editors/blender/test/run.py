# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the add-on, in Blender's Python package or in Blender itself:

    HSD=/path/to/hsd python run.py
    HSD=/path/to/hsd blender --background --factory-startup --python run.py

With HSD_PICTURE the house of the test is rendered there by Cycles.
"""

import faulthandler
import logging
import os
import pathlib
import shutil
import sys
import tempfile
import time
import unittest

import bpy

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
EXAMPLES = ROOT / "examples"
# Under another name than `hsd`, so that no module of that name is taken for it.
WORK = pathlib.Path(tempfile.mkdtemp(prefix="hsd-blender-"))
shutil.copytree(HERE.parent / "hsd", WORK / "modules" / "hsd_addon", ignore=shutil.ignore_patterns("__pycache__"))
sys.path.insert(0, str(WORK / "modules"))

import addon_utils  # noqa: E402

faulthandler.enable()
logging.disable(logging.INFO)
addon_utils.enable("io_scene_gltf2")
import hsd_addon  # noqa: E402
from hsd_addon import model, operators, panels, program, source, town, words  # noqa: E402

PROGRAM = os.environ.get("HSD") or shutil.which("hsd") or ""


def enable():
    """Enables the add-on as the preferences would, with the program of the test."""
    addon = bpy.context.preferences.addons.new()
    addon.module = "hsd_addon"
    hsd_addon.register()
    bpy.context.preferences.addons["hsd_addon"].preferences.program = PROGRAM


def thing(key):
    return next(o for o in bpy.data.objects if o.hsd.key == key)


def breadth(collection):
    """How far a model reaches from west to east, metres."""
    all_x = [(o.matrix_world @ v.co).x for o in collection.all_objects if o.type == "MESH" for v in o.data.vertices]
    return max(all_x) - min(all_x)


def write_later(path, text):
    """Writes a text so that its time differs from that of the last one."""
    path.write_text(text, encoding="utf-8")
    now = time.time_ns() + 1_000_000_000
    os.utime(path, ns=(now, now))


def settle(collection, limit=60):
    """Lets the timer look until it has nothing to do any more."""
    until = time.monotonic() + limit
    quiet = 0
    while quiet < 3 and time.monotonic() < until:
        before = collection.hsd.stamp
        source.tick()
        quiet = quiet + 1 if not source._jobs and collection.hsd.stamp == before else 0
        time.sleep(0.05)


HOUSES = """<Houses>
  <House name="first" x="0" y="0">
    <Storey height="9.5"><Row>KKS  TKD 2MRE</Row><Row>KSK  MRE  KSK</Row><Row>KKS  TIT 2KKS</Row><Row>KSK  KSK  KSK</Row></Storey>
  </House>
  <House name="second" x="12" y="0">
    <Storey height="9.5"><Row>KKS  TKD 2MRE</Row><Row>KSK  MRE  KSK</Row><Row>KKS  TIT 2KKS</Row><Row>KSK  KSK  KSK</Row></Storey>
  </House>
</Houses>
"""


class Case(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        enable()
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=WORK))
        self.addCleanup(hsd_addon.unregister)

    def house(self, text=HOUSES, **settings):
        path = self.folder / "houses.hsd"
        path.write_text(text, encoding="utf-8")
        self.assertEqual(bpy.ops.import_scene.hsd(filepath=str(path), **settings), {"FINISHED"})
        return path, source.sources()[0]


class Import(Case):
    def test_parts_have_lines_and_names(self):
        _, collection = self.house()
        self.assertEqual([m.text for m in collection.hsd.messages], [])
        part = thing("first/s1/f1/91")
        self.assertEqual((part["code"], part["line"], part["kind"]), ("KKS  ", 3, "part"))
        self.assertEqual(part["ja"], "腰板・上漆喰")
        self.assertEqual(part.parent.parent.parent, thing("first"))
        self.assertAlmostEqual(thing("second").matrix_world.translation.x - thing("first").matrix_world.translation.x, 12, places=3)

    def test_the_timer_works_and_stays(self):
        path, collection = self.house()
        write_later(path, HOUSES.replace("KKS  TKD 2MRE", "KSK  TKD 2MRE", 1))
        until = time.monotonic() + 30
        while thing("first/s1/f1/91")["code"] != "KSK  " and time.monotonic() < until:
            self.assertEqual(source.timer(), 0.5)
            time.sleep(0.02)
        self.assertEqual(thing("first/s1/f1/91")["code"], "KSK  ")

    def test_every_example_comes_in(self):
        for name in ("machiya", "tea-shop", "years", "figure4"):
            bpy.ops.import_scene.hsd(filepath=str(EXAMPLES / f"{name}.hsd"), detail="1", watch=False)
        self.assertEqual(len(source.sources()), 4)
        for collection in source.sources():
            self.assertGreater(len(collection.objects), 20, collection.name)
            self.assertFalse([m.text for m in collection.hsd.messages])

    def test_a_missing_file_is_told(self):
        with self.assertRaisesRegex(RuntimeError, "cannot be read"):
            bpy.ops.import_scene.hsd(filepath=str(self.folder / "nothing.hsd"))

    def test_a_missing_program_is_told(self):
        bpy.context.preferences.addons["hsd_addon"].preferences.program = "/nowhere/hsd"
        _, collection = self.house()
        self.assertIn("/nowhere/hsd", collection.hsd.messages[0].text)


class Reload(Case):
    def test_what_the_user_did_stays(self):
        path, collection = self.house()
        second, part = thing("second"), thing("second/s1/f1/91")
        second.location.x += 5
        second["note"] = "seen on the map of 1887"
        part["note"] = "rotten"
        mine = bpy.data.materials.new("mine")
        wall = thing("first/s1/f1/91")
        wall.material_slots[0].link = "OBJECT"
        wall.material_slots[0].material = mine
        plaster = next(m for m in bpy.data.materials if m.hsd.name == "plaster")
        plaster.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.123
        for link in list(plaster.node_tree.links):
            if link.to_socket.name == "Roughness":
                plaster.node_tree.links.remove(link)
        bevel = part.modifiers.new("Bevel", "BEVEL")
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        collection.objects.link(camera)
        camera.parent = thing("second/s1/f3/91")
        materials, images = len(bpy.data.materials), len(bpy.data.images)

        # The second house moves by a metre and gets another window; the first one gets a storey less of nothing.
        write_later(path, HOUSES.replace('x="12"', 'x="13"').replace("KSK  MRE  KSK</Row><Row>KKS  TIT 2KKS", "KSK  KSK  KSK</Row><Row>KKS  TIT 2KKS"))
        settle(collection)

        self.assertEqual([m.text for m in collection.hsd.messages], [])
        self.assertIs(thing("second"), second)
        self.assertAlmostEqual(second.matrix_world.translation.x, 18 + thing("first").matrix_world.translation.x, places=3)
        self.assertEqual(second["note"], "seen on the map of 1887")
        self.assertEqual(thing("second/s1/f1/91")["note"], "rotten")
        self.assertEqual(part.modifiers[0], bevel)
        self.assertIs(thing("first/s1/f1/91").material_slots[0].material, mine)
        kept = [m for m in bpy.data.materials if m.hsd.name == "plaster"]
        self.assertEqual(len(kept), 1)
        self.assertAlmostEqual(kept[0].node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value, 0.123, places=4)
        self.assertEqual(thing("first/s1/f2/182")["code"], "KSK  ")
        self.assertEqual(camera.parent, thing("second/s1/f3/91"))
        # Nothing piles up.
        self.assertLessEqual(len(bpy.data.materials), materials)
        self.assertLessEqual(len(bpy.data.images), images)
        self.assertEqual(len({o.hsd.key for o in collection.all_objects if o.hsd.uid}), len([o for o in collection.all_objects if o.hsd.uid]))

    def test_copies_follow_too(self):
        path, collection = self.house()
        bpy.context.view_layer.objects.active = thing("first")
        for one in [thing("first"), *thing("first").children_recursive]:
            one.select_set(True)
        bpy.ops.object.duplicate(linked=True)
        copy = next(o for o in bpy.context.selected_objects if o.hsd.key == "first")
        copy.location.y -= 20
        write_later(path, HOUSES.replace("KKS  TKD 2MRE", "KSK  TKD 2MRE", 1))
        settle(collection)
        walls = [o for o in bpy.data.objects if o.hsd.key == "first/s1/f1/91"]
        self.assertEqual([w["code"] for w in walls], ["KSK  ", "KSK  "])
        self.assertEqual(sorted(round(o.location.y) for o in bpy.data.objects if o.hsd.key == "first"), [-20, 0])

    def test_many_reloads_pile_nothing_up(self):
        path, collection = self.house()
        bpy.ops.hsd.reload()
        count = [len(x) for x in (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.images, bpy.data.node_groups)]
        for _ in range(3):
            bpy.ops.hsd.reload()
        self.assertEqual(count, [len(x) for x in (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.images, bpy.data.node_groups)])

    def test_lost_notes_are_told(self):
        path, collection = self.house()
        thing("second")["note"] = "burnt down in 1864"
        tree = bpy.data.objects.new("tree", None)
        collection.objects.link(tree)
        tree.parent = thing("second")
        bpy.context.view_layer.update()
        x = tree.matrix_world.translation.x
        write_later(path, HOUSES[:HOUSES.index('  <House name="second"')] + "</Houses>\n")
        settle(collection)
        self.assertIn("burnt down in 1864", collection.hsd.messages[0].text)
        bpy.context.view_layer.update()
        self.assertAlmostEqual(tree.matrix_world.translation.x, x, places=3)
        self.assertFalse([o for o in bpy.data.objects if o.hsd.key.startswith("second")])

    def test_errors_have_line_reason_and_fix_and_change_nothing(self):
        path, collection = self.house()
        before = [o.name for o in collection.all_objects]
        write_later(path, HOUSES.replace("KKS  TKD 2MRE", "KKX  TKD 2MRE", 1))
        settle(collection)
        error = next(m for m in collection.hsd.messages if m.severity == "error")
        self.assertEqual((error.line, error.code, pathlib.Path(error.file)), (3, "HSD0301", path))
        self.assertIn("KKX", error.text)
        self.assertIn("KKS", error.fix)
        self.assertEqual(before, [o.name for o in collection.all_objects])
        bpy.ops.hsd.open(file=error.file, line=error.line, column=error.column)
        text = bpy.data.texts[path.name]
        self.assertEqual((text.current_line_index + 1, text.current_character + 1), (error.line, error.column))
        write_later(path, HOUSES)
        settle(collection)
        self.assertEqual(len(collection.hsd.messages), 0)

    def test_included_files_are_watched(self):
        shutil.copytree(EXAMPLES / "tea-shop", self.folder / "tea-shop")
        shutil.copytree(EXAMPLES / "textures", self.folder / "textures")
        shutil.copy(EXAMPLES / "tea-shop.hsd", self.folder)
        bpy.ops.import_scene.hsd(filepath=str(self.folder / "tea-shop.hsd"))
        collection = source.sources()[0]
        self.assertFalse([m.text for m in collection.hsd.messages])
        settle(collection)
        part = self.folder / "tea-shop" / "parts.hsd"
        write_later(part, part.read_text(encoding="utf-8") + "<broken")
        settle(collection)
        self.assertEqual(pathlib.Path(collection.hsd.messages[0].file), part)

    def test_the_file_keeps_what_was_done(self):
        path, collection = self.house()
        thing("second").location.x += 5
        blend = self.folder / "scene.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(blend))
        bpy.ops.wm.open_mainfile(filepath=str(blend))
        bpy.context.preferences.addons["hsd_addon"].preferences.program = PROGRAM
        collection = source.sources()[0]
        write_later(path, HOUSES.replace('x="12"', 'x="13"'))
        settle(collection)
        self.assertAlmostEqual(thing("second").matrix_world.translation.x - thing("first").matrix_world.translation.x, 18, places=3)


class Settings(Case):
    def test_parameters_are_sliders(self):
        bpy.ops.import_scene.hsd(filepath=str(ROOT / "library" / "chu-nikai.hsd"))
        collection = source.sources()[0]
        kinds = {p.name: p.kind for p in collection.hsd.parameters}
        self.assertEqual((kinds["frontage"], kinds["front"], kinds["udatsu"]), ("number", "choice", "switch"))
        look = collection.id_properties_ui("hsd frontage").as_dict()
        self.assertAlmostEqual(look["min"], 2.7, places=5)
        self.assertIn("street", look["description"])
        settle(collection)
        self.assertFalse([p.name for p in collection.hsd.parameters if p.given])
        width = breadth(collection)
        collection["hsd frontage"] = 10.0
        settle(collection)
        self.assertEqual([p.name for p in collection.hsd.parameters if p.given], ["frontage"])
        self.assertAlmostEqual(breadth(collection), width + 4.1, delta=0.3)
        collection["hsd front"] = 4
        settle(collection)
        self.assertEqual(source.options(collection).parameters, {"frontage": 10.0, "front": "sake"})
        bpy.ops.hsd.reset_parameters()
        self.assertEqual(source.options(collection).parameters, {})
        self.assertAlmostEqual(collection["hsd frontage"], 5.9, places=5)

    def test_detail_and_storeys(self):
        _, collection = self.house()
        settle(collection)
        full = sum(len(o.data.polygons) for o in collection.all_objects if o.type == "MESH")
        thing("second").location.x += 5
        collection.hsd.detail = "0"
        settle(collection)
        less = sum(len(o.data.polygons) for o in collection.all_objects if o.type == "MESH")
        self.assertLess(less, full / 4)
        collection.hsd.detail = "3"
        settle(collection)
        self.assertAlmostEqual(thing("second").matrix_world.translation.x - thing("first").matrix_world.translation.x, 17, places=3)
        self.assertIn("kind", thing("second/s1/f1/91"))
        collection.hsd.cutaway = True
        settle(collection)
        self.assertFalse([o for o in collection.all_objects if o.get("kind") == "roof"])
        collection.hsd.storey = 1
        settle(collection)
        self.assertFalse([m.text for m in collection.hsd.messages])
        self.assertIn("kept", collection.hsd.status)


class Jump(Case):
    def test_from_a_part_to_its_line_and_back(self):
        path, collection = self.house()
        part = thing("second/s1/f1/91")
        bpy.context.view_layer.objects.active = part
        self.assertEqual(bpy.ops.hsd.jump(), {"FINISHED"})
        self.assertEqual(bpy.data.texts[path.name].current_line_index + 1, part["line"])
        self.assertGreater(operators.select(bpy.context, path, part["line"]), 5)

    def test_a_part_of_a_library_type_leads_to_the_house(self):
        path, collection = self.house('<Houses>\n  <Place type="so-nikai" name="shop" x="0" y="0"/>\n</Houses>\n')
        part = next(o for o in collection.all_objects if o.get("kind") == "part")
        self.assertEqual(source.where(collection, part)[:2], (path, 2))

    def test_an_editor_of_the_user(self):
        path, collection = self.house()
        told = self.folder / "told"
        bpy.context.preferences.addons["hsd_addon"].preferences.editor = f"{sys.executable} -c 'import sys; open(sys.argv[1], \"w\").write(sys.argv[2])' {told} {{file}}:{{line}}" \
            if "python" in pathlib.Path(sys.executable).name else f"touch {told}"
        bpy.context.view_layer.objects.active = thing("first/s1/f1/91")
        bpy.ops.hsd.jump()
        until = time.monotonic() + 10
        while not told.exists() and time.monotonic() < until:
            time.sleep(0.05)
        self.assertTrue(told.exists())


class Town(Case):
    def setUp(self):
        super().setUp()
        for one in (EXAMPLES / "towns").iterdir():
            shutil.copy(one, self.folder)

    def test_tiles_are_linked_collections(self):
        bpy.ops.import_scene.hsd(filepath=str(self.folder / "street.hsd"), detail="0")
        collection = source.sources()[0]
        self.assertFalse([m.text for m in collection.hsd.messages if m.severity == "error"])
        empties = [o for o in collection.objects if o.instance_collection]
        self.assertGreater(len(empties), 1)
        for empty in empties:
            self.assertIsNotNone(empty.instance_collection.library)
            self.assertGreater(len(empty.instance_collection.all_objects), 0)
        self.assertEqual(bpy.ops.hsd.decisions(), {"FINISHED"})
        times = {p: p.stat().st_mtime_ns for p in (self.folder / "street.tiles" / "blender").glob("*.blend")}
        self.assertEqual(len(times), len(empties))
        empties[0].location.z += 3
        bpy.ops.hsd.reload()
        self.assertEqual(times, {p: p.stat().st_mtime_ns for p in times if p.exists()})
        self.assertAlmostEqual(empties[0].location.z, 3)
        collection["hsd year"] = 1890.0
        settle(collection)
        blends = {e.instance_collection.library.filepath for e in empties}
        self.assertTrue(all(pathlib.Path(bpy.path.abspath(b)).is_file() for b in blends))
        self.assertEqual(len(list((self.folder / "street.tiles" / "blender").glob("*.blend"))), len(empties))
        self.assertEqual({lib.filepath for lib in bpy.data.libraries}, blends)
        self.assertNotEqual({pathlib.Path(b).name for b in blends}, {p.name for p in times})
        images = {i.filepath for e in empties for o in e.instance_collection.all_objects for s in o.material_slots
                  for n in s.material.node_tree.nodes if getattr(n, "image", None) for i in [n.image]}
        self.assertTrue(images)
        for image in images:
            self.assertIn("textures", image)

    def test_or_objects(self):
        bpy.ops.import_scene.hsd(filepath=str(self.folder / "block.hsd"), detail="0", as_tiles=False)
        houses = [o for o in source.sources()[0].all_objects if o.get("kind") == "house"]
        self.assertEqual(len(houses), 16)


class Layout:
    """Stands for a layout of Blender, which has none without a window, and is as strict as that about names."""

    ICONS = {i.identifier for i in bpy.types.UILayout.bl_rna.functions["prop"].parameters["icon"].enum_items}

    def __init__(self, drawn):
        self.drawn = drawn

    def _sub(self, **_):
        return Layout(self.drawn)

    row = column = box = _sub

    def check(self, name, words):
        known = bpy.types.UILayout.bl_rna.functions[name].parameters.keys() + ["text", "translate", "icon", "text_ctxt"]
        for word in words:
            assert word in known, (name, word)
        assert words.get("icon", "NONE") in self.ICONS, words

    def label(self, **words):
        self.check("label", words)
        self.drawn.append(words["text"])

    def prop(self, data, name, **words):
        self.check("prop", words)
        data.path_resolve(name)
        self.drawn.append(words.get("text") or name)

    def operator(self, name, **words):
        self.check("operator", words)
        group, short = name.split(".")
        getattr(getattr(bpy.ops, group), short).get_rna_type()
        self.drawn.append(words.get("text") or name)
        return type("Properties", (), {})()


class Panels(Case):
    def draw(self, one):
        drawn = []
        one.draw(type("Fake", (), {"layout": Layout(drawn)})(), bpy.context)
        return " / ".join(drawn)

    def test_panels_draw(self):
        self.assertIn("Select a house", self.draw(panels.HSD_PT_source))
        path, collection = self.house(HOUSES.replace("KKS  TKD 2MRE", "KKX  TKD 2MRE", 1))
        said = self.draw(panels.HSD_PT_messages)
        for word in ("HSD0301", "3:", "KKX", "did you mean"):
            self.assertIn(word, said)
        write_later(path, '<Houses><Param name="width" default="4" min="3" max="6"/>' + HOUSES[len("<Houses>"):])
        settle(collection)
        bpy.context.view_layer.objects.active = thing("first/s1/f1/91")
        self.assertIn("watch", self.draw(panels.HSD_PT_source))
        self.assertIn("width", self.draw(panels.HSD_PT_parameters))
        said = self.draw(panels.HSD_PT_thing)
        self.assertIn("腰板・上漆喰", said)
        self.assertIn("houses.hsd:3", said)


class Words(unittest.TestCase):
    def test_panels_have_words_in_japanese(self):
        said = {word for _, word in words.TRANSLATIONS["ja_JP"]}
        for one in (*panels.CLASSES, *operators.CLASSES):
            self.assertIn(one.bl_label, said)

    def test_helpers(self):
        self.assertEqual(town.key_of("tiles/0_-1-616c3e53aac49bcb-3.glb"), "0_-1")
        self.assertEqual(program.spell(2.50), "2.5")
        self.assertEqual("".join(panels.wrapped("一階の階高" * 20, 20)), "一階の階高" * 20)
        self.assertTrue(model.same([0, 1], [0, 1.00001]))


def picture(path):
    """Renders the machiya as it comes from the text."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    enable()
    bpy.ops.import_scene.hsd(filepath=str(EXAMPLES / "machiya.hsd"))
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    for one in (camera, sun):
        scene.collection.objects.link(one)
    bpy.context.view_layer.update()
    corners = [o.matrix_world @ v.co for o in source.sources()[0].all_objects if o.type == "MESH" for v in o.data.vertices]
    middle = sum(corners, start=corners[0] * 0) / len(corners)
    camera.location = middle + type(middle)((-9, -18, 3))
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    sun.rotation_euler, sun.data.energy = (0.7, 0.2, -0.6), 4
    scene.world = bpy.data.worlds.new("sky")
    scene.world.color = (0.6, 0.7, 0.9)
    scene.camera, scene.render.engine = camera, "CYCLES"
    scene.cycles.samples, scene.cycles.device = 16, "CPU"
    scene.render.resolution_x, scene.render.resolution_y = 720, 480
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    if not PROGRAM:
        sys.exit("no hsd: set HSD to the program")
    # Those of this file, not those of Blender; Blender's own arguments end with two dashes.
    suite = unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"])
    well = unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful()
    if well and os.environ.get("HSD_PICTURE"):
        picture(pathlib.Path(os.environ["HSD_PICTURE"]).resolve())
    shutil.rmtree(WORK, ignore_errors=True)
    print(f"Blender {bpy.app.version_string}")
    sys.stdout.flush()
    # Some versions of the package fail when Python takes them down.
    os._exit(0 if well else 1)

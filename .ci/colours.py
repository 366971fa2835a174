"""How far the colours of OBJ files and of lower details are from those of the GLB of detail 3, in pictures of Cycles, the path tracer of
Blender.

    python .ci/colours.py HSD [EXAMPLE...]

Needs the packages bpy and numpy. Each example is seen as a whole from the front, the back and above under an even white sky; what is
compared is the mean colour of its surfaces, linear, over the pixels that it covers in both pictures, but for those where one looks through
glass: what is seen there is the light in the rooms behind, and far away glass is opaque. Writes a row for each example with the largest
difference of the three channels and the three views, per cent of the colour of detail 3, and fails if one is more than 3.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

import bpy
import numpy
from mathutils import Vector

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = ["machiya", "kura", "office", "pagoda", "shrine", "street", "suzakumon", "temple-hall", "tea-shop", "years"]
FILES = {"3": ("glb", 3), "OBJ": ("obj", 3), "2": ("glb", 2), "1": ("glb", 1), "0": ("glb", 0)}
VIEWS = [(0.6, -1, 0.35), (-0.6, 1, 0.35), (0.2, -0.4, 1)]
MOST = 3.0


def taken_in(model):
    """Blender's scene with nothing but a model."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if model.suffix == ".obj":
        bpy.ops.wm.obj_import(filepath=str(model))
    else:
        bpy.ops.import_scene.gltf(filepath=str(model))
    return bpy.context.scene


def extent():
    """The middle of what is in the scene, and the radius of a ball around it."""
    meshes = [o for o in bpy.context.scene.objects if o.type == "MESH"]
    corners = [o.matrix_world @ Vector(c) for o in meshes for c in o.bound_box]
    least, most = (Vector(pick(c[i] for c in corners) for i in range(3)) for pick in (min, max))
    return (least + most) / 2, (most - least).length / 2


def seen(scene, folder, middle, radius):
    """For each view the colours of the surfaces, and where they are."""
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 16
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.transparent_max_bounces = 8
    scene.render.film_transparent = True
    scene.render.resolution_x = scene.render.resolution_y = 400
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.view_settings.view_transform = "Raw"
    scene.world = bpy.data.worlds.new("sky")
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = radius * 1.6
    camera.data.clip_end = radius * 8
    scene.collection.objects.link(camera)
    scene.camera = camera
    for material in bpy.data.materials:
        shine(material)
    pictures = []
    for view in VIEWS:
        back = Vector(view).normalized()
        camera.location = middle + back * radius * 3
        camera.rotation_euler = (-back).to_track_quat("-Z", "Y").to_euler()
        scene.render.filepath = os.path.join(folder, "seen.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        image.colorspace_settings.name = "Non-Color"
        pixels = numpy.array(image.pixels[:], dtype=float).reshape(-1, 4)
        bpy.data.images.remove(image)
        pictures.append(pixels)
    return pictures


def shine(material):
    """Lets a material shine in its own colour, so that no light and shade is compared."""
    material.use_nodes = True
    tree = material.node_tree
    shader = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
    if shader is None:
        return
    colour, glow = shader.inputs["Base Color"], shader.inputs["Emission Color"]
    if colour.is_linked:
        tree.links.new(colour.links[0].from_socket, glow)
    else:
        glow.default_value = colour.default_value
    shader.inputs["Emission Strength"].default_value = 1.0
    for name in ("Base Color", "Metallic"):
        for link in list(shader.inputs[name].links):
            tree.links.remove(link)
    shader.inputs["Base Color"].default_value = (0, 0, 0, 1)
    shader.inputs["Metallic"].default_value = 0.0
    shader.inputs["Specular IOR Level"].default_value = 0.0
    if material.surface_render_method == "BLENDED" or shader.inputs["Alpha"].default_value < 1:
        surface = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL").inputs["Surface"]
        tree.links.new(tree.nodes.new("ShaderNodeHoldout").outputs[0], surface)


def difference(reference, other):
    """The largest difference of mean colours, per cent, of channels and views."""
    most = 0.0
    for one, two in zip(reference, other):
        both = (one[:, 3] > 0.99) & (two[:, 3] > 0.99)
        mean, found = one[both, :3].mean(axis=0), two[both, :3].mean(axis=0)
        most = max(most, float(numpy.abs(found / mean - 1).max() * 100))
    return most


def compared(hsd, example, folder):
    """The difference of each file from the GLB of detail 3, per cent."""
    pictures, place = {}, None
    for name, (suffix, detail) in FILES.items():
        model = pathlib.Path(folder, f"{example}-{detail}.{suffix}")
        source = ROOT / "examples" / f"{example}.hsd"
        subprocess.run([hsd, "build", source, "-o", model, "--detail", str(detail)], check=True, capture_output=True)
        scene = taken_in(model)
        place = place or extent()
        pictures[name] = seen(scene, folder, *place)
    reference = pictures.pop("3")
    return {name: difference(reference, found) for name, found in pictures.items()}


def main():
    hsd, *examples = sys.argv[1:]
    hsd = os.path.abspath(hsd)
    worst = 0.0
    print("| example | OBJ | detail 2 | detail 1 | detail 0 |\n|---|---|---|---|---|", flush=True)
    for example in examples or EXAMPLES:
        with tempfile.TemporaryDirectory() as folder:
            found = compared(hsd, example, folder)
        worst = max(worst, *found.values())
        print(f"| `{example}` | " + " | ".join(f"{share:.1f}" for share in found.values()) + " |", flush=True)
    if round(worst, 1) > MOST:
        raise SystemExit(f"{worst:.1f} % is more than {MOST:.0f}")


main()

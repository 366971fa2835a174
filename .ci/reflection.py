"""How much of the light glass reflects in Cycles, the path tracer of Blender, against the share that its house asks for.

    python .ci/reflection.py HSD

Needs the package bpy. A front of glass is built with five shares and seen at right angles under an even sky of 1; what the sky
adds through glossy rays alone is the share that is reflected. Writes a row for each share, and fails if one is more than 3 % off
the share of the pane (its opacity times the share asked for).
"""
import json
import os
import struct
import subprocess
import sys
import tempfile

import bpy

HOUSE = """<Structure size="20"><Texture texturecode="NGC" reflection="{share}"/><Facades>
<Facade ratio="1" reflection="enable"><Floor id="1" height="20"><Part code="NGC"/></Floor></Facade>
<Facade ratio="1" angle="90"><Floor id="1" height="20"><Part code="NGC"/></Floor></Facade>
<Facade ratio="1" angle="90"><Floor id="1" height="20"><Part code="NGC"/></Floor></Facade>
<Facade ratio="1" angle="90"><Floor id="1" height="20"><Part code="NGC"/></Floor></Facade></Facades></Structure>
"""
# In the pane beside the middle of the front, metres.
EYE = (-0.62, -6, 3.1)


def opacity(model):
    """The opacity of the reflecting glass in a model."""
    with open(model, "rb") as file:
        data = file.read()
    length = struct.unpack("<I", data[12:16])[0]
    for material in json.loads(data[20 : 20 + length])["materials"]:
        if material.get("extras", {}).get("reflection", 0) > 0:
            return material["pbrMetallicRoughness"]["baseColorFactor"][3]
    return 1.0


def light(scene, folder):
    """The mean green of the picture, linear."""
    scene.render.filepath = os.path.join(folder, "seen.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    image.colorspace_settings.name = "Non-Color"
    greens = list(image.pixels)[1::4]
    bpy.data.images.remove(image)
    return sum(greens) / len(greens)


def reflected(model, folder):
    """The share of the sky that a front reflects at right angles."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=model)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 64
    scene.cycles.use_denoising = False
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.world = world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (1, 1, 1, 1)
    camera = bpy.data.cameras.new("eye")
    camera.type, camera.ortho_scale = "ORTHO", 0.05
    eye = bpy.data.objects.new("eye", camera)
    eye.location, eye.rotation_euler = EYE, (1.5707963, 0, 0)
    scene.collection.objects.link(eye)
    scene.camera = eye
    found = []
    for seen in (True, False):
        world.cycles_visibility.glossy = seen
        found.append(light(scene, folder))
    return found[0] - found[1]


def main():
    off = []
    with tempfile.TemporaryDirectory() as folder:
        for share in (0, 0.25, 0.5, 0.75, 1):
            text, model = (os.path.join(folder, name) for name in ("house.hsd", "house.glb"))
            with open(text, "w") as file:
                file.write(HOUSE.format(share=share))
            subprocess.run([sys.argv[1], "build", text, "-o", model, "-q"], check=True)
            pane, got = opacity(model), reflected(model, folder)
            print(f"| {share:.2f} | {share * pane:.3f} | {got:.3f} |", flush=True)
            if abs(got - share * pane) > 0.03 * max(share, 0.1):
                off.append(share)
    sys.exit(f"off: {off}" if off else 0)


if __name__ == "__main__":
    main()

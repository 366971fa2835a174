# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials and images: those that the user has changed are kept when a model is read again, others follow the text."""

import hashlib
import re

import bpy


def plain(name):
    """A name without the number that Blender adds to equal names."""
    return re.sub(r"\.\d{3,}$", "", name)


def image_hash(image):
    """A hash of the content of a packed image, or its path."""
    if image.packed_file:
        return hashlib.sha1(image.packed_file.data).hexdigest()
    return image.filepath


def value_of(socket):
    """The value of a socket, as text that does not change by rounding."""
    value = getattr(socket, "default_value", None)
    if value is None or isinstance(value, (str, bool, int)):
        return str(value)
    if isinstance(value, float):
        return f"{value:.5g}"
    try:
        return " ".join(f"{x:.5g}" for x in value)
    except TypeError:
        return type(value).__name__


def fingerprint(material):
    """What a material looks like: its nodes with their values, images and links."""
    lines = [str(getattr(material, "use_backface_culling", "")), " ".join(f"{x:.5g}" for x in material.diffuse_color)]
    tree = material.node_tree
    for node in sorted(tree.nodes, key=lambda n: n.name) if tree else []:
        image = getattr(node, "image", None)
        values = [f"{s.identifier}={value_of(s)}" for s in node.inputs]
        if node.bl_idname in {"ShaderNodeRGB", "ShaderNodeValue"}:
            values.append(value_of(node.outputs[0]))
        extra = [str(getattr(node, key, "")) for key in ("operation", "blend_type", "interpolation", "extension")]
        lines.append("|".join([node.name, node.bl_idname, image_hash(image) if image else "", *values, *extra]))
    for link in tree.links if tree else []:
        lines.append(f"{link.from_node.name}.{link.from_socket.identifier}>{link.to_node.name}.{link.to_socket.identifier}")
    return hashlib.sha1("\n".join(sorted(lines)).encode()).hexdigest()


def join_images(fresh, uid):
    """Lets equal images be one: each new image whose content is there already gives way to the old one."""
    known = {image.hsd.content: image for image in bpy.data.images if image.hsd.uid == uid}
    spare = []
    for image in fresh:
        content = image_hash(image)
        old = known.get(content)
        if old:
            image.user_remap(old)
            spare.append(image)
        else:
            image.hsd.content, image.hsd.uid = content, uid
            known[content] = image
    bpy.data.batch_remove(spare)


def join(fresh, uid):
    """Joins the materials of a model that was read with those that are there. Returns how many of the user were kept."""
    old = {m.hsd.name: m for m in bpy.data.materials if m.hsd.uid == uid}
    kept, spare = 0, []
    for material in fresh:
        name, look = plain(material.name), fingerprint(material)
        there = old.get(name)
        changed = there is not None and fingerprint(there) != there.hsd.look
        if changed or (there is not None and there.hsd.look == look):
            material.user_remap(there)
            spare.append(material)
            kept += changed
            continue
        if there is not None:
            there.user_remap(material)
            label = there.name
            bpy.data.materials.remove(there)
            material.name = label
        material.hsd.name, material.hsd.look, material.hsd.uid = name, look, uid
    bpy.data.batch_remove(spare)
    return kept


def sweep(uid):
    """Removes what nothing uses any more of the materials and images that came from this source, unless changed by the user."""
    for material in [m for m in bpy.data.materials if m.hsd.uid == uid and not m.users]:
        if fingerprint(material) == material.hsd.look:
            bpy.data.materials.remove(material)
    for image in [i for i in bpy.data.images if i.hsd.uid == uid and not i.users]:
        bpy.data.images.remove(image)

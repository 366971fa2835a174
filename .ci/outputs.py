"""What an independent reader finds in the models of all examples: the tables of grammar/outputs.md and outputs.ja.md.

    python .ci/outputs.py HSD PAGE...

Needs the packages trimesh and pillow. Builds each example at each detail as .glb and .stl, reads both with trimesh, and writes the
rows of the tables anew into each page: the first table with "detail" in its head, or 詳細度, and the one with "merged", or まとめた後.
A draw is a primitive of a node; an edge is open if an odd number of triangles meet in it, corners nearer than 0.01 mm being one.
"""
import io
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

import numpy
import trimesh
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parent.parent
MERGED = ["machiya", "office", "pagoda", "street", "years"]


def build(hsd, example, out, *options):
    source = ROOT / "examples" / f"{example}.hsd"
    done = subprocess.run([hsd, "build", source, "-o", out, *options], capture_output=True, text=True)
    if done.returncode > 1:
        raise SystemExit(done.stderr)
    return out


def textures(model):
    """Megabytes of its pictures on a graphics card: four bytes a pixel, a third more for smaller copies."""
    data = model.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    described, binary = json.loads(data[20 : 20 + length]), data[28 + length :]
    pixels = 0
    for image in described.get("images", []):
        view = described["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        size = Image.open(io.BytesIO(binary[start : start + view["byteLength"]])).size
        pixels += size[0] * size[1]
    return pixels * 4 * 4 / 3 / 1e6


def drawn(model):
    """Draws and triangles."""
    scene = trimesh.load(model, process=False, force="scene")
    names = [scene.graph[node][1] for node in scene.graph.nodes_geometry]
    return len(names), sum(len(scene.geometry[name].faces) for name in names)


def printed(model):
    """Triangles and open edges."""
    mesh = trimesh.load(model, process=False)
    corners = numpy.round(mesh.vertices * 100).astype(numpy.int64)
    _, numbers = numpy.unique(corners, axis=0, return_inverse=True)
    faces = numbers.reshape(-1)[mesh.faces]
    edges = numpy.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges = edges[edges[:, 0] != edges[:, 1]]
    _, uses = numpy.unique(edges, axis=0, return_counts=True)
    return len(mesh.faces), int((uses % 2).sum())


def rows(hsd, folder):
    details, merged = [], []
    for source in sorted((ROOT / "examples").glob("*.hsd")):
        name = source.stem
        for detail in range(4):
            model = build(hsd, name, folder / "a.glb", "--detail", str(detail))
            solid = build(hsd, name, folder / "a.stl", "--detail", str(detail))
            draws, triangles = drawn(model)
            shown = model.stat().st_size / 1000
            faces, opened = printed(solid)
            cells = [draws, triangles, shown, textures(model), faces, opened]
            row = " | ".join(f"{round(cell):,}" for cell in cells)
            details.append(f"| {name if detail == 0 else ''} | {detail} | {row} |")
            print(details[-1], flush=True)
        if name in MERGED:
            one = build(hsd, name, folder / "b.glb", "--merge", "material")
            cells = [draws, drawn(one)[0], shown, one.stat().st_size / 1000]
            merged.append(f"| {name} | " + " | ".join(f"{round(c):,}" for c in cells) + " |")
            print(merged[-1], flush=True)
    return {"detail": details, "詳細度": details, "merged": merged, "まとめた後": merged}


def put(page, tables):
    """Puts the rows into the first table of each kind, from its third line to the next that is no row."""
    lines, out, done = page.read_text().splitlines(), [], set()
    number = 0
    while number < len(lines):
        line = lines[number]
        cells = [cell.strip() for cell in line.split("|")] if line.startswith("|") else []
        kinds = [kind for kind in tables if kind in cells]
        out.append(line)
        number += 1
        if kinds and kinds[0] not in done:
            done.add(kinds[0])
            out.append(lines[number])
            out.extend(tables[kinds[0]])
            number += 1
            while number < len(lines) and lines[number].startswith("|"):
                number += 1
    page.write_text("\n".join(out) + "\n")


def main():
    hsd, *pages = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        tables = rows(str(pathlib.Path(hsd).resolve()), pathlib.Path(folder))
    for page in pages:
        put(pathlib.Path(page), tables)


if __name__ == "__main__":
    main()

"""The bodies of .stl files that `hsd build` wrote, one by one and united.

    python .ci/united.py FILE.stl...

Needs the packages numpy and manifold3d. Writes for each file how many bodies it has, their volume in all, the volume of their
union, and of how many pieces that is; fails if a body is no manifold.
"""
import sys

import manifold3d
import numpy

RECORD = numpy.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])


def bodies(path):
    """The bodies of a file: triangles follow one another until every edge has been used once in either direction."""
    with open(path, "rb") as file:
        corners = numpy.frombuffer(file.read()[84:], dtype=RECORD)["corners"]
    points, numbers = numpy.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    faces = numbers.reshape(-1, 3)
    unpaired, first = {}, 0
    for number, (a, b, c) in enumerate(faces.tolist()):
        for edge in ((a, b), (b, c), (c, a)):
            back = edge[::-1]
            if unpaired.get(back):
                unpaired[back] -= 1
                if not unpaired[back]:
                    del unpaired[back]
            else:
                unpaired[edge] = unpaired.get(edge, 0) + 1
        if not unpaired:
            used, own = numpy.unique(faces[first : number + 1], return_inverse=True)
            yield manifold3d.Mesh(points[used], own.reshape(-1, 3).astype(numpy.uint32))
            first = number + 1
    if unpaired:
        raise SystemExit(f"{path}: {len(unpaired)} edges lack a neighbour")


def main():
    for path in sys.argv[1:]:
        solids = [manifold3d.Manifold(mesh) for mesh in bodies(path)]
        if any(solid.status() != manifold3d.Error.NoError for solid in solids):
            raise SystemExit(f"{path}: a body is no manifold")
        whole = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)
        volumes = [sum(s.volume() for s in solids) / 1000, whole.volume() / 1000]
        told = ", united ".join(f"{volume:.2f} cm3" for volume in volumes)
        print(f"{path}: {len(solids)} bodies of {told}, {len(whole.decompose())} pieces")


if __name__ == "__main__":
    main()

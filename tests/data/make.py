#!/usr/bin/env python3
"""Writes the files of this folder: python3 tests/data/make.py. Standard library only; the same bytes every time."""

import json
import math
import struct
from pathlib import Path

HERE = Path(__file__).parent
# Where the hamlet's origin lies in EPSG:6674: metres east and north.
EAST, NORTH = -22800.0, -108300.0

# Key, name, storeys, use, outline counter-clockwise and courts in metres east and north of the origin.
HOUSES = [
    ("a", "角屋", 2, "shop", [(0, 0), (5.4, 0), (5.4, 10.8), (0, 10.8)], []),
    ("b", "米屋", 2, "shop", [(5.4, 0), (11.7, 0), (11.7, 9), (5.4, 9)], []),
    ("c", "鍵屋", 1, "house", [(14, 0), (21.2, 0), (21.2, 5.4), (17.6, 5.4), (17.6, 12.6), (14, 12.6)], []),
    ("d", "中庭の家", 1, "house", [(0, 20), (16, 20), (16, 36), (0, 36)], [[(5, 25), (11, 25), (11, 30), (5, 30)]]),
    ("e", "曲り角", 1, "house", [(24, 0.5), (31, 2.5), (29.5, 11), (23, 9)], []),
]
STREET = [(-10, -3), (12, -3), (24, -2.5), (40, 1.5)]
STREET_WIDTH = 6
TREE = (19, 9)
STOREY = 2.9


def degrees(east, north):
    """Longitude and latitude of a point of EPSG:6674, by the series of Krueger to the third order (within a millimetre)."""
    a, f, scale = 6378137.0, 1 / 298.257222101, 0.9999
    lat0, lon0 = math.radians(36), math.radians(136)
    n = f / (2 - f)
    radius = a / (1 + n) * (1 + n**2 / 4 + n**4 / 64)
    alpha = [n / 2 - 2 / 3 * n**2 + 5 / 16 * n**3, 13 / 48 * n**2 - 3 / 5 * n**3, 61 / 240 * n**3]
    beta = [n / 2 - 2 / 3 * n**2 + 37 / 96 * n**3, n**2 / 48 + n**3 / 15, 17 / 480 * n**3]
    delta = [2 * n - 2 / 3 * n**2 - 2 * n**3, 7 / 3 * n**2 - 8 / 5 * n**3, 56 / 15 * n**3]
    e = 2 * math.sqrt(n) / (1 + n)
    chi0 = math.asin(math.tanh(math.atanh(math.sin(lat0)) - e * math.atanh(e * math.sin(lat0))))
    origin = radius * (chi0 + sum(c * math.sin(2 * (j + 1) * chi0) for j, c in enumerate(alpha)))
    xi = (north / scale + origin) / radius
    eta = east / scale / radius
    xi1 = xi - sum(b * math.sin(2 * (j + 1) * xi) * math.cosh(2 * (j + 1) * eta) for j, b in enumerate(beta))
    eta1 = eta - sum(b * math.cos(2 * (j + 1) * xi) * math.sinh(2 * (j + 1) * eta) for j, b in enumerate(beta))
    chi = math.asin(math.sin(xi1) / math.cosh(eta1))
    lat = chi + sum(d * math.sin(2 * (j + 1) * chi) for j, d in enumerate(delta))
    lon = lon0 + math.atan2(math.sinh(eta1), math.cos(xi1))
    return round(math.degrees(lon), 8), round(math.degrees(lat), 8)


def lonlat(point):
    return degrees(EAST + point[0], NORTH + point[1])


def closed(ring):
    return [*ring, ring[0]]


def write(name, text):
    (HERE / name).write_bytes(text if isinstance(text, bytes) else text.encode())


def collection(features):
    lines = ",\n".join(json.dumps(f, ensure_ascii=False, separators=(",", ":")) for f in features)
    return f'{{"type":"FeatureCollection","features":[\n{lines}\n]}}\n'


def feature(properties, kind, coordinates):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}


def geojson():
    def polygon(outline, courts):
        return [[lonlat(p) for p in closed(outline)]] + [[lonlat(p) for p in closed(c[::-1])] for c in courts]

    houses = [
        feature({"id": key, "name": name, "levels": levels, "use": use}, "Polygon", polygon(outline, courts))
        for key, name, levels, use, outline, courts in HOUSES
    ]
    write("houses.geojson", collection(houses))
    street = feature({"name": "本通", "width": STREET_WIDTH}, "LineString", [lonlat(p) for p in STREET])
    tree = feature({"species": "松"}, "Point", lonlat(TREE))
    write("street.geojson", collection([street, tree]))


def shapefile():
    records = []
    for _, _, _, _, outline, courts in HOUSES:
        # Outlines clockwise, holes counter-clockwise.
        rings = [closed(outline[::-1])] + [closed(c) for c in courts]
        points = [(EAST + x, NORTH + y) for ring in rings for x, y in ring]
        starts, at = [], 0
        for ring in rings:
            starts.append(at)
            at += len(ring)
        content = struct.pack("<i4dii", 5, *bounds(points), len(rings), len(points))
        content += struct.pack(f"<{len(rings)}i", *starts) + b"".join(struct.pack("<2d", *p) for p in points)
        records.append(content)
    everything = [(EAST + x, NORTH + y) for h in HOUSES for x, y in h[4]]

    def header(length):
        box = bounds(everything)
        return struct.pack(">7i", 9994, 0, 0, 0, 0, 0, length // 2) + struct.pack("<ii8d", 1000, 5, *box, 0, 0, 0, 0)

    shp, shx, at = b"", b"", 100
    for number, content in enumerate(records, 1):
        head = struct.pack(">2i", number, len(content) // 2)
        shx += struct.pack(">2i", at // 2, len(content) // 2)
        shp += head + content
        at += 8 + len(content)
    write("houses.shp", header(at) + shp)
    write("houses.shx", header(100 + len(shx)) + shx)
    fields = [("ID", "C", 4, 0), ("NAME", "C", 16, 0), ("LEVELS", "N", 3, 0), ("HEIGHT", "N", 6, 2)]
    rows = [
        b" " + cell(key, 4) + cell(name, 16) + f"{levels:3d}{levels * STOREY:6.2f}".encode()
        for key, name, levels, *_ in HOUSES
    ]
    size = 1 + sum(f[2] for f in fields)
    dbf = struct.pack("<4BIHH20x", 3, 126, 1, 1, len(rows), 32 * len(fields) + 33, size)
    for name, kind, width, places in fields:
        dbf += struct.pack("<11sc4xBB14x", name.encode(), kind.encode(), width, places)
    write("houses.dbf", dbf + b"\r" + b"".join(rows) + b"\x1a")
    write(
        "houses.prj",
        'PROJCS["JGD2011_Japan_Zone_6",GEOGCS["GCS_JGD_2011",DATUM["D_JGD_2011",SPHEROID["GRS_1980",6378137.0,298.257222101]],'
        'PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["False_Easting",0.0],'
        'PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",136.0],PARAMETER["Scale_Factor",0.9999],'
        'PARAMETER["Latitude_Of_Origin",36.0],UNIT["Meter",1.0]]',
    )


def bounds(points):
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return min(xs), min(ys), max(xs), max(ys)


def cell(text, width):
    return text.encode("cp932").ljust(width)


def osm():
    nodes, ways, relations = {}, [], []

    def node(point):
        return nodes.setdefault(point, len(nodes) + 1)

    def way(points, tags):
        number = len(ways) + 101
        refs = "".join(f'  <nd ref="{node(p)}"/>\n' for p in points)
        ways.append(f' <way id="{number}" version="1">\n{refs}{tags_of(tags)} </way>\n')
        return number

    def tags_of(tags):
        return "".join(f'  <tag k="{k}" v="{v}"/>\n' for k, v in tags.items())

    for key, name, levels, _, outline, courts in HOUSES:
        tags = {"building": "yes", "building:levels": levels, "name": name, "ref": key}
        outer = way(closed(outline), {} if courts else tags)
        if courts:
            members = f'  <member type="way" ref="{outer}" role="outer"/>\n'
            for court in courts:
                members += f'  <member type="way" ref="{way(closed(court), {})}" role="inner"/>\n'
            tags = {"type": "multipolygon", **tags}
            relations.append(f' <relation id="{201 + len(relations)}" version="1">\n{members}{tags_of(tags)} </relation>\n')
    way(STREET, {"highway": "residential", "name": "本通", "width": STREET_WIDTH})
    node(TREE)
    text = ""
    for point, number in nodes.items():
        lon, lat = lonlat(point)
        place = f'<node id="{number}" version="1" lat="{lat:.8f}" lon="{lon:.8f}"'
        tree = '>\n  <tag k="natural" v="tree"/>\n </node>' if point == TREE else "/>"
        text += f" {place}{tree}\n"
    head = '<?xml version="1.0" encoding="UTF-8"?>\n<osm version="0.6" generator="tests/data/make.py">\n'
    write("hamlet.osm", head + text + "".join(ways) + "".join(relations) + "</osm>\n")


def dxf():
    out = []

    def put(*pairs):
        for code, value in pairs:
            out.append(f"{code:>3}\r\n{value}\r\n")

    def polyline(layer, points, is_closed):
        put((0, "POLYLINE"), (8, layer), (66, 1), (10, "0.0"), (20, "0.0"), (30, "0.0"), (70, 1 if is_closed else 0))
        for x, y in points:
            put((0, "VERTEX"), (8, layer), (10, f"{x:.3f}"), (20, f"{y:.3f}"), (30, "0.0"))
        put((0, "SEQEND"), (8, layer))

    put((0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009"), (9, "$INSUNITS"), (70, 6), (0, "ENDSEC"))
    layers = ["HOUSE", "COURT", "STREET", "TEXT"]
    put((0, "SECTION"), (2, "TABLES"), (0, "TABLE"), (2, "LAYER"), (70, len(layers)))
    for color, layer in enumerate(layers, 1):
        put((0, "LAYER"), (2, layer), (70, 0), (62, color), (6, "CONTINUOUS"))
    put((0, "ENDTAB"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES"))
    for key, _, _, _, outline, courts in HOUSES:
        polyline("HOUSE", outline, True)
        for court in courts:
            polyline("COURT", court, True)
        x, y = outline[0]
        put((0, "TEXT"), (8, "TEXT"), (10, f"{x + 1:.3f}"), (20, f"{y + 1:.3f}"), (30, "0.0"), (40, "0.5"), (1, key))
    polyline("STREET", STREET, False)
    put((0, "ENDSEC"), (0, "EOF"))
    write("houses.dxf", "".join(out))


def cityjson():
    points, objects = {}, {}

    def vertex(x, y, z):
        place = (round((x + 10) * 1000), round((y + 10) * 1000), round(z * 1000))
        return points.setdefault(place, len(points))

    for key, name, levels, _, outline, courts in HOUSES:
        height = levels * STOREY
        rings = [outline] + [c[::-1] for c in courts]
        top = [[vertex(x, y, height) for x, y in ring] for ring in rings]
        bottom = [[vertex(x, y, 0) for x, y in ring[::-1]] for ring in rings]
        walls = [
            [[vertex(*p, 0), vertex(*q, 0), vertex(*q, height), vertex(*p, height)]]
            for ring in rings
            for p, q in zip(ring, ring[1:] + ring[:1])
        ]
        values = [0, 1] + [2] * len(walls)
        semantics = {
            "surfaces": [{"type": "GroundSurface"}, {"type": "RoofSurface"}, {"type": "WallSurface"}],
            "values": [values],
        }
        solid = {"type": "Solid", "lod": "1", "boundaries": [[bottom, top, *walls]], "semantics": semantics}
        objects[key] = {
            "type": "Building",
            "attributes": {"name": name, "measuredHeight": height, "storeysAboveGround": levels},
            "geometry": [solid],
        }
    city = {
        "type": "CityJSON",
        "version": "2.0",
        "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/6674"},
        "transform": {"scale": [0.001] * 3, "translate": [EAST - 10, NORTH - 10, 0.0]},
        "CityObjects": objects,
        "vertices": [list(p) for p in points],
    }
    write("houses.city.json", json.dumps(city, ensure_ascii=False, separators=(",", ":")) + "\n")


def citygml():
    def ring(points, height):
        places = [lonlat(p) for p in closed(points)]
        return " ".join(f"{lat:.8f} {lon:.8f} {height:.2f}" for lon, lat in places)

    def linear(tag, points, height):
        inner = f"<gml:LinearRing><gml:posList>{ring(points, height)}</gml:posList></gml:LinearRing>"
        return f"<gml:{tag}>{inner}</gml:{tag}>"

    text = ""
    for key, name, levels, _, outline, courts in HOUSES:
        height = levels * STOREY
        holes = "".join(linear("interior", c[::-1], height) for c in courts)
        text += f"""  <core:cityObjectMember>
    <bldg:Building gml:id="bldg_{key}">
      <gml:name>{name}</gml:name>
      <bldg:measuredHeight uom="m">{height:.1f}</bldg:measuredHeight>
      <bldg:storeysAboveGround>{levels}</bldg:storeysAboveGround>
      <bldg:lod0RoofEdge><gml:MultiSurface><gml:surfaceMember><gml:Polygon>
        {linear("exterior", outline, height)}{holes}
      </gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod0RoofEdge>
    </bldg:Building>
  </core:cityObjectMember>
"""
    head = """<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
    xmlns:gml="http://www.opengis.net/gml">
  <gml:boundedBy><gml:Envelope srsName="http://www.opengis.net/def/crs/EPSG/0/6697" srsDimension="3">
"""
    corners = [lonlat(p) for h in HOUSES for p in h[4]]
    west, south, east, north = bounds(corners)
    box = f"    <gml:lowerCorner>{south:.8f} {west:.8f} 0</gml:lowerCorner><gml:upperCorner>{north:.8f} {east:.8f} 6</gml:upperCorner>\n"
    write("houses.gml", head + box + "  </gml:Envelope></gml:boundedBy>\n" + text + "</core:CityModel>\n")


def ground():
    columns, rows, size = 6, 6, 10
    lines = [f"ncols {columns}", f"nrows {rows}", f"xllcorner {EAST - 15}", f"yllcorner {NORTH - 15}", f"cellsize {size}", "NODATA_value -9999"]
    for row in range(rows):
        heights = [40 + 0.3 * (rows - row) + 0.1 * column for column in range(columns)]
        if row == 0:
            heights[-1] = -9999
        lines.append(" ".join(f"{h:g}" for h in heights))
    write("ground.asc", "\n".join(lines) + "\n")


for make in (geojson, shapefile, osm, dxf, cityjson, citygml, ground):
    make()

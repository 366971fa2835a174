"""Writes a town of machiya in rows, as many as wanted: `python rows.py 200000 FOLDER [SIDE [parquet]]` makes FOLDER/rows.hsd with its
maps, in tiles of SIDE metres (250); with `parquet` the houses are GeoParquet, a row group for each street (needs pyarrow).

All houses differ: frontage, depth and type are drawn by place. Metres of a survey; 20 houses on each side of a street.
"""

from __future__ import annotations

import json
import random
import struct
import sys
from collections.abc import Iterator
from pathlib import Path

TOWN = """<Town name="rows" crs="local" origin="0 0" seed="7">
  <Layer name="houses" src="houses.{kind}" crs="local"/>
  <Layer name="roads" src="roads.geojson" crs="local"/>
  <for each="houses">
    <random>
      <choice weight="6"><Place type="so-nikai" on="plot"/></choice>
      <choice weight="4"><Place type="chu-nikai" on="plot"/></choice>
    </random>
  </for>
  <Tiles size="{size}" detail="{detail}"/>
</Town>
"""

ROW = 40  # houses in a block: two rows back to back
WIDTH, DEPTH, STREET = 120.0, 40.0, 6.0  # of a block, metres


def block(number: int, across: int) -> tuple[float, float]:
    return (number % across) * (WIDTH + STREET), (number // across) * (DEPTH + STREET)


def houses(count: int, across: int) -> Iterator[list[list[tuple[float, float]]]]:
    """The rings of all houses, a block at a time."""
    draw = random.Random(28000)
    left = count
    for number in range(-(-count // ROW)):
        west, south = block(number, across)
        rings = []
        for back in (False, True):
            x = west
            for house in range(min(ROW // 2, left)):
                rest = ROW // 2 - house
                mean = (west + WIDTH - x) / rest
                frontage = mean if rest == 1 else mean + round(draw.uniform(-0.9, 0.9), 2)
                depth = round(draw.uniform(12, 18), 2)
                near = south + DEPTH - depth if back else south
                far = south + DEPTH if back else south + depth
                corners = [(x, near), (x + frontage, near), (x + frontage, far), (x, far), (x, near)]
                # As a text has them, whatever the format.
                rings.append([(float(f"{px:.2f}"), float(f"{py:.2f}")) for px, py in corners])
                left -= 1
                x = round(x + frontage, 2)
        yield rings


def geojson(path: Path, blocks: Iterator[list[list[tuple[float, float]]]]) -> None:
    key = 0
    with open(path, "w") as file:
        file.write('{"type":"FeatureCollection","features":[\n')
        for rings in blocks:
            for ring in rings:
                points = ",".join(f"[{x:.2f},{y:.2f}]" for x, y in ring)
                file.write(
                    ("," if key else "") + f'{{"type":"Feature","id":{key},"properties":{{}},"geometry":'
                    f'{{"type":"Polygon","coordinates":[[{points}]]}}}}\n'
                )
                key += 1
        file.write("]}\n")


def parquet(path: Path, blocks: Iterator[list[list[tuple[float, float]]]]) -> None:
    """GeoParquet, a row group for each block: whoever reads it has one of them in memory."""
    import pyarrow
    import pyarrow.parquet

    geo = {"version": "1.1.0", "primary_column": "geometry", "columns": {"geometry": {"encoding": "WKB", "geometry_types": ["Polygon"], "crs": None}}}
    fields = [pyarrow.field("id", pyarrow.int64()), pyarrow.field("geometry", pyarrow.binary())]
    schema = pyarrow.schema(fields, metadata={"geo": json.dumps(geo)})
    key = 0
    with pyarrow.parquet.ParquetWriter(path, schema) as file:
        for rings in blocks:
            shapes = [struct.pack(f"<BIII{2 * len(ring)}d", 1, 3, 1, len(ring), *(x for point in ring for x in point)) for ring in rings]
            file.write_table(pyarrow.table([range(key, key + len(rings)), shapes], schema=schema))
            key += len(rings)


def write(count: int, folder: Path, *, size: float = 250, detail: str = "0", kind: str = "geojson") -> Path:
    """Writes the town; returns its file. The same count gives the same bytes."""
    folder.mkdir(parents=True, exist_ok=True)
    blocks = -(-count // ROW)
    across = max(1, round((blocks * (DEPTH + STREET) / (WIDTH + STREET)) ** 0.5))
    {"geojson": geojson, "parquet": parquet}[kind](folder / f"houses.{kind}", houses(count, across))
    with open(folder / "roads.geojson", "w") as roads:
        roads.write('{"type":"FeatureCollection","features":[\n')
        for row in range(-(-blocks // across) + 1):
            y = row * (DEPTH + STREET) - STREET / 2
            end = across * (WIDTH + STREET)
            roads.write(
                ("," if row else "")
                + '{"type":"Feature","properties":{"width":6},"geometry":'
                f'{{"type":"LineString","coordinates":[[0,{y}],[{end},{y}]]}}}}\n'
            )
        roads.write("]}\n")
    town = folder / "rows.hsd"
    town.write_text(TOWN.format(size=size, detail=detail, kind=kind))
    return town


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4, 5):
        sys.exit(__doc__)
    side = float(sys.argv[3]) if len(sys.argv) > 3 else 250
    print(write(int(sys.argv[1]), Path(sys.argv[2]), size=side, kind=sys.argv[4] if len(sys.argv) > 4 else "geojson"))

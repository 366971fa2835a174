"""Writes a town of machiya in rows, as many as wanted: `python rows.py 200000 FOLDER [SIDE]` makes FOLDER/rows.hsd with its maps,
in tiles of SIDE metres (250).

All houses differ: frontage, depth and type are drawn by place. Metres of a survey; 20 houses on each side of a street.
"""

from __future__ import annotations

import random
import sys
from pathlib import Path

TOWN = """<Town name="rows" crs="local" origin="0 0" seed="7">
  <Layer name="houses" src="houses.geojson" crs="local"/>
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


def write(count: int, folder: Path, *, size: float = 250, detail: str = "0") -> Path:
    """Writes the town; returns its file. The same count gives the same bytes."""
    folder.mkdir(parents=True, exist_ok=True)
    blocks = -(-count // ROW)
    across = max(1, round((blocks * (DEPTH + STREET) / (WIDTH + STREET)) ** 0.5))
    draw = random.Random(28000)
    left = count
    with open(folder / "houses.geojson", "w") as houses, open(folder / "roads.geojson", "w") as roads:
        for file in (houses, roads):
            file.write('{"type":"FeatureCollection","features":[\n')
        for number in range(blocks):
            west, south = block(number, across)
            for back in (False, True):
                x = west
                for house in range(ROW // 2):
                    if left == 0:
                        break
                    rest = ROW // 2 - house
                    mean = (west + WIDTH - x) / rest
                    frontage = mean if rest == 1 else mean + round(draw.uniform(-0.9, 0.9), 2)
                    depth = round(draw.uniform(12, 18), 2)
                    near = south + DEPTH - depth if back else south
                    far = south + DEPTH if back else south + depth
                    ring = [(x, near), (x + frontage, near), (x + frontage, far), (x, far), (x, near)]
                    points = ",".join(f"[{px:.2f},{py:.2f}]" for px, py in ring)
                    key = count - left
                    houses.write(
                        ("," if key else "")
                        + f'{{"type":"Feature","id":{key},"properties":{{}},"geometry":'
                        f'{{"type":"Polygon","coordinates":[[{points}]]}}}}\n'
                    )
                    left -= 1
                    x = round(x + frontage, 2)
        down = -(-blocks // across)
        for row in range(down + 1):
            y = row * (DEPTH + STREET) - STREET / 2
            end = across * (WIDTH + STREET)
            roads.write(
                ("," if row else "")
                + '{"type":"Feature","properties":{"width":6},"geometry":'
                f'{{"type":"LineString","coordinates":[[0,{y}],[{end},{y}]]}}}}\n'
            )
        for file in (houses, roads):
            file.write("]}\n")
    town = folder / "rows.hsd"
    town.write_text(TOWN.format(size=size, detail=detail))
    return town


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    side = float(sys.argv[3]) if len(sys.argv) > 3 else 250
    print(write(int(sys.argv[1]), Path(sys.argv[2]), size=side))

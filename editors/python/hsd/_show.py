"""Models in notebooks: of a house, and of a town on maps."""

import base64
import csv
import html
import pathlib
import re
import tempfile

from ._program import Error, is_text, require, run, settings, words_of

_PAGE = """<!doctype html><meta charset="utf-8"><style>
body {{ margin: 0; overflow: hidden; font: 13px sans-serif }} canvas {{ display: block }}
p {{ position: fixed; left: 8px; bottom: 6px; margin: 0; color: #223; pointer-events: none }}</style>
<p data-line="line">{note}</p><script type="model/gltf-binary">{model}</script><script>{viewer}</script>"""


def _viewer():
    path = pathlib.Path(__file__).with_name("viewer.js")
    return path.read_text(encoding="utf-8") if path.exists() else ""


class Model:
    """A model (.glb) that shows itself in a notebook: turn it, zoom, click a part to read what it is and its line."""

    def __init__(self, glb, messages=(), height=480):
        self.glb, self.messages, self.height = glb, list(messages), height

    def save(self, path):
        """Writes the model to a file and returns its path."""
        path = pathlib.Path(path)
        path.write_bytes(self.glb)
        return path

    def page(self):
        """A page with the model and nothing from elsewhere."""
        viewer = _viewer()
        note = "" if viewer else "this copy of the module has no viewer: install its wheel"
        return _PAGE.format(note=note, model=base64.b64encode(self.glb).decode(), viewer=viewer.replace("</script", "<\\/script"))

    def _repr_html_(self):
        said = "".join(f"<pre>{html.escape(str(m))}</pre>" for m in self.messages)
        frame = f'<iframe sandbox="allow-scripts" style="border:0;width:100%;height:{self.height}px" srcdoc="{html.escape(self.page())}"></iframe>'
        return frame + said

    def __repr__(self):
        return f"<{type(self).__name__}: {len(self.glb):,} bytes>"


class House(Model):
    """The model of a text."""


class Town(Model):
    """The model of a town, its text, and for each feature of its maps what was built on it and why (`decisions`)."""

    def __init__(self, glb, messages, height, text, decisions):
        super().__init__(glb, messages, height)
        self.text, self.decisions = text, decisions


def build(source, *, detail=3, parameters=None, seed=None, cutaway=False, storey=None, height=480):
    """Builds the model of a text, or of a file where `source` has one line. Raises `Error` with line, reason and fix.

    `detail` is 0 (walls and roofs) to 3 (all joinery), `cutaway` leaves out roofs, `storey` all
    that is above one.
    """
    messages = require(source, parameters, seed)
    name, text = words_of(source)
    words = ["build", "--quiet", "--detail", detail, *settings(parameters, seed),
             *(["--cutaway"] if cutaway and storey is None else [])]
    if storey is not None:
        words += ["--storey", storey]
    status, glb, errors = run([*words, name, "-o", "-", "--format", "glb"], text)
    if status != 0:
        raise Error(errors.strip() or f"hsd build ended with {status}")
    return House(glb, messages, height)


def show(source, **how):
    """Shows a house in a notebook: `hsd.show(text)`, or the path of a file. Takes what `build` takes, and `height` in pixels."""
    return build(source, **how)


def _write(layer, path):
    """Writes a map: a GeoDataFrame, an object that is GeoJSON, or its text."""
    if hasattr(layer, "to_json"):
        layer = (layer.to_crs(4326) if getattr(layer, "crs", None) is not None else layer).to_json()
    elif hasattr(layer, "__geo_interface__") or isinstance(layer, dict):
        import json
        layer = json.dumps(getattr(layer, "__geo_interface__", layer))
    path.write_text(layer, encoding="utf-8")


def town(source=None, layers=None, *, detail=1, parameters=None, seed=None, height=480):
    """Builds a town: `layers` are maps by name, GeoDataFrames for example, which the text names as NAME.geojson.

    Without a text `hsd town init` writes a first one from the maps; it is the `text` of the result.
    """
    with tempfile.TemporaryDirectory(prefix="hsd-") as folder:
        folder = pathlib.Path(folder)
        maps = []
        for name, layer in (layers or {}).items():
            if not re.fullmatch(r"[\w-]+", name):
                raise Error(f"{name!r} is no name for a file: use letters, digits and -")
            maps.append(folder / f"{name}.geojson")
            _write(layer, maps[-1])
        path = folder / "town.hsd"
        if source is None:
            status, _, errors = run(["town", "init", *maps, "-o", path])
            if status != 0:
                raise Error(errors.strip())
        elif is_text(source):
            path.write_text(words_of(source)[1], encoding="utf-8")
        else:
            path = pathlib.Path(source)
        messages = require(path, parameters, seed)
        model = folder / "out" / "town.glb"
        model.parent.mkdir()
        status, _, errors = run(["town", "--quiet", "--detail", detail, *settings(parameters, seed), path, "-o", model])
        # 1 when a feature has no house that nobody asked to skip: the town is there.
        if status not in (0, 1) or not model.exists():
            raise Error(errors.strip() or f"hsd town ended with {status}")
        with open(model.with_suffix(".decisions.csv"), encoding="utf-8-sig", newline="") as file:
            decisions = list(csv.DictReader(file))
        return Town(model.read_bytes(), messages, height, path.read_text(encoding="utf-8"), decisions)

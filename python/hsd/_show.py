"""Models that notebooks show."""

from __future__ import annotations

import base64
import html
import os
from pathlib import Path

from ._text import Message, Parameters, Text, job, made

_PAGE = """<!doctype html><meta charset="utf-8"><style>
body {{ margin: 0; overflow: hidden; font: 13px sans-serif }} canvas {{ display: block }}
p {{ position: fixed; left: 8px; bottom: 6px; margin: 0; color: #223; pointer-events: none }}</style>
<p data-line="line"></p><script type="model/gltf-binary">{model}</script><script>{viewer}</script>"""


class Model:
    """A model (.glb) that shows itself in a notebook: turn it, zoom, click a part to read what it is and its line."""

    def __init__(self, glb: bytes, messages: list[Message], height: int = 480) -> None:
        #: The bytes of the model.
        self.glb = glb
        #: Warnings and notes on its text.
        self.messages = messages
        #: Pixels of its frame.
        self.height = height

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Writes the model to a file and returns its path."""
        path = Path(path)
        path.write_bytes(self.glb)
        return path

    def page(self) -> str:
        """A page with the model and nothing from elsewhere."""
        viewer = Path(__file__).with_name("viewer.js").read_text(encoding="utf-8")
        return _PAGE.format(model=base64.b64encode(self.glb).decode(), viewer=viewer.replace("</script", "<\\/script"))

    def _repr_html_(self) -> str:
        said = "".join(f"<pre>{html.escape(str(m))}</pre>" for m in self.messages)
        frame = f'<iframe sandbox="allow-scripts" style="border:0;width:100%;height:{self.height}px" srcdoc="{html.escape(self.page())}"></iframe>'
        return frame + said

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self.glb):,} bytes>"


class House(Model):
    """The model of a text."""


def show(
    source: Text,
    *,
    detail: int = 3,
    parameters: Parameters | None = None,
    seed: int | None = None,
    cutaway: bool = False,
    storey: int | None = None,
    language: str = "en",
    height: int = 480,
) -> House:
    """Shows a house in a notebook: that of a text, or of a file. It takes what `compile` takes, and `height` in pixels."""
    return House(*made(job(source, parameters, seed, detail, cutaway, storey, language), None), height)

"""Runs the notebooks where nbclient is there:

    python notebooks.py NOTEBOOKS [OUT]

The wheel is installed. OUT gets a page for each model of the notebooks.
"""

import importlib.util
import pathlib
import sys
import tempfile
import time

#: Notebooks, what they need, and the number of models that they show.
NOTEBOOKS = (("house", ["nbclient", "ipykernel"], 3), ("street", ["nbclient", "ipykernel", "geopandas"], 1))


def run_notebook(path, out):
    """Runs a notebook and returns its time and models; an error in a cell is raised."""
    import nbclient
    import nbformat
    notebook = nbformat.read(path, as_version=4)
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
    outputs = [o for c in notebook.cells if c.cell_type == "code" for o in c.outputs]
    pages = [o["data"]["text/html"] for o in outputs if "<iframe" in o.get("data", {}).get("text/html", "")]
    for number, page in enumerate(pages if out else []):
        pathlib.Path(out, f"{path.stem}-{number}.html").write_text(page, encoding="utf-8")
    return time.monotonic() - begun, pages


def main(notebooks, out):
    for name, needs, models in NOTEBOOKS:
        missing = [one for one in needs if importlib.util.find_spec(one) is None]
        if missing:
            print(f"left out: {name}.ipynb, since {', '.join(missing)} is not installed (pip install {' '.join(missing)})")
            continue
        seconds, pages = run_notebook(pathlib.Path(notebooks, f"{name}.ipynb"), out)
        if len(pages) != models:
            print(f"{name}.ipynb shows {len(pages)} models, not {models}")
            return 1
        print(f"{name}.ipynb: {len(pages)} models in {seconds:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None))

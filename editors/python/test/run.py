"""Tests of the module, and of the notebooks where nbclient is there:

    python run.py NOTEBOOKS [OUT]

The wheel is installed. OUT gets a page for each model of the notebooks.
"""

import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import hsd

TEXT = "0 0 180\n9.5\n\nKKS  TKD 2MRE\nKSK  MRE  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n"


class Module(unittest.TestCase):
    def test_a_text_becomes_a_model(self):
        house = hsd.show(TEXT)
        self.assertEqual(house.glb[:4], b"glTF")
        self.assertEqual(house.messages, [])
        self.assertIn("<iframe", house._repr_html_())
        self.assertEqual(house.glb, hsd.build("\n" + TEXT).glb)

    def test_the_wheel_has_a_viewer(self):
        self.assertIn("WebGL", hsd.build(TEXT, detail=0).page())

    def test_a_file_becomes_a_model(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a house.hsd")
            path.write_text(TEXT)
            self.assertEqual(hsd.build(str(path)).save(pathlib.Path(folder, "a.glb")).read_bytes()[:4], b"glTF")

    def test_errors_have_line_reason_and_fix(self):
        with self.assertRaises(hsd.Error) as raised:
            hsd.show(TEXT.replace("MRE  KSK", "MRX  KSK"))
        message = raised.exception.messages[0]
        self.assertEqual((message.code, message.line, message.column), ("HSD0301", 5, 6))
        self.assertIn("MRE", message.fix)
        self.assertIn("KSK  MRX  KSK", str(raised.exception))

    def test_bytes_of_a_model(self):
        self.assertEqual(hsd.compile(TEXT, detail=1), hsd.build(TEXT, detail=1).glb)

    def test_a_town_in_steps_is_the_town_at_once(self):
        squares = [{"type": "Feature", "properties": {"key": str(x)}, "geometry": {"type": "Polygon", "coordinates": [
            [[x, 0], [x + 6, 0], [x + 6, 9], [x, 9], [x, 0]]]}} for x in (0, 300, 600)]
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "houses.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": squares}))
            town = folder / "t.hsd"
            town.write_text('<Town name="t" origin="0 0"><Layer name="houses" src="houses.geojson" crs="local" key="key"/>\n'
                            '<for each="houses"><Place type="hiraya"/></for></Town>\n')
            tiles = hsd.town.plan(town, folder / "work", detail=[0])
            self.assertEqual([t.features for t in tiles], [1, 1, 1])
            with self.assertRaises(hsd.StepError) as raised:
                hsd.town.seal(folder / "work", folder / "out")
            self.assertEqual((raised.exception.status, raised.exception.may_pass), (2, False))
            for one in tiles:
                hsd.town.tile(folder / "work", one.key)
            sealed = hsd.town.seal(folder / "work", folder / "out")
            self.assertTrue(sealed.complete)
            self.assertEqual(sealed.report()["built"], 3)
            subprocess.run([hsd.program(), "town", town, "-o", f"{folder}/once/", "--detail", "0", "--quiet"], check=True)
            files = lambda of: {p.relative_to(of): p.read_bytes() for p in of.rglob("*") if p.is_file()}
            self.assertEqual(files(folder / "out"), files(folder / "once"))
            with self.assertRaises(hsd.StepError):
                hsd.town.planned(folder)

    def test_parameters(self):
        text = '<Houses>\n<Param name="wide" default="no" choices="yes no"/>\n<Place type="hiraya"/></Houses>\n'
        self.assertTrue([m for m in hsd.check(text, {"narrow": 1})])

    def test_a_town(self):
        square = {"type": "Polygon", "coordinates": [[[0, 0], [6, 0], [6, 9], [0, 9], [0, 0]]]}
        houses = {"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"key": "a"}, "geometry": square}]}
        town = hsd.town('<Town name="t">\n<Layer name="houses" src="houses.geojson" crs="local" key="key"/>\n'
                        '<for each="houses"><Place type="hiraya"/></for>\n</Town>\n', {"houses": houses}, detail=0)
        self.assertEqual([(d["key"], d["type"]) for d in town.decisions], [("a", "hiraya")])
        self.assertEqual(town.glb[:4], b"glTF")
        with self.assertRaisesRegex(hsd.Error, "no name"):
            hsd.town(None, {"../houses": houses})


def run_notebook(path, out):
    """Runs a notebook and returns its time and models; an error in a cell is raised."""
    import nbclient
    import nbformat
    notebook = nbformat.read(path, as_version=4)
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
    pages = [o["data"]["text/html"] for c in notebook.cells if c.cell_type == "code" for o in c.outputs if "<iframe" in o.get("data", {}).get("text/html", "")]
    for number, page in enumerate(pages if out else []):
        pathlib.Path(out, f"{path.stem}-{number}.html").write_text(page, encoding="utf-8")
    return time.monotonic() - begun, pages


def main(notebooks, out):
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(Module)
    if not unittest.TextTestRunner(verbosity=1).run(suite).wasSuccessful():
        return 1
    for name, needs, models in (("house", ["nbclient", "ipykernel"], 3), ("street", ["nbclient", "ipykernel", "geopandas"], 1)):
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

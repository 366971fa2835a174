"""Tests of the installed package: `python -m unittest discover -s python/tests`."""

import hashlib
import shutil
import tempfile
import threading
import time
import unittest
from pathlib import Path

import hsd

ROOT = Path(__file__).resolve().parents[2]
SHOP = "0 0 180\n\nGSI  GSI  GDE 2KKS\n"


def tree(folder: Path) -> str:
    """Returns the hash of names and bytes of all files in a folder."""
    total = hashlib.sha256()
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        total.update(str(path.relative_to(folder)).encode() + b"\0" + path.read_bytes())
    return total.hexdigest()


class House(unittest.TestCase):
    def test_a_house_becomes_a_model(self):
        glb = hsd.compile(SHOP)
        self.assertEqual(glb[:4], b"glTF")
        self.assertEqual(glb, hsd.compile(SHOP))
        self.assertLess(len(hsd.compile(SHOP, detail=0)), len(glb))

    def test_what_is_wrong_is_told(self):
        self.assertNotIn("error", [d.severity for d in hsd.check(SHOP)])
        found = hsd.check("0 0 180\n\nGSI  TKX 2GDE 2KKS\n", name="a.hsd")
        codes = {d.code for d in found}
        self.assertIn("HSD0301", codes)
        wrong = next(d for d in found if d.code == "HSD0301")
        self.assertEqual((wrong.file, wrong.line), ("a.hsd", 3))
        self.assertTrue(wrong.help and wrong.message)
        self.assertIn("HSD0301", str(wrong))
        japanese = hsd.check("0 0 180\n\nGSI  TKX 2GDE 2KKS\n", language="ja")
        self.assertNotEqual(japanese[0].message, found[0].message)

    def test_errors_raise(self):
        with self.assertRaises(hsd.CompileError) as raised:
            hsd.compile("<House>")
        message, found = raised.exception.args
        self.assertTrue(message)
        self.assertTrue(any(d.severity == "error" for d in found))
        with self.assertRaises(ValueError):
            hsd.compile(SHOP, detail=4)

    def test_parameters_and_files_beside(self):
        examples = ROOT / "examples"
        text = (examples / "machiya.hsd").read_text()
        self.assertEqual(hsd.compile(text, folder=examples)[:4], b"glTF")

    def test_a_notebook_shows_a_house(self):
        picture = hsd.show(SHOP, width=64, height=48)
        self.assertEqual(picture._repr_png_()[:8], b"\x89PNG\r\n\x1a\n")

    def test_other_threads_go_on(self):
        text = (ROOT / "examples" / "machiya.hsd").read_text()
        beats, stop = [], threading.Event()

        def beat():
            while not stop.is_set():
                beats.append(time.monotonic())
                time.sleep(0.001)

        thread = threading.Thread(target=beat)
        thread.start()
        begun = time.monotonic()
        hsd.compile(text, folder=ROOT / "examples")
        ended = time.monotonic()
        stop.set()
        thread.join()
        during = [at for at in beats if begun < at < ended]
        self.assertGreater(len(during), (ended - begun) * 10)


class Town(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        shutil.copytree(ROOT / "examples" / "towns", self.folder / "towns")
        self.town = self.folder / "towns" / "block.hsd"
        self.work = self.folder / "work"

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_three_steps_make_what_one_makes(self):
        tiles = hsd.town.plan(self.town, self.work, detail=[0])
        self.assertTrue(tiles)
        self.assertEqual(tiles, hsd.town.planned(self.work))
        with self.assertRaises(hsd.town.TownError) as raised:
            hsd.town.seal(self.work, self.folder / "out")
        self.assertEqual(raised.exception.status, 2)
        self.assertFalse(raised.exception.may_pass)
        for tile in reversed(tiles):
            hsd.town.tile(self.work, tile.key)
        sealed = hsd.town.seal(self.work, self.folder / "out")
        report = sealed.report()
        self.assertEqual(report["features"], report["built"] + len(report["skipped"]))
        status, _ = hsd._hsd.call(
            ["hsd", "town", str(self.town), "-o", f"{self.folder / 'plain'}/", "--detail", "0", "-q"]
        )
        self.assertEqual(status == 0, sealed.complete)
        self.assertEqual(tree(self.folder / "out"), tree(self.folder / "plain"))

    def test_what_cannot_be_done_is_told(self):
        with self.assertRaises(hsd.town.TownError):
            hsd.town.tile(self.work, "0_0")
        hsd.town.plan(self.town, self.work, detail=[0])
        with self.assertRaises(hsd.town.TownError) as raised:
            hsd.town.tile(self.work, ["no such tile"])
        self.assertIn("no such tile", str(raised.exception))
        self.town.write_text(self.town.read_text() + "<!-- -->\n")
        with self.assertRaises(hsd.town.TownError) as raised:
            hsd.town.tile(self.work, [hsd.town.planned(self.work)[0].key])
        self.assertIn("changed", str(raised.exception))


if __name__ == "__main__":
    unittest.main()

"""Tests of the installed wheel: `python -m unittest discover -s python/test`. They need no other package; frames are tested where
geopandas is."""

import importlib.util
import json
import multiprocessing
import pathlib
import pickle
import signal
import subprocess
import sys
import sysconfig
import tempfile
import threading
import time
import unittest

import hsd

TEXT = "0 0 180\n9.5\n\nKKS  TKD 2MRE\nKSK  MRE  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n"
WRONG = TEXT.replace("MRE  KSK", "MRX  KSK")
TOWN = '<Town name="t" origin="0 0"><Layer name="houses" src="houses.geojson" crs="local" key="key"/>\n<for each="houses"><Place type="hiraya"/></for></Town>\n'
#: Takes seconds.
MANY = "<Houses>\n" + "".join(f'<Place type="chu-nikai" name="h{n}" x="{n * 20}"/>\n' for n in range(400)) + "</Houses>\n"


def squares(*west):
    ring = lambda x: [[x, 0], [x + 6, 0], [x + 6, 9], [x, 9], [x, 0]]
    one = lambda x: {"type": "Feature", "properties": {"key": str(x)}, "geometry": {"type": "Polygon", "coordinates": [ring(x)]}}
    return {"type": "FeatureCollection", "features": [one(x) for x in west]}


def files(folder):
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


class House(unittest.TestCase):
    def test_a_text_becomes_a_model(self):
        glb = hsd.compile(TEXT)
        self.assertEqual(glb[:4], b"glTF")
        self.assertEqual(glb, hsd.compile("\n" + TEXT, threads=1))
        self.assertLess(len(hsd.compile(TEXT, detail=0)), len(glb))
        self.assertNotEqual(hsd.compile(TEXT, cutaway=True), glb)
        with self.assertRaises(ValueError):
            hsd.compile(TEXT, detail=4)

    def test_it_is_the_model_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a house.hsd")
            path.write_text(TEXT)
            made = pathlib.Path(folder, "a.glb")
            program = pathlib.Path(sysconfig.get_path("scripts"), "hsd")
            subprocess.run([program, "build", "--quiet", path, "-o", made], check=True)
            self.assertEqual(hsd.compile(path), made.read_bytes())
            self.assertEqual(hsd.compile(str(path)), made.read_bytes())
            with self.assertRaises(FileNotFoundError):
                hsd.compile(path.with_name("none.hsd"))

    def test_a_notebook_shows_it(self):
        house = hsd.show(TEXT, detail=0, height=300)
        self.assertEqual((house.glb, house.messages), (hsd.compile(TEXT, detail=0), []))
        self.assertIn("height:300px", house._repr_html_())
        self.assertIn("WebGL", house.page())
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(house.save(pathlib.Path(folder, "a.glb")).read_bytes(), house.glb)

    def test_errors_have_line_reason_and_fix(self):
        with self.assertRaises(hsd.Error) as raised:
            hsd.show(WRONG)
        message = raised.exception.messages[0]
        self.assertEqual((message.code, message.severity, message.file, message.line, message.column), ("HSD0301", "error", "<text>", 5, 6))
        self.assertIn("MRE", message.fix)
        self.assertIn("KSK  MRX  KSK", str(raised.exception))
        self.assertEqual(raised.exception.messages, hsd.check(WRONG))
        self.assertNotEqual(hsd.check(WRONG, language="ja")[0].message, message.message)
        again = pickle.loads(pickle.dumps(raised.exception))
        self.assertEqual((str(again), again.messages), (str(raised.exception), raised.exception.messages))

    def test_parameters(self):
        text = '<Houses>\n<Param name="wide" default="no" choices="yes no"/>\n<Place type="hiraya"/></Houses>\n'
        self.assertTrue([m for m in hsd.check(text, parameters={"narrow": 1})])
        self.assertEqual(hsd.check(text, parameters={"wide": True}), hsd.check(text))

    def test_parts(self):
        self.assertIn("senbon-gōshi", hsd.parts("格子"))
        self.assertNotIn("senbon-gōshi", hsd.parts("koshi-ita"))
        self.assertEqual(hsd.parts("no such part"), "")


class Town(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.town, self.work = self.folder / "t.hsd", self.folder / "work"
        (self.folder / "houses.geojson").write_text(json.dumps(squares(0, 300, 600)))
        self.town.write_text(TOWN)

    def test_three_steps_make_what_one_makes(self):
        tiles = hsd.town.plan(self.town, self.work, detail=[0])
        self.assertEqual([t.features for t in tiles], [1, 1, 1])
        self.assertEqual(tiles, hsd.town.planned(self.work))
        with self.assertRaises(hsd.town.StepError) as raised:
            hsd.town.seal(self.work, self.folder / "out")
        self.assertEqual((raised.exception.status, raised.exception.may_pass), (2, False))
        threads = [threading.Thread(target=hsd.town.tile, args=(self.work, one.key)) for one in [*tiles, tiles[0]]]
        for one in threads:
            one.start()
        for one in threads:
            one.join()
        sealed = hsd.town.seal(self.work, self.folder / "out")
        self.assertTrue(sealed.complete)
        self.assertEqual((sealed.report()["built"], len(sealed.decisions())), (3, 3))
        plain = [sys.executable, "-m", "hsd", "town", self.town, "-o", f"{self.folder}/once/", "--detail", "0", "--quiet"]
        subprocess.run(plain, check=True, stderr=subprocess.DEVNULL)
        self.assertEqual(files(self.folder / "out"), files(self.folder / "once"))

    def test_what_cannot_be_done_is_told(self):
        for step in (hsd.town.planned, lambda work: hsd.town.tile(work, "0_0")):
            with self.assertRaises(hsd.town.StepError) as raised:
                step(self.work)
            self.assertEqual(raised.exception.status, 2)
        key = hsd.town.plan(self.town, self.work, detail=[0])[0].key
        with self.assertRaisesRegex(hsd.town.StepError, "no such tile"):
            hsd.town.tile(self.work, ["no such tile"])
        for part in (self.work / "parts").glob(f"{key}-*.part"):
            part.write_bytes(b"")
        with self.assertRaisesRegex(hsd.town.StepError, key) as raised:
            hsd.town.tile(self.work, key)
        again = pickle.loads(pickle.dumps(raised.exception))
        self.assertEqual((again.status, str(again)), (1, str(raised.exception)))
        self.town.write_text(TOWN + "<!-- -->\n")
        with self.assertRaisesRegex(hsd.town.StepError, "changed"):
            hsd.town.tile(self.work, key)
        self.town.write_text(TOWN.replace("name=", "nome=", 1))
        with self.assertRaises(hsd.town.StepError) as raised:
            hsd.town.plan(self.town, self.work)
        self.assertEqual([m.line for m in raised.exception.messages if m.severity == "error"], [1])

    @unittest.skipUnless(importlib.util.find_spec("geopandas"), "geopandas is not installed")
    def test_frames_in_and_out(self):
        import geopandas

        ask = geopandas.GeoDataFrame.from_features(squares(0, 300)["features"])
        hsd.town.write({"houses": ask}, self.folder)
        tiles = hsd.town.plan(self.town, self.work, detail=[0])
        hsd.town.tile(self.work, [tile.key for tile in tiles])
        told = ask.merge(hsd.town.seal(self.work, self.folder / "out").frame(), on="key")
        self.assertEqual((list(told["type"]), len(told.geometry)), (["hiraya", "hiraya"], 2))
        self.assertTrue((told["width"] > 0).all())
        frames = {"houses": ask.to_arrow()} if hasattr(ask, "to_arrow") and importlib.util.find_spec("pyarrow") else {"houses": ask}
        self.assertEqual(len(hsd.town.show(TOWN, frames, detail=0).frame()), 2)

    def test_a_notebook_shows_one(self):
        town = hsd.town.show(TOWN, {"houses": squares(0)}, detail=0)
        self.assertEqual([(d["key"], d["type"]) for d in town.decisions], [("0", "hiraya")])
        self.assertEqual((town.glb[:4], town.text), (b"glTF", TOWN))
        with self.assertRaisesRegex(hsd.Error, "no name"):
            hsd.town.show(None, {"../houses": squares(0)})


class Process(unittest.TestCase):
    def test_other_threads_go_on(self):
        beats, stop = [], threading.Event()

        def beat():
            while not stop.wait(0.001):
                beats.append(time.monotonic())

        thread = threading.Thread(target=beat)
        thread.start()
        begun = time.monotonic()
        hsd.compile(MANY, detail=0)
        ended = time.monotonic()
        stop.set()
        thread.join()
        self.assertGreater(len([at for at in beats if begun < at < ended]), (ended - begun) * 10)

    @unittest.skipUnless(hasattr(signal, "setitimer"), "no such signals")
    def test_a_signal_ends_the_waiting(self):
        class Now(Exception):
            pass

        def raised(*_):
            raise Now

        before = signal.signal(signal.SIGALRM, raised)
        try:
            begun = time.monotonic()
            signal.setitimer(signal.ITIMER_REAL, 0.05)
            with self.assertRaises(Now):
                for _ in range(100):
                    hsd.compile(MANY, detail=1)
            self.assertLess(time.monotonic() - begun, 5)
        finally:
            signal.signal(signal.SIGALRM, before)

    @unittest.skipUnless("fork" in multiprocessing.get_all_start_methods(), "no fork")
    def test_a_process_that_is_forked(self):
        glb = hsd.compile(TEXT)
        with multiprocessing.get_context("fork").Pool(2) as pool:
            made = pool.map_async(hsd.compile, [TEXT, TEXT])
            self.assertEqual(made.get(timeout=60), [glb, glb])

    def test_the_program(self):
        program = pathlib.Path(sysconfig.get_path("scripts"), "hsd")
        for command in ([program], [sys.executable, "-m", "hsd"]):
            done = subprocess.run([*command, "-V"], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (0, f"hsd {hsd.__version__}\n"))
            done = subprocess.run([*command, "check", "--format", "short", "-"], input=WRONG, capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("HSD0301", done.stdout)
            self.assertEqual(subprocess.run([*command, "no-such-command"], capture_output=True).returncode, 2)


if __name__ == "__main__":
    unittest.main()

"""Tests of the example: `HSD=target/release/hsd python -m unittest discover -s examples/scale`. Needs dask and distributed."""

from __future__ import annotations

import functools
import importlib.util
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import rows
import scale
from trees import faults, tree

HERE = Path(__file__).resolve().parent
HSD = str(Path(os.environ.get("HSD", "hsd")).resolve()) if "/" in os.environ.get("HSD", "hsd") else "hsd"
HOUSES = int(os.environ.get("HSD_HOUSES", "1200"))


class Scale(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = Path(tempfile.mkdtemp())
        cls.town = rows.write(HOUSES, cls.base / "town", size=100)
        subprocess.run([HSD, "town", str(cls.town), "-o", f"{cls.base / 'plain'}/", "-q"], check=True)
        cls.wanted = tree(cls.base / "plain")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.base)

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(dir=self.base))
        self.out, self.work = self.folder / "out", self.folder / "out.work"

    def command(self, *more: str) -> list[str]:
        script = [sys.executable, str(HERE / "scale.py"), str(self.town), "-o", str(self.out)]
        return [*script, "--hsd", HSD, "--features", "150", *more]

    def scale(self, *more: str, check: bool = True) -> dict:
        figures = self.folder / "figures.json"
        subprocess.run(self.command("--figures", str(figures), *more), check=check, capture_output=True)
        return json.loads(figures.read_text())

    def assert_right(self):
        self.assertEqual(tree(self.out), self.wanted)
        self.assertEqual(faults(self.out), [])

    def test_one_worker_and_two_make_what_a_plain_run_makes(self):
        first = self.scale("--workers", "1")
        self.assert_right()
        self.assertEqual(first["failed"], [])
        shutil.rmtree(self.work)
        shutil.rmtree(self.out)
        second = self.scale("--workers", "2")
        self.assert_right()
        self.assertEqual(second["made"], first["made"])

    def test_a_worker_that_is_killed(self):
        from dask.distributed import Client, LocalCluster
        import dask

        dask.config.set(scale.SETTINGS)
        options = scale.arguments([str(self.town), "-o", str(self.out), "--hsd", HSD, "--features", "60"])
        with LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster:
            with Client(cluster) as client:
                killed = []

                def kill():
                    made = self.work / "made"
                    while not made.is_dir() or len(os.listdir(made)) < 2:
                        time.sleep(0.01)
                    killed.append(next(iter(client.run(os.getpid).values())))
                    os.kill(killed[0], signal.SIGKILL)

                killer = threading.Thread(target=kill)
                killer.start()
                run = scale.build(client, options)
                killer.join()
        self.assertEqual((len(killed), run.failed), (1, []))
        self.assert_right()

    def test_a_driver_that_is_killed_and_started_again(self):
        driver = subprocess.Popen(self.command(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        made = self.work / "made"
        while not made.is_dir() or len(os.listdir(made)) < 3:
            self.assertIsNone(driver.poll())
            time.sleep(0.01)
        driver.kill()
        driver.wait()
        self.assertFalse((self.out / "tileset.json").exists())
        told = self.scale("--planned")
        self.assertLess(told["made"], len(scale.tiles_of(self.work)))
        self.assert_right()

    def test_a_tile_that_is_made_twice_at_once(self):
        subprocess.run([HSD, "town", "plan", str(self.town), "-o", str(self.work), "-q"], check=True)
        keys = [tile["key"] for tile in scale.tiles_of(self.work)]
        both = [subprocess.Popen([HSD, "town", "tile", str(self.work), "-q", *keys]) for _ in range(2)]
        self.assertEqual([process.wait() for process in both], [0, 0])
        self.scale("--planned")
        self.assert_right()

    def test_a_full_disk_leaves_no_half_file(self):
        subprocess.run([HSD, "town", "plan", str(self.town), "-o", str(self.work), "-q"], check=True)
        # Files end at 16 KiB, which is less than a tile has.
        def full():
            resource.setrlimit(resource.RLIMIT_FSIZE, (16384, 16384))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

        made = subprocess.run(
            [HSD, "town", "tile", str(self.work), "--all"], capture_output=True, preexec_fn=full, restore_signals=False
        )
        self.assertEqual(made.returncode, 3, made.stderr)
        whole = {path.name: path.read_bytes() for path in (self.base / "plain" / "tiles").iterdir()}
        for path in (self.work / "tiles").iterdir():
            self.assertEqual(path.read_bytes(), whole[path.name], "half a file")
        self.scale("--planned")
        self.assert_right()

    @unittest.skipUnless(importlib.util.find_spec("hsd"), "the wheel of hsd is not installed")
    def test_the_module_does_what_the_program_does(self):
        from dask.distributed import Client, LocalCluster
        import dask
        import hsd as module

        dask.config.set(scale.SETTINGS)
        tiles = module.town.plan(self.town, self.work)
        with LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster:
            with Client(cluster) as client:
                make = functools.partial(module.town.tile, self.work, threads=1)
                client.gather(client.map(make, [tile.key for tile in tiles], pure=False))
                with self.assertRaisesRegex(module.town.StepError, "no such tile") as raised:
                    client.submit(make, "no such tile").result()
        self.assertFalse(raised.exception.may_pass)
        module.town.seal(self.work, self.out)
        self.assert_right()

    def test_only_what_a_change_touches_is_made_again(self):
        self.scale()
        town = self.folder / "town"
        shutil.copytree(self.town.parent, town)
        text = self.town.read_text()
        # One line, so that the lines of the rules stay: houses in the south-west are chu-nikai.
        change = text.replace('<choice weight="6">', '<choice weight="{if(x &lt; 100 and y &lt; 100, 0, 6)}">')
        (town / "rows.hsd").write_text(change)
        before, self.town = self.town, town / "rows.hsd"
        try:
            told = self.scale()
        finally:
            self.town = before
        self.assertGreater(told["made"], 0)
        self.assertLess(told["made"], told["there"])
        plain = self.folder / "plain"
        subprocess.run([HSD, "town", str(town / "rows.hsd"), "-o", f"{plain}/", "-q"], check=True)
        self.assertEqual(tree(self.out), tree(plain))


if __name__ == "__main__":
    unittest.main()

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
import upload
from trees import faults, tree

HERE = Path(__file__).resolve().parent
HSD = str(Path(os.environ.get("HSD", "hsd")).resolve()) if "/" in os.environ.get("HSD", "hsd") else "hsd"
HOUSES = int(os.environ.get("HSD_HOUSES", "1200"))


def reads_parquet() -> bool:
    said = subprocess.run([HSD, "--version"], capture_output=True, text=True).stdout
    return any(line.split() == ["GeoParquet:", "yes"] for line in said.splitlines())


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

    def test_a_poison_tile_takes_no_others_with_it(self):
        subprocess.run([HSD, "town", "plan", str(self.town), "-o", str(self.work), "-q"], check=True)
        bad = scale.tiles_of(self.work)[0]
        program = self.folder / "hsd"
        # It ends each process that is to make this tile.
        program.write_text(f'#!/bin/sh\ncase "$* " in *" {bad["key"]} "*) kill -SEGV $$ ;; esac\nexec {HSD} "$@"\n')
        program.chmod(0o755)
        told = self.scale("--planned", "--hsd", str(program), check=False)
        self.assertEqual(told["failed"], [bad["key"]])
        self.assertEqual(told["made"], len(scale.tiles_of(self.work)) - 1)
        self.assertFalse((self.out / "tileset.json").exists())
        self.scale("--planned", "--hsd", str(program), "--lacking")
        report = json.loads((self.out / "report.json").read_text())
        self.assertEqual((report["built"], report["features"]), (HOUSES - bad["features"], HOUSES))
        self.assertEqual(faults(self.out), [])

    def test_a_town_is_put_into_a_store_once(self):
        store = self.folder / "store"
        self.scale("--upload", f"file://{store}")
        self.assertEqual(tree(store), self.wanted)
        tile = next((store / "tiles").glob("*.glb"))
        tile.unlink()
        first = tile.parent.joinpath(sorted(path.name for path in tile.parent.iterdir())[0])
        first.write_bytes(b"who was first stays")
        counted = upload.upload(self.out, f"file://{store}")
        self.assertEqual((counted["put"], first.read_bytes()), (1, b"who was first stays"))
        memory = [upload.upload(self.out, "memory://town") for _ in range(2)]
        self.assertEqual((memory[0]["there"], memory[1]["put"]), (0, 0))

    @unittest.skipUnless(importlib.util.find_spec("pyarrow"), "pyarrow is not installed")
    @unittest.skipUnless(reads_parquet(), "this hsd is built without `--features geoparquet`")
    def test_geoparquet_in_row_groups_gives_the_same_town(self):
        import pyarrow.parquet

        town = rows.write(HOUSES, self.folder / "town", size=100, kind="parquet")
        self.assertEqual(pyarrow.parquet.ParquetFile(town.with_name("houses.parquet")).num_row_groups, -(-HOUSES // rows.ROW))
        before, self.town = self.town, town
        try:
            told = self.scale()
        finally:
            self.town = before
        self.assertEqual(told["failed"], [])
        # The hashes in names know the line of the rule, which is the same.
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

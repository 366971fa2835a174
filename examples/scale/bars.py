"""Measures what the example promises on a town of many houses:

    python bars.py [HOUSES] [--folder FOLDER] [--details 0]

A plain loop, one worker and two make the town; then two do so while workers are killed, while the driver is killed and started again,
after every tile was made twice at once, on a full disk (Linux, where a small one can be mounted), and after a change of the town.
Each result is compared with that of a plain run by its hash. Processor time is what counts, since clocks tell what else a machine
does. Prints a table; the exit status is 1 where a promise is not kept. 200,000 houses need 4 GB of disk and 16 minutes of a processor.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable

import rows
import scale
from trees import faults, tree

HERE = Path(__file__).resolve().parent
#: Metres of a tile with 1,000 houses of `rows.py`.
SIDE = 380
MIB = 1 << 20


@dataclass
class Used:
    """What a command took: clock and processor seconds with all that it started, and the largest process in bytes."""

    clock: float
    processor: float
    memory: int


def timed(command: list[Any], status: tuple[int, ...] = (0,)) -> Used:
    begun = time.monotonic()
    process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    said = process.stderr.read()
    _, ended, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(ended)
    if process.returncode not in status:
        sys.exit(f"{' '.join(map(str, command))} ended with {process.returncode}:\n{said[-2000:]}")
    return Used(time.monotonic() - begun, used.ru_utime + used.ru_stime, used.ru_maxrss * scale.UNIT)


@dataclass
class Bars:
    """The town, what a plain run makes of it, and what was measured."""

    hsd: str
    folder: Path
    houses: int
    details: str
    town: Path = field(init=False)
    wanted: str = field(init=False)
    lines: list[tuple[str, str, bool | None]] = field(default_factory=list)

    @property
    def out(self) -> Path:
        return self.folder / "out"

    @property
    def work(self) -> Path:
        return self.folder / "out.work"

    def say(self, what: str, found: str, kept: bool | None = None) -> None:
        self.lines.append((what, found, kept))
        mark = {True: "kept", False: "NOT KEPT", None: ""}[kept]
        print(f"| {what} | {found} | {mark} |", flush=True)

    def clear(self) -> None:
        for folder in (self.out, self.work):
            shutil.rmtree(folder, ignore_errors=True)

    def driver(self, *more: Any) -> list[Any]:
        return [sys.executable, HERE / "scale.py", self.town, "-o", self.out, "--hsd", self.hsd, *more]

    def engine(self, *more: Any) -> tuple[Used, dict[str, Any]]:
        """Runs the example; returns what it took and what it tells."""
        figures = self.folder / "figures.json"
        used = timed(self.driver("--figures", figures, *more))
        return used, json.loads(figures.read_text())

    def same(self, what: str, more: str = "", kept: bool = True) -> None:
        """Tells whether the result is that of a plain run, each tile in it once."""
        right, wrong = tree(self.out) == self.wanted, faults(self.out)
        word = "same tree" if right else "ANOTHER TREE"
        self.say(what, ", ".join(filter(None, [word, *wrong[:3], more])), right and not wrong and kept)

    # The measures.

    def plain(self) -> None:
        """A run of the program by itself."""
        self.town = rows.write(self.houses, self.folder / "town", size=SIDE, detail=self.details)
        used = timed([self.hsd, "town", self.town, "-o", f"{self.out}/", "-q"])
        self.wanted = tree(self.out)
        size = sum(path.stat().st_size for path in self.out.rglob("*") if path.is_file())
        report = json.loads((self.out / "report.json").read_text())
        tiles = len(list((self.out / "tiles").glob("*.glb")))
        self.say(
            "`hsd town`, all processors",
            f"{report['built']:,} of {self.houses:,} houses, {tiles} tiles, {size / 1e9:.2f} GB, {used.processor:.1f} s of a processor, "
            f"{used.clock:.1f} s by the clock, {used.memory / MIB:.0f} MiB",
            report["built"] == self.houses and not faults(self.out),
        )
        self.clear()

    def loop(self) -> Used:
        """The three steps by hand, a tile after another in one process."""
        plan = timed([self.hsd, "town", "plan", self.town, "-o", self.work, "-q"])
        tile = timed([self.hsd, "town", "tile", "-q", "--threads", "1", self.work, "--all"])
        seal = timed([self.hsd, "town", "seal", self.work, "-o", self.out, "-q"])
        told = f"plan {plan.processor:.1f} s, tiles {tile.processor:.1f} s, seal {seal.processor:.1f} s of a processor, {tile.memory / MIB:.0f} MiB"
        self.same("plain loop", told)
        self.clear()
        return Used(plan.clock + tile.clock + seal.clock, plan.processor + tile.processor + seal.processor, tile.memory)

    def workers(self, loop: Used) -> None:
        """One worker, then two; the folders of the last stay."""
        one, first = self.engine("--workers", 1)
        self.same("one worker", f"{one.processor:.1f} s of a processor, {one.clock:.1f} s by the clock, {first['tasks']} tasks")
        # Besides what the tasks take: the scheduler, the workers, the driver. The same run, so that both were disturbed alike.
        tasks = first["processor"]
        over = (one.processor - tasks) / tasks
        more = f"; all together {one.processor / loop.processor - 1:+.1%} against the plain loop"
        self.say("overhead of the engine, under 10 %", f"{over:.1%} of the processor time of the tasks{more}", over < 0.1)
        self.clear()
        two, second = self.engine("--workers", 2)
        self.same("two workers", f"{two.processor:.1f} s of a processor, {two.clock:.1f} s by the clock")
        gain = first["processor"] / second["workers"][0]
        clocks = first["seconds"]["tiles"] / second["seconds"]["tiles"]
        told = f"{gain:.2f} times by processor time (one worker's over the longer of two), {clocks:.2f} by the clock"
        self.say("a second worker, 1.7 times", told, gain >= 1.7)
        memory = (second["memory"] + second["own"]) / MIB
        self.say("memory of a worker, under 700 MiB", f"{memory:.0f} MiB: {second['memory'] / MIB:.0f} to make tiles, {second['own'] / MIB:.0f} of dask", memory < 700)

    def change(self) -> None:
        """A change of the town file, after a run whose work is there."""
        # The name of a file tells what is in it.
        names = lambda: {path.name for path in (self.out / "tiles").glob("*.glb")}
        before, town, wanted = names(), self.town, self.wanted
        text = town.read_text()
        rule = '<choice weight="{if(x &lt; 1000 and y &lt; 1000, 0, 6)}">'
        town.write_text(text.replace('<choice weight="6">', rule))
        _, told = self.engine("--workers", 2)
        touched, all_ = len(names() - before), len(names())
        again = self.folder / "again"
        timed([self.hsd, "town", town, "-o", f"{again}/", "-q"])
        self.wanted = tree(again)
        shutil.rmtree(again)
        right = told["made"] == touched and 0 < touched < all_
        self.same("a change in the south-west", f"{told['made']} tiles made, {touched} of {all_} are others than before", right)
        town.write_text(text)
        self.wanted = wanted
        self.clear()

    def tiles(self) -> dict[str, str]:
        return {tile["key"]: tile["inputs"] for tile in scale.tiles_of(self.work)}

    def made(self) -> int:
        made = self.work / "made"
        return len(os.listdir(made)) if made.is_dir() else 0

    def killed_workers(self) -> None:
        """Kills one worker after another while the tiles are made."""
        import psutil

        driver = subprocess.Popen([str(word) for word in self.driver("--workers", 2, "--features", 2000)], stderr=subprocess.DEVNULL)
        draw, kills, next_ = random.Random(5), 0, 0.1
        while driver.poll() is None:
            time.sleep(0.05)
            if not (self.work / "work.json").exists() or self.made() < next_ * len(self.tiles()):
                continue
            all_ = psutil.Process(driver.pid).children()
            workers = [p for p in all_ if "spawn_main" in " ".join(p.cmdline())]
            if workers:
                draw.choice(workers).kill()
                kills, next_ = kills + 1, next_ + 0.2
        self.same("workers killed", f"{kills} of them", driver.returncode == 0 and kills > 0)
        self.clear()

    def killed_driver(self) -> None:
        """Kills the driver three times and starts it again."""
        begun = []
        for share in (0.2, 0.4, 0.6):
            driver = subprocess.Popen([str(word) for word in self.driver("--workers", 2)], stderr=subprocess.DEVNULL)
            while not (self.work / "work.json").exists() or self.made() < share * len(self.tiles()):
                if driver.poll() is not None:
                    break
                time.sleep(0.05)
            driver.kill()
            driver.wait()
            begun.append(self.made())
        _, told = self.engine("--workers", 2)
        self.same("driver killed and started again", f"with {', '.join(map(str, begun))} of {len(self.tiles())} tiles made, {told['made']} left", told["made"] < len(self.tiles()))
        self.clear()

    def twice(self) -> None:
        """Two processes make every tile at the same time."""
        timed([self.hsd, "town", "plan", self.town, "-o", self.work, "-q"])
        command = [self.hsd, "town", "tile", "--threads", "1", str(self.work), "--all"]
        both = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(2)]
        words = [process.communicate()[0].split() for process in both]
        made, all_ = sum(w.count("made") for w in words), len(self.tiles())
        timed([self.hsd, "town", "seal", self.work, "-o", self.out, "-q"])
        told = f"{made} made, {sum(w.count('there') for w in words)} found there, of {all_} tiles"
        self.same("every tile made twice at once", told, all(p.returncode == 0 for p in both))
        self.clear()

    def full_disk(self) -> None:
        """Makes tiles on a disk that becomes full, then on a larger one."""
        unshare = ["unshare", "--mount"] + ([] if os.geteuid() == 0 else ["--map-root-user"])
        self.work.mkdir()
        probe = [*unshare, "mount", "-t", "tmpfs", "-o", "size=1m", "none", str(self.work)]
        if shutil.which("unshare") is None or subprocess.run(probe, capture_output=True).returncode:
            self.say("a full disk", "left out: no small disk can be mounted here")
            return
        size = max(self.houses * 3000 // MIB, 2)
        inside = [sys.executable, HERE / "bars.py", str(self.houses), "--full", self.town, "--folder", self.folder, "--hsd", self.hsd]
        script = f'mount -t tmpfs -o size={size}m none "$0" && exec "$@"'
        done = subprocess.run([str(w) for w in [*unshare, "sh", "-c", script, self.work, *inside]], stdout=subprocess.PIPE, text=True)
        told = json.loads(done.stdout or "{}")
        kept = told.get("status") == 3 and told.get("half") == []
        self.same("a full disk", f"{told.get('made')} tiles before status {told.get('status')}, half files: {told.get('half')}", kept)
        self.clear()


def full(bars: Bars, town: Path) -> None:
    """Is what `full_disk` starts where the small disk is mounted: fills it, looks for half files, makes it larger and goes on."""
    bars.town = town
    timed([bars.hsd, "town", "plan", town, "-o", bars.work, "-q"])
    command = [bars.hsd, "town", "tile", str(bars.work), "-q", "--all"]
    status = subprocess.run(command, capture_output=True).returncode
    made = bars.made()
    # A model says its own length.
    tiles = {path.name: path.read_bytes() for path in (bars.work / "tiles").glob("*.glb")}
    half = [name for name, tile in tiles.items() if int.from_bytes(tile[8:12], "little") != len(tile)]
    subprocess.run(["mount", "-o", "remount,size=90%", str(bars.work)], check=True)
    subprocess.run(command, check=True)
    timed([bars.hsd, "town", "seal", bars.work, "-o", bars.out, "-q"])
    print(json.dumps({"status": status, "made": made, "half": half}))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("houses", nargs="?", type=int, default=200_000)
    parser.add_argument("--folder", type=Path, help="put everything into this folder [a temporary one]")
    parser.add_argument("--details", default="0", help="levels of detail of the tiles [0]")
    parser.add_argument("--hsd", default=os.environ.get("HSD", "hsd"), help="the program [$HSD or hsd]")
    parser.add_argument("--only", nargs="+", help="measure these only, after the plain run")
    parser.add_argument("--full", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    hsd = str(Path(options.hsd).resolve()) if "/" in options.hsd else options.hsd
    folder = options.folder or Path(tempfile.mkdtemp(prefix="hsd-bars-"))
    bars = Bars(hsd, folder.resolve(), options.houses, options.details)
    if options.full:
        return full(bars, options.full)
    print("| what | found | promise |\n|---|---|---|", flush=True)
    bars.plain()
    state: dict[str, Used] = {}
    steps: dict[str, Callable[[], None]] = {
        "loop": lambda: state.update(loop=bars.loop()),
        "workers": lambda: bars.workers(state["loop"]),
        "change": bars.change,
        "killed-workers": bars.killed_workers,
        "killed-driver": bars.killed_driver,
        "twice": bars.twice,
        "full-disk": bars.full_disk,
    }
    for name, step in steps.items():
        if not options.only or name in options.only:
            step()
    if not options.folder:
        shutil.rmtree(folder)
    sys.exit(any(kept is False for _, _, kept in bars.lines))


if __name__ == "__main__":
    main()

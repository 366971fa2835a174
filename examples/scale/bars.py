"""Measures what the example promises on a town of many houses:

    python bars.py [HOUSES] [--folder FOLDER] [--details 0] [--share 0.3]

A plain loop, one worker and two make the town; then two do so while workers are killed, while the driver is killed and started again,
after tiles were made twice at once, on a full disk (Linux, where a small one can be mounted), and after a change of the town.
Each result is compared with that of the plain loop by its hash. Processor time is what counts, since clocks tell what else a machine
does. Prints a table; the exit status is 1 where a promise is not kept. 200,000 houses need 6 GB of disk and 20 minutes of a processor.

With `--folder` a run that was ended goes on with the measure at which it was. With `--share` the runs that are disturbed find all other
tiles of the loop in their work, so they take that share of its time; of the town they have all houses.
"""

from __future__ import annotations

import argparse
import filecmp
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
    share: float = 1
    town: Path = field(init=False)
    #: The hash of what the plain loop makes.
    wanted: str = ""
    #: The processor seconds of the plain loop.
    loop: float = 0
    #: The tiles that were there when a disturbed run began.
    there: int = 0
    lines: list[tuple[str, str, bool | None]] = field(default_factory=list)

    @property
    def out(self) -> Path:
        return self.folder / "out"

    @property
    def work(self) -> Path:
        return self.folder / "out.work"

    def go_on(self, name: str, step: Callable[[], None]) -> None:
        """Does a measure, unless a run before this one in the same folder has."""
        known = self.folder / f"{name}.json"
        if known.exists():
            told = json.loads(known.read_text())
            self.wanted, self.loop = told["wanted"], told["loop"]
            for line in told["lines"]:
                self.say(*line)
            return
        self.clear()
        before = len(self.lines)
        step()
        known.write_text(json.dumps({"wanted": self.wanted, "loop": self.loop, "lines": self.lines[before:]}))

    def say(self, what: str, found: str, kept: bool | None = None) -> None:
        self.lines.append((what, found, kept))
        mark = {True: "kept", False: "NOT KEPT", None: ""}[kept]
        print(f"| {what} | {found} | {mark} |", flush=True)

    @property
    def seed(self) -> Path:
        """The work of the plain loop."""
        return self.folder / "loop.work"

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
        """The three steps by hand, a tile after another in one process."""
        plan = timed([self.hsd, "town", "plan", self.town, "-o", self.seed, "-q"])
        tile = timed([self.hsd, "town", "tile", "-q", "--threads", "1", self.seed, "--all"])
        seal = timed([self.hsd, "town", "seal", self.seed, "-o", self.out, "-q"])
        self.wanted, self.loop = tree(self.out), plan.processor + tile.processor + seal.processor
        size = sum(path.stat().st_size for path in self.out.rglob("*") if path.is_file())
        report = json.loads((self.out / "report.json").read_text())
        self.say(
            "plain loop",
            f"{report['built']:,} of {self.houses:,} houses, {len(scale.tiles_of(self.seed))} tiles, {size / 1e9:.2f} GB; "
            f"plan {plan.processor:.1f} s, tiles {tile.processor:.1f} s, seal {seal.processor:.1f} s of a processor, "
            f"{plan.clock + tile.clock + seal.clock:.1f} s by the clock, {tile.memory / MIB:.0f} MiB",
            report["built"] == self.houses and not faults(self.out),
        )
        self.clear()

    def at_once(self) -> None:
        """A run of the program by itself."""
        used = timed([self.hsd, "town", self.town, "-o", f"{self.out}/", "-q"])
        told = f"{used.processor:.1f} s of a processor, {used.clock:.1f} s by the clock, {used.memory / MIB:.0f} MiB"
        self.same("`hsd town`, all processors", told)
        self.clear()

    def start(self) -> float:
        """Returns the processor seconds of a process for a tile that is there: what each task takes besides its tiles."""
        command = [self.hsd, "town", "tile", "-q", "--threads", "1", self.seed, next(iter(self.tiles(self.seed)))]
        return sorted(timed(command).processor for _ in range(9))[4]

    def one_worker(self) -> None:
        one, told = self.engine("--workers", 1)
        self.same("one worker", f"{one.processor:.1f} s of a processor, {one.clock:.1f} s by the clock, {told['tasks']} tasks")
        # What is no making of tiles: the scheduler, the worker, the driver, and the starts of the tasks' processes. Of the same run,
        # so that both were disturbed alike.
        start = self.start()
        tiles = told["processor"] - told["tasks"] * start
        others = one.processor - told["processor"] - told["processor_of"]["plan"] - told["processor_of"]["seal"]
        over = (others + told["tasks"] * start) / tiles
        self.say(
            "overhead of the engine, under 10 %",
            f"{over:.1%} of the processor time of the tiles: dask {others:.1f} s, {told['tasks']} starts of {start:.3f} s, beside {tiles:.1f} s; "
            f"all together {one.processor / self.loop - 1:+.1%} against the plain loop",
            over < 0.1,
        )
        memory = (told["memory"] + told["own"]) / MIB
        self.say("memory of a worker, under 700 MiB", f"{memory:.0f} MiB: {told['memory'] / MIB:.0f} to make tiles, {told['own'] / MIB:.0f} of dask", memory < 700)
        self.clear()

    def two_workers(self) -> None:
        two, told = self.engine("--workers", 2)
        self.same("two workers", f"{two.processor:.1f} s of a processor, {two.clock:.1f} s by the clock")
        # One worker would take what both took.
        gain = told["processor"] / told["workers"][0]
        self.say("a second worker, 1.7 times", f"{gain:.2f} times by processor time (that of both over that of the longer one)", gain >= 1.7)
        self.clear()

    def change(self) -> None:
        """A change of the town file, after a run whose work is there."""
        # The name of a file tells what is in it.
        names = lambda folder: {path.name for path in (folder / "tiles").glob("*.glb")}
        before, wanted = names(self.seed), self.wanted
        shutil.copytree(self.seed, self.work, copy_function=os.link)
        text = self.town.read_text()
        rule = '<choice weight="{if(x &lt; 1000 and y &lt; 1000, 0, 6)}">'
        self.town.write_text(text.replace('<choice weight="6">', rule))
        try:
            _, told = self.engine("--workers", 2)
            touched, all_ = len(names(self.out) - before), len(names(self.out))
            again = self.folder / "again"
            timed([self.hsd, "town", self.town, "-o", f"{again}/", "-q"])
        finally:
            self.town.write_text(text)
        self.wanted = tree(again)
        shutil.rmtree(again)
        right = told["made"] == touched and 0 < touched < all_
        self.same("a change in the south-west", f"{told['made']} tiles made, {touched} of {all_} are others than before", right)
        self.wanted = wanted
        self.clear()

    def tiles(self, work: Path | None = None) -> dict[str, str]:
        return {tile["key"]: tile["inputs"] for tile in scale.tiles_of(work or self.work)}

    def begin(self) -> int:
        """Puts the work of the loop back without the share that is to be made; returns the number of those tiles."""
        self.there = 0
        all_ = self.tiles(self.seed)
        if self.share >= 1:
            return len(all_)
        shutil.copytree(self.seed, self.work, copy_function=os.link)
        gone = random.Random(3).sample(sorted(all_), round(self.share * len(all_)))
        for key in gone:
            (self.work / "made" / f"{key}-{all_[key]}.json").unlink()
            for path in (self.work / "tiles").glob(f"{key}-*"):
                path.unlink()
        self.there = len(all_) - len(gone)
        return len(gone)

    def made(self) -> int:
        """Returns the number of tiles made since the work began."""
        made = self.work / "made"
        return len(os.listdir(made)) - self.there if made.is_dir() else 0

    def of_share(self, count: int) -> str:
        return f"{count} tiles to be made" + (f", {self.there} were there" if self.there else "")

    def killed_workers(self) -> None:
        """Kills one worker after another while the tiles are made."""
        import psutil

        left = self.begin()
        driver = subprocess.Popen([str(word) for word in self.driver("--workers", 2, "--features", 2000)], stderr=subprocess.DEVNULL)
        draw, kills = random.Random(5), 0
        while driver.poll() is None:
            time.sleep(0.05)
            if self.made() < (0.1 + 0.2 * kills) * left:
                continue
            all_ = psutil.Process(driver.pid).children()
            workers = [p for p in all_ if "spawn_main" in " ".join(p.cmdline())]
            if workers:
                draw.choice(workers).kill()
                kills += 1
        self.same("workers killed", f"{kills} of them, {self.of_share(left)}", driver.returncode == 0 and kills > 0)
        self.clear()

    def killed_driver(self) -> None:
        """Kills the driver three times and starts it again."""
        left, begun = self.begin(), []
        for share in (0.2, 0.4, 0.6):
            driver = subprocess.Popen([str(word) for word in self.driver("--workers", 2)], stderr=subprocess.DEVNULL)
            while self.made() < share * left and driver.poll() is None:
                time.sleep(0.05)
            driver.kill()
            driver.wait()
            begun.append(self.made())
        _, told = self.engine("--workers", 2)
        self.same(
            "driver killed and started again", f"with {', '.join(map(str, begun))} tiles made, {told['made']} left, of {self.of_share(left)}", told["made"] < left
        )
        self.clear()

    def twice(self) -> None:
        """Two processes make the same tiles at the same time."""
        left = self.begin()
        timed([self.hsd, "town", "plan", self.town, "-o", self.work, "-q"])
        command = [self.hsd, "town", "tile", "--threads", "1", str(self.work), "--all"]
        both = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(2)]
        words = [process.communicate()[0].split() for process in both]
        made, there = (sum(w.count(word) for w in words) for word in ("made", "there"))
        timed([self.hsd, "town", "seal", self.work, "-o", self.out, "-q"])
        told = f"{made} made, {there - 2 * self.there} found there, of {self.of_share(left)}"
        self.same("every tile made twice at once", told, all(p.returncode == 0 for p in both) and made > left)
        self.clear()

    def full_disk(self) -> None:
        """Makes tiles on a disk that becomes full, then on a larger one."""
        unshare = ["unshare", "--mount"] + ([] if os.geteuid() == 0 else ["--map-root-user"])
        left = self.begin()
        if not self.there:
            timed([self.hsd, "town", "plan", self.town, "-o", self.work, "-q"])
        there = size(self.work)
        room = (there + (size(self.seed) - there) * 2 // 5) // MIB
        waiting = self.folder / "waiting"
        self.work.rename(waiting)
        self.work.mkdir()
        inside = [sys.executable, HERE / "bars.py", "--full", waiting, "--folder", self.folder, "--hsd", self.hsd]
        script = f'mount -t tmpfs -o size={room}m none "$0" || exit 9; exec "$@"'
        done = subprocess.run([str(w) for w in [*unshare, "sh", "-c", script, self.work, *inside]], stdout=subprocess.PIPE, text=True)
        shutil.rmtree(waiting)
        if done.returncode == 9:
            self.say("a full disk", "left out: no small disk can be mounted here")
            return
        told = json.loads(done.stdout or "{}")
        kept = told.get("status") == 3 and told.get("half") == []
        made = told.get("made", 0) - self.there
        self.same("a full disk", f"{made} tiles before status {told.get('status')}, of {self.of_share(left)}; half files: {told.get('half')}", kept)
        self.clear()

    def full(self, waiting: Path) -> None:
        """Is what `full_disk` starts where the small disk is mounted: fills it, looks for half files, makes it larger and goes on."""
        shutil.copytree(waiting, self.work, dirs_exist_ok=True)
        command = [self.hsd, "town", "tile", "--threads", "2", str(self.work), "-q", "--all"]
        status = subprocess.run(command, capture_output=True).returncode
        made = self.made()
        # Whatever is there is what the loop has made.
        files = [path.relative_to(self.work) for path in self.work.rglob("*") if path.is_file()]
        half = [str(name) for name in files if not filecmp.cmp(self.work / name, self.seed / name, shallow=False)]
        subprocess.run(["mount", "-o", "remount,size=90%", str(self.work)], check=True)
        subprocess.run(command, check=True)
        timed([self.hsd, "town", "seal", self.work, "-o", self.out, "-q"])
        print(json.dumps({"status": status, "made": made, "half": half}))


def size(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("houses", nargs="?", type=int, default=200_000)
    parser.add_argument("--folder", type=Path, help="put everything into this folder, and go on with what is there [a temporary one]")
    parser.add_argument("--details", default="0", help="levels of detail of the tiles [0]")
    parser.add_argument("--share", type=float, default=1, help="the share of the tiles that disturbed runs make [1]")
    parser.add_argument("--hsd", default=os.environ.get("HSD", "hsd"), help="the program [$HSD or hsd]")
    parser.add_argument("--only", nargs="+", help="measure these only, after the plain loop")
    parser.add_argument("--full", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    hsd = str(Path(options.hsd).resolve()) if "/" in options.hsd else options.hsd
    folder = options.folder or Path(tempfile.mkdtemp(prefix="hsd-bars-"))
    bars = Bars(hsd, folder.resolve(), options.houses, options.details, options.share)
    if options.full:
        return bars.full(options.full)
    print("| what | found | promise |\n|---|---|---|", flush=True)
    bars.town = rows.write(options.houses, folder / "town", size=SIDE, detail=options.details)
    steps: dict[str, Callable[[], None]] = {
        "plain": bars.plain,
        "killed-workers": bars.killed_workers,
        "killed-driver": bars.killed_driver,
        "twice": bars.twice,
        "full-disk": bars.full_disk,
        "one-worker": bars.one_worker,
        "two-workers": bars.two_workers,
        "change": bars.change,
        "at-once": bars.at_once,
    }
    for name, step in steps.items():
        if name == "plain" or not options.only or name in options.only:
            bars.go_on(name, step)
    if not options.folder:
        shutil.rmtree(folder)
    sys.exit(any(kept is False for _, _, kept in bars.lines))


if __name__ == "__main__":
    main()

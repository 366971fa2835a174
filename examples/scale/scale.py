"""Builds a town on dask distributed: `python scale.py TOWN -o OUT`.

    python scale.py town.hsd -o out                                  two processes on this machine
    python scale.py town.hsd -o out --scheduler tcp://10.0.0.5:8786  workers that run already

`hsd town plan` divides the town here, workers run `hsd town tile` on some tiles at a time, `hsd town seal` puts it together here.
Whatever is killed on the way, the same command goes on. Workers see the folders of the town and of the work under the same paths
(NFS, EFS, a shared volume) and have `hsd`.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import time
from collections import defaultdict
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterator

from upload import upload

#: How often a task is tried again after its worker died or a file could not be written.
RETRIES = 5

#: What dask is told. A tile that kills its worker is no reason to give up on the other tiles of its task. What dask does besides
#: goes by the clock, and took a tenth of a processor beside one that makes tiles: it looks a hundred times a second where a worker is,
#: ten times how much memory it has, though tiles are made by other processes.
SETTINGS = {
    "distributed.scheduler.allowed-failures": 20,
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "2s",
    "distributed.admin.tick.limit": "1m",
    "distributed.admin.system-monitor.interval": "10s",
    "distributed.scheduler.active-memory-manager.start": False,
    "distributed.scheduler.work-stealing-interval": "2s",
    "distributed.worker.memory.target": False,
    "distributed.worker.memory.spill": False,
    "distributed.worker.memory.pause": False,
    "distributed.worker.memory.terminate": False,
}

#: The unit of memory in the figures of processes, bytes.
UNIT = 1 if sys.platform == "darwin" else 1024


class TryAgain(Exception):
    """A task failed in a way that may pass: a full disk, a killed process."""


def hsd(command: list[str], arguments: list[str], **more: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*command, "town", *arguments], text=True, check=False, **more)


def processor(whose: int) -> float:
    """The processor seconds of this process or of those that it waited for."""
    used = resource.getrusage(whose)
    return used.ru_utime + used.ru_stime


def make(command: list[str], work: str, keys: list[str]) -> dict[str, Any]:
    """Makes some tiles; runs on a worker. A process of its own, so that nothing a house does can end the worker."""
    begun, before = time.time(), processor(resource.RUSAGE_CHILDREN)
    done = hsd(command, ["tile", work, "--threads", "1", *keys], capture_output=True)
    if done.returncode not in (0, 1, 2):
        raise TryAgain(f"status {done.returncode}: {done.stderr.strip()[-500:]}")
    if done.returncode == 2:
        raise RuntimeError(done.stderr.strip())
    words = dict(line.split("\t") for line in done.stdout.splitlines())
    return {
        "words": words,
        "failed": [key for key in keys if key not in words],
        "why": done.stderr.strip(),
        "from": begun,
        "to": time.time(),
        "processor": processor(resource.RUSAGE_CHILDREN) - before,
        "memory": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * UNIT,
        "worker": os.getpid(),
        "own": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * UNIT,
    }


@dataclass
class Run:
    """What a run has come to."""

    made: int = 0
    kept: int = 0
    failed: list[str] = field(default_factory=list)
    tasks: list[dict[str, Any]] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=dict)
    processor_of: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def step(self, name: str) -> Iterator[None]:
        """Notes what a step takes, by the clock and of a processor in processes of the driver."""
        begun, before = time.time(), processor(resource.RUSAGE_CHILDREN)
        yield
        self.seconds[name] = time.time() - begun
        self.processor_of[name] = processor(resource.RUSAGE_CHILDREN) - before


def batches(tiles: list[dict[str, Any]], features: int) -> list[list[str]]:
    """Joins tiles to tasks of about so many features. The largest come first, so that no worker begins one last."""
    size = lambda tile: tile["features"] + 20
    found: list[list[str]] = []
    room = 0
    for tile in sorted(tiles, key=lambda tile: (-size(tile), tile["key"])):
        if not found or room < size(tile):
            found.append([])
            room = max(features, size(tile))
        found[-1].append(tile["key"])
        room -= size(tile)
    return found


def progress(done: int, all_: int, begun: float) -> None:
    rate = done / max(time.time() - begun, 1e-3)
    left = (all_ - done) / max(rate, 1e-3)
    end = "\n" if done == all_ else "\r"
    print(f"{done}/{all_} features, {rate:.0f}/s, {left:.0f} s left ", end=end, file=sys.stderr)


def tiles_of(work: Path) -> list[dict[str, Any]]:
    with open(work / "work.json", encoding="utf-8") as file:
        return json.load(file)["tiles"]


def make_all(client: Any, command: list[str], work: Path, features: int, run: Run, fresh: bool) -> None:
    """Makes the tiles that are missing; `fresh` has all of them looked at."""
    from dask.distributed import as_completed

    there = set() if fresh else set(os.listdir(work / "made"))
    tiles = [t for t in tiles_of(work) if f"{t['key']}-{t['inputs']}.json" not in there]
    count = {tile["key"]: tile["features"] for tile in tiles}
    begun, total, done = time.time(), sum(count.values()), 0
    inputs = {tile["key"]: tile["inputs"] for tile in tiles}

    def submit(keys: list[str], retries: int) -> Any:
        # The key of a task names what it makes, so a scheduler that has it already does not run it again.
        name = f"hsd-{keys[0]}-{inputs[keys[0]]}-{len(keys)}-{retries}-{time.time_ns() if fresh else 0}"
        return client.submit(make, command, str(work), keys, key=name, retries=retries, pure=False)

    keys_of = {}
    for keys in batches(tiles, features):
        keys_of[submit(keys, RETRIES)] = keys
    queue = as_completed(list(keys_of))
    for future in queue:
        keys = keys_of.pop(future)
        if future.status == "finished":
            task = future.result()
            run.tasks.append(task)
            run.made += sum(word == "made" for word in task["words"].values())
            run.kept += sum(word != "made" for word in task["words"].values())
            run.failed += task["failed"]
            if task["why"]:
                print(task["why"], file=sys.stderr)
        elif len(keys) > 1 and not isinstance(future.exception(), RuntimeError):
            # One of them ends its process each time: which one, each by itself will tell.
            for key in keys:
                single = submit([key], 1)
                keys_of[single] = [key]
                queue.add(single)
            continue
        else:
            print(f"{' '.join(keys)}: {future.exception()}", file=sys.stderr)
            run.failed += keys
        done += sum(count[key] for key in keys)
        progress(done, total, begun)


def build(client: Any, options: argparse.Namespace) -> Run:
    """Plans the town, has its tiles made and puts it together. Raises `SystemExit` with the status of what failed."""
    run, command, work = Run(), options.hsd, Path(options.work).resolve()
    with run.step("plan"):
        if not options.planned:
            planned = hsd(command, ["plan", options.town, "-o", str(work), "--quiet", *options.more])
            if planned.returncode:
                sys.exit(planned.returncode)
    with run.step("tiles"):
        make_all(client, command, work, options.features, run, fresh=False)
    if run.failed and not options.lacking:
        print(f"not put together, since tiles cannot be made (--lacking leaves them out): {' '.join(run.failed)}", file=sys.stderr)
        return run
    with run.step("seal"):
        lacking = ["--lacking"] if options.lacking else []
        seal = ["seal", str(work), "-o", options.output, *lacking]
        sealed = hsd(command, seal)
        if sealed.returncode == 2 and not run.failed:
            # An image or a file that rules read has changed since a tile was made: all are looked at again.
            make_all(client, command, work, options.features, run, fresh=True)
            sealed = hsd(command, seal)
    if sealed.returncode > 1:
        sys.exit(sealed.returncode)
    return run


def tell(run: Run, file: str | None) -> None:
    busy = sum(task["to"] - task["from"] for task in run.tasks)
    memory = max((task["memory"] for task in run.tasks), default=0)
    each: dict[int, float] = defaultdict(float)
    for task in run.tasks:
        each[task["worker"]] += task["processor"]
    told = {
        "made": run.made,
        "there": run.kept,
        "failed": run.failed,
        "seconds": {name: round(value, 2) for name, value in run.seconds.items()},
        "processor_of": {name: round(value, 2) for name, value in run.processor_of.items()},
        "tasks": len(run.tasks),
        "busy": round(busy, 2),
        "processor": round(sum(task["processor"] for task in run.tasks), 2),
        # Bytes, at most: of the processes that make tiles, and of those that start them.
        "memory": memory,
        "own": max((task["own"] for task in run.tasks), default=0),
        # Processor time of each worker's tasks: the longest one is what a run takes where processors are free.
        "workers": sorted((round(used, 2) for used in each.values()), reverse=True),
    }
    print(json.dumps(told), file=sys.stderr)
    if file:
        Path(file).write_text(json.dumps(told) + "\n")


def arguments(given: list[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("town", help="the town file")
    parser.add_argument("-o", "--output", required=True, help="the folder of the town")
    parser.add_argument("--work", help="the folder of the work, seen by all workers [OUT.work]")
    parser.add_argument("--scheduler", help="the address of a scheduler [a cluster of this machine]")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes on this machine")
    parser.add_argument("--features", type=int, default=4000, help="features of a task [4000]")
    parser.add_argument("--planned", action="store_true", help="go on with what is planned; no map is read")
    parser.add_argument("--lacking", action="store_true", help="leave out tiles that cannot be made")
    parser.add_argument("--hsd", nargs=1, default=[os.environ.get("HSD", "hsd")], help="the program [$HSD or hsd]")
    parser.add_argument("--upload", metavar="URL", help="put the town into a store that fsspec knows, what is not there yet")
    parser.add_argument("--figures", help="write times and memory to this file")
    parser.add_argument("more", nargs="*", help="after --: more for `hsd town plan`, such as --detail 0,1")
    options = parser.parse_args(given)
    options.work = options.work or f"{Path(options.output)}.work"
    return options


def main(given: list[str] | None = None) -> None:
    options = arguments(given)
    import dask
    from dask.distributed import Client, LocalCluster

    dask.config.set(SETTINGS)
    begun = time.time()
    if options.scheduler:
        with Client(options.scheduler) as client:
            run = build(client, options)
    else:
        local = {"n_workers": options.workers, "threads_per_worker": 1, "host": "127.0.0.1"}
        with LocalCluster(**local, dashboard_address=None) as cluster, Client(cluster) as client:
            started = time.time() - begun
            run = build(client, options)
            run.seconds["start"] = started
    if options.upload and (options.lacking or not run.failed):
        counted = upload(Path(options.output), options.upload)
        print(", ".join(f"{count} {word}" for word, count in counted.items()), file=sys.stderr)
    tell(run, options.figures)
    if run.failed and not options.lacking:
        sys.exit(1)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Many clouds on many cores and machines:

    python3 -m pcl_sq.batch MANIFEST --out DIR [--local N | --scheduler tcp://HOST:8786]
                            [-- OPTIONS OF pcl_sq_fit]

MANIFEST names one cloud a line; - is standard input. DIR gets shards/NNNNNNN.jsonl, a line of
JSON for each cloud as pcl_sq_fit --jsonl writes it (a model, or "error" with its sentence),
and summary.json. A shard is there whole or not at all; the same command again does what is
not there yet. Workers of a scheduler see the clouds and DIR under the same names.

Exit codes: 0 every cloud has a model, 1 some have none or the run was ended, 2 bad command
line."""
from __future__ import annotations

import argparse
import contextlib
import hashlib
import json
import os
import signal
import sys
import time
from collections import Counter
from typing import Any, Dict, Iterator, List, Optional, Tuple

from . import _core, _shards
from ._types import Error


def _untyped(module: Any) -> Any:
    """distributed has no types for what is used here."""
    return module


class Run:
    """The shards of a manifest and what is known of them."""

    def __init__(self, paths: List[str], folder: str, size: int, words: List[str]) -> None:
        self.shards = [paths[i:i + size] for i in range(0, len(paths), size)]
        self.folder = folder
        self.words = words
        self.clouds = len(paths)
        self.done: Dict[int, Tuple[int, int]] = {}  # shard: lines, errors
        text = json.dumps([paths, size, words])
        self.identity = hashlib.sha256(text.encode("utf-8", "surrogateescape")).hexdigest()

    def target(self, shard: int) -> str:
        """The file of a shard."""
        return os.path.join(self.folder, "shards", "%07d.jsonl" % shard)

    def begin(self) -> None:
        """Makes the folder, or finds what is done in it."""
        note = os.path.join(self.folder, "batch.json")
        try:
            os.makedirs(os.path.join(self.folder, "shards"), exist_ok=True)
        except OSError as error:
            raise Error("the folder '%s' cannot be made: %s." % (self.folder, error.strerror)
                        ) from None
        if os.path.exists(note):
            with contextlib.suppress(ValueError), open(note, encoding="utf-8") as known:
                if json.load(known).get("identity") == self.identity:
                    self._find_done()
                    return
            raise Error("'%s' holds the results of another manifest or other options; give "
                        "another --out." % self.folder)
        _core.write_file(note, (json.dumps({
            "identity": self.identity, "clouds": self.clouds, "shards": len(self.shards),
            "options": self.words, "generator": "pcl_sq " + _core.__version__},
            indent=2) + "\n").encode())

    def _find_done(self) -> None:
        for number, paths in enumerate(self.shards):
            with contextlib.suppress(FileNotFoundError, ValueError), \
                    open(self.target(number), encoding="utf-8") as file:
                lines = file.read().splitlines()
                if len(lines) == len(paths):
                    self.done[number] = len(lines), _shards.count_errors(lines)

    def waiting(self) -> Iterator[int]:
        """Shards that are not done."""
        return (n for n in range(len(self.shards)) if n not in self.done)

    def lines_done(self) -> int:
        """Number of clouds that have their line."""
        return sum(lines for lines, _ in self.done.values())


class Bar:
    """Progress on a terminal; silent elsewhere."""

    def __init__(self, run: Run, quiet: bool) -> None:
        self.run, self.start, self.before = run, time.monotonic(), run.lines_done()
        self.shown = not quiet and sys.stderr.isatty()

    def update(self) -> None:
        """Draws the bar anew."""
        if not self.shown:
            return
        done, all_ = self.run.lines_done(), max(1, self.run.clouds)
        rate = (done - self.before) / max(1e-9, time.monotonic() - self.start)
        left = (all_ - done) / rate if rate > 0 else 0.0
        sys.stderr.write("\r\033[K[%-30s] %d of %d clouds, %.1f/s, %d s left" % (
            "#" * (30 * done // all_), done, all_, rate, left))
        sys.stderr.flush()

    def close(self) -> None:
        """Takes the bar away."""
        if self.shown:
            sys.stderr.write("\r\033[K")


def fit_all(run: Run, client: Any, bar: Bar) -> None:
    """Hands the shards to the workers, some ahead of what they can do at once."""
    import distributed
    waiting = run.waiting()
    pending: Dict[Any, int] = {}
    queue: Any = _untyped(distributed).as_completed()

    def submit() -> bool:
        number = next(waiting, None)
        if number is None:
            return False
        future = client.submit(_shards.run_shard, run.shards[number], run.words,
                               run.target(number), pure=False)
        pending[future] = number
        queue.add(future)
        return True

    def keep_busy() -> None:
        cores = sum(client.ncores().values())
        while len(pending) < 2 * max(1, cores) + 2 and submit():
            pass

    keep_busy()
    while pending:
        future = next(queue)
        number = pending.pop(future)
        if future.status == "finished":
            run.done[number] = future.result()
        elif future.status == "error" and isinstance(future.exception(),
                                                         distributed.KilledWorker):
            run.done[number] = _one_by_one(run, number, client)
        elif future.status == "error":
            raise Error("a worker failed: %s" % future.exception())
        else:
            raise Error("the scheduler has lost what it was given; run the same command "
                        "again.")
        bar.update()
        keep_busy()


def _one_by_one(run: Run, number: int, client: Any) -> Tuple[int, int]:
    """A shard that has ended several workers: each of its clouds by itself."""
    from distributed import KilledWorker
    lines = []
    for path in run.shards[number]:
        future = client.submit(_shards.run_one, path, run.words, pure=False)
        try:
            lines.append(future.result())
        except KilledWorker:
            lines.append(_shards.error_line(
                path, "this cloud has ended every process that read it; it may need more "
                      "memory than a worker has."))
    return _shards.write_shard(run.target(number), lines)


def summary_of(run: Run, seconds: float, fitted_now: int, workers: int) -> Dict[str, Any]:
    """What was done, with the commonest sentences of what failed."""
    sentences: Counter[str] = Counter()
    failed = []
    for number, (_, errors) in sorted(run.done.items()):
        if errors == 0:
            continue
        with open(run.target(number), encoding="utf-8") as file:
            for line in file:
                record = json.loads(line)
                if "error" in record:
                    sentences[record["error"]] += 1
                    failed.append(record["input"]["path"])
    done = run.lines_done()
    return {"clouds": run.clouds, "done": done, "fitted": done - len(failed),
            "failed": len(failed), "failed_clouds": failed[:1000],
            "sentences": dict(sentences.most_common(50)), "done_now": fitted_now,
            "workers": workers, "seconds": round(seconds, 3),
            "clouds_per_second": round(fitted_now / seconds, 3) if seconds > 0 else None}


def read_manifest(path: str) -> List[str]:
    """The clouds that a manifest names, with their whole names."""
    try:
        with open(0 if path == "-" else path, encoding="utf-8",
                  errors="surrogateescape") as file:
            lines = [line.rstrip("\r\n") for line in file]
    except OSError as error:
        raise Error("the manifest '%s' cannot be read: %s." % (path, error.strerror)) from None
    paths = [os.path.abspath(line) for line in lines if line and not line.startswith("#")]
    if not paths:
        raise Error("the manifest names no cloud; write one file name a line into it.")
    return paths


@contextlib.contextmanager
def connected(arguments: argparse.Namespace) -> Iterator[Tuple[Any, int]]:
    """A client of the scheduler, and the number of its workers."""
    try:
        import dask
        import distributed as typed
    except ImportError:
        raise Error("Dask's scheduler is missing; install python3-distributed, or use "
                    "pcl_sq_fit --jsonl --shard.") from None
    distributed = _untyped(typed)
    # a worker that is killed comes back; a shard that kills them is looked at one by one
    dask.config.set({"distributed.scheduler.allowed-failures": 5,
                     "distributed.comm.timeouts.connect": "20s"})
    if arguments.scheduler:
        try:
            with distributed.Client(arguments.scheduler, timeout="20s") as client:
                client.wait_for_workers(1, timeout=60)
                yield client, len(client.ncores())
        except OSError:
            raise Error("no scheduler or no worker answers at %s; start them with "
                        "dask-scheduler and dask-worker." % arguments.scheduler) from None
        return
    workers = arguments.local or os.cpu_count() or 1
    with distributed.LocalCluster(n_workers=workers, threads_per_worker=1, processes=True,
                                  dashboard_address=None, memory_limit=0,
                                  silence_logs=50) as cluster, \
            distributed.Client(cluster) as client:
        yield client, workers


def parse(argv: Optional[List[str]]) -> argparse.Namespace:
    """The command line; what follows -- are options of pcl_sq_fit."""
    argv = list(sys.argv[1:] if argv is None else argv)
    words: List[str] = []
    if "--" in argv:
        words = argv[argv.index("--") + 1:]
        argv = argv[:argv.index("--")]
    parser = argparse.ArgumentParser(
        prog="python3 -m pcl_sq.batch", description="Models of many clouds, on many cores and "
        "machines; can be ended and gone on with.",
        epilog="What follows -- are options of pcl_sq_fit, such as --unit mm.")
    parser.add_argument("manifest", metavar="MANIFEST",
                        help="file that names one cloud a line; -: standard input")
    parser.add_argument("--out", required=True, metavar="DIR", help="folder of the results")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--scheduler", metavar="tcp://HOST:PORT", help="a running Dask scheduler")
    where.add_argument("--local", type=int, metavar="N",
                       help="so many processes on this machine; default: one per core")
    parser.add_argument("--shard-size", type=int, default=50, metavar="N",
                        help="clouds in a file (default: 50)")
    parser.add_argument("-q", "--quiet", action="store_true", help="no bar, no summary")
    arguments = parser.parse_args(argv)
    if arguments.shard_size < 1 or (arguments.local is not None and arguments.local < 1):
        parser.error("--shard-size and --local want a number above 0")
    arguments.words = words + ([] if any(w.startswith("--threads") for w in words) else
                               ["--threads=1"])
    return arguments


def main(argv: Optional[List[str]] = None) -> int:
    """The program. Returns its exit code."""
    arguments = parse(argv)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        from . import _files
        # refuse options before the work
        error = _check_words(_files, arguments.words)
        if error:
            print("pcl_sq.batch: " + error, file=sys.stderr)
            return 2
        run = Run(read_manifest(arguments.manifest), os.path.abspath(arguments.out),
                  arguments.shard_size, arguments.words)
        run.begin()
        before = run.lines_done()
        start = time.monotonic()
        workers = 0
        if len(run.done) < len(run.shards):
            with connected(arguments) as (client, workers):
                bar = Bar(run, arguments.quiet)
                start = time.monotonic()
                try:
                    fit_all(run, client, bar)
                finally:
                    bar.close()
        summary = summary_of(run, time.monotonic() - start, run.lines_done() - before, workers)
        _core.write_file(os.path.join(run.folder, "summary.json"),
                         (json.dumps(summary, indent=2) + "\n").encode())
    except Error as error:
        print("pcl_sq.batch: %s" % error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("pcl_sq.batch: ended; the same command again goes on with it.", file=sys.stderr)
        return 1
    if not arguments.quiet:
        print("%d clouds: %d models, %d without; %d of them now in %.1f s (%s a second)" % (
            summary["done"], summary["fitted"], summary["failed"], summary["done_now"],
            summary["seconds"], summary["clouds_per_second"]))
        for sentence, count in summary["sentences"].items():
            print("  %d: %s" % (count, sentence))
    return 1 if summary["failed"] else 0


def _check_words(files: Any, words: List[str]) -> str:
    """What is wrong with the options, or ""."""
    from ._types import OptionError
    try:
        files.fit_line(os.devnull, words)  # holds no cloud, which is an error of its line
    except OptionError as error:
        return str(error)
    return ""


if __name__ == "__main__":
    sys.exit(main())

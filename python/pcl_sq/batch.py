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
import json
import os
import signal
import sys
import time
from typing import Any, Dict, Iterator, List, Optional, Tuple

from . import _core, _shards
from ._run import Bar, Run, read_manifest, summary_of
from ._types import Error


def _untyped(module: Any) -> Any:
    """distributed has no types for what is used here."""
    return module


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
                     "distributed.comm.timeouts.connect": "20s",
                     # what watches the workers a hundred times a second costs a twelfth of a
                     # core, for tasks that take seconds
                     "distributed.worker.profile.interval": "10s",
                     "distributed.worker.profile.cycle": "60s",
                     "distributed.admin.tick.interval": "1s",
                     "distributed.admin.system-monitor.interval": "10s"})
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
                                  dashboard_address=":0", memory_limit=0,
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

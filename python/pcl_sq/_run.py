# SPDX-License-Identifier: BSD-3-Clause
"""What pcl_sq.batch knows of its clouds: shards, what of them is done, summary, bar."""
from __future__ import annotations

import contextlib
import hashlib
import json
import os
import sys
import time
from collections import Counter
from typing import Any, Dict, Iterator, List, Tuple

from . import _core, _shards
from ._types import Error


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

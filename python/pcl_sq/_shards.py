# SPDX-License-Identifier: BSD-3-Clause
"""What a worker of pcl_sq.batch does: some clouds, one line of JSON each, one file."""
from __future__ import annotations

import json
import os
from typing import List, Tuple


def error_line(path: str, sentence: str) -> str:
    """What stands in the place of a model."""
    return json.dumps({"input": {"path": path}, "error": sentence}, ensure_ascii=False)


def fit_lines(paths: List[str], words: List[str]) -> List[str]:
    """The lines of pcl_sq_fit --jsonl."""
    from . import _files
    return [str(_files.fit_line(path, words)[0]) for path in paths]


def write_shard(target: str, lines: List[str]) -> Tuple[int, int]:
    """Writes a shard whole or not at all. Returns the numbers of lines and of errors."""
    from . import _core
    _core.write_file(target, ("\n".join(lines) + "\n").encode())
    return len(lines), count_errors(lines)


def count_errors(lines: List[str]) -> int:
    """Number of lines without a model."""
    return sum('"error"' in line and "error" in json.loads(line) for line in lines)


def run_shard(paths: List[str], words: List[str], target: str) -> Tuple[int, int]:
    """Fits the clouds of a shard and writes its file, on whichever machine."""
    if os.path.exists(target):  # another worker was quicker
        with open(target, encoding="utf-8") as done:
            lines = done.read().splitlines()
        if len(lines) == len(paths):
            return len(lines), count_errors(lines)
    return write_shard(target, fit_lines(paths, words))


def run_one(path: str, words: List[str]) -> str:
    """A cloud by itself, after it or its neighbours have ended a worker."""
    return fit_lines([path], words)[0]

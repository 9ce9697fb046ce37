# SPDX-License-Identifier: BSD-3-Clause
"""Keywords as the programs' options, and the programs' sentences about them as keywords."""
from __future__ import annotations

import contextlib
import re
from typing import Any, Iterator, List, Mapping

import numpy as np

from ._types import Error, OptionError

#: options of the programs that name files to write or to read, or are for people
NOT_HERE = {"output", "mesh", "snapshot", "grasp_points", "config", "export", "html", "mask",
            "depth", "calib", "help", "version", "quiet", "jsonl"}


def text_of(value: Any) -> str:
    """A value as it stands on a command line."""
    if isinstance(value, str):
        return value
    if isinstance(value, float):
        return repr(value)
    if hasattr(value, "__len__") or hasattr(value, "tolist"):
        values = value.tolist() if hasattr(value, "tolist") else list(value)
        if not isinstance(values, list):
            return text_of(values)
        return ",".join(text_of(v) for v in values)
    return str(value)


def words_of(options: Mapping[str, Any]) -> List[str]:
    """['--remove-plane', '--roi=1,2,3,4'] of {'remove_plane': True, 'roi': (1, 2, 3, 4)}."""
    words = []
    for name, value in options.items():
        if name in NOT_HERE:
            raise OptionError(name + " is no option here: what it would write or read is an "
                              "argument or a method.")
        option = "--" + name.replace("_", "-")
        if value is None:
            continue
        if isinstance(value, (bool, np.bool_)):
            if value:
                words.append(option)
            elif name in ("taper", "refine"):
                words.append("--no-" + name)
        else:
            words.append(option + "=" + text_of(value))
    return words


def python_words(sentence: str) -> str:
    """--remove-plane of a program's sentence as remove_plane."""
    return re.sub(r"--([a-z][a-z-]*)", lambda found: found.group(1).replace("-", "_"),
                  sentence)


@contextlib.contextmanager
def in_python_words() -> Iterator[None]:
    """Names options in the sentences of exceptions as Python does."""
    try:
        yield
    except Error as error:
        raise type(error)(python_words(str(error))) from None

# SPDX-License-Identifier: BSD-3-Clause
from typing import List, Optional, Tuple

from ._types import Array

def read_cloud(path: bytes, words: List[str]) -> Tuple[Array, Optional[Array], Optional[Array],
                                                     List[str]]: ...
def fit_line(path: str, words: List[str]) -> Tuple[str, str]: ...

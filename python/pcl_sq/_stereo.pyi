# SPDX-License-Identifier: BSD-3-Clause
from typing import List, Optional, Tuple

from ._types import Array

class Frames:
    def __init__(self, following: bool) -> None: ...
    def estimate(self, left: Optional[Array], right: Optional[Array], depth: Optional[Array],
                 mask: Optional[Array], depth_scale: float, calibration: List[str],
                 words: List[str]) -> Tuple[str, Array, Optional[Array], List[int]]: ...

def estimate_scene(left: Optional[Array], right: Optional[Array], depth: Optional[Array],
                   labels: Optional[Array], depth_scale: float, calibration: List[str],
                   words: List[str]) -> Tuple[str, Array, Optional[Array], Array]: ...

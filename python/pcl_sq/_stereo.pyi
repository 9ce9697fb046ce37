# SPDX-License-Identifier: BSD-3-Clause
from typing import List, Optional, Tuple

from ._types import Array

def estimate(left: Optional[Array], right: Optional[Array], depth: Optional[Array],
             mask: Optional[Array], depth_scale: float, calibration: List[str],
             words: List[str]) -> Tuple[str, Array, Optional[Array], List[int], List[str]]: ...
def estimate_scene(left: Optional[Array], right: Optional[Array], depth: Optional[Array],
                   labels: Optional[Array], depth_scale: float, calibration: List[str],
                   words: List[str]) -> Tuple[str, Array, Optional[Array], Array]: ...

# SPDX-License-Identifier: BSD-3-Clause
from typing import Optional

import numpy as np
import numpy.typing as npt

from ._types import Array

def render(model: str, cloud: Optional[Array], colors: Optional[Array], view: str,
           up: Optional[Array], sensor: Optional[Array], width: int, height: int,
           opacity: float, title: str) -> npt.NDArray[np.uint8]: ...

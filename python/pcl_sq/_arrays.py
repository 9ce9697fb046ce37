# SPDX-License-Identifier: BSD-3-Clause
"""What users have for arrays, as plain ones."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._types import Array


def plain(values: Any, missing: float = 0) -> Array:
    """An array; what a masked array masks is missing, not what happens to stand there."""
    if isinstance(values, np.ma.MaskedArray):
        masked: Any = values  # numpy's own method has no types
        return np.asarray(masked.filled(missing))
    return np.asarray(values)


def array_of(image: Optional[npt.ArrayLike]) -> Optional[Array]:
    """None stays None."""
    return None if image is None else plain(image)


def points_of(points: Any) -> Array:
    """Points side by side, of fields x, y, z too, as ROS's read_points() has them; NaN where
    a masked array masks one of its coordinates."""
    if isinstance(points, np.ma.MaskedArray) and points.dtype.kind in "iu":
        points = points.astype(np.float64)  # whole numbers have no NaN
    names = getattr(getattr(points, "dtype", None), "names", None)
    if names is not None and {"x", "y", "z"} <= set(names):
        return np.stack([plain(points[name], np.nan) for name in "xyz"], axis=-1)
    return plain(points, np.nan)

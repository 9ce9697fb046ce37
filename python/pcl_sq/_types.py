# SPDX-License-Identifier: BSD-3-Clause
"""What the functions give and raise."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Dict, List, NamedTuple, Optional

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]


class Error(RuntimeError):
    """The data give no result; the sentence says what to do."""


class OptionError(Error, ValueError):
    """An option is out of range, or contradicts another one."""


class Mesh(NamedTuple):
    """Triangles, counter-clockwise seen from outside."""

    vertices: npt.NDArray[np.float64]  #: N x 3 [m]
    triangles: npt.NDArray[np.uint32]  #: M x 3, indices into vertices


class Cloud(NamedTuple):
    """A point cloud: N x 3, or H x W x 3 for an image of points; NaN where there is none."""

    points: Array  #: [m]
    colors: Optional[npt.NDArray[np.uint8]]  #: red, green, blue, in the points' shape
    viewpoint: Optional[npt.NDArray[np.float64]]  #: the camera's place [m], where known
    notes: List[str]  #: what the reader assumed


@dataclass
class Fit:
    """One superquadric through points."""

    superquadric: Any
    termination: str
    points: int  #: finite points used
    iterations: int
    rms_distance: float  #: [m]
    sigma: float  #: estimated noise of the points [m]
    outlier_share: float  #: estimated share of points that belong elsewhere
    covariance: npt.NDArray[np.float64]  #: 11 x 11: t, rotation, ln a, e1, e2


@dataclass
class Contact:
    """Where a finger touches."""

    position: npt.NDArray[np.float64]  #: [m]
    normal: npt.NDArray[np.float64]  #: outward
    part: int
    observed: float  #: 1: beside a measured point, 0: on the far side


@dataclass
class Grasp:
    """A pose of a hand and its contacts."""

    position: npt.NDArray[np.float64]  #: tool centre point [m]
    rotation: npt.NDArray[np.float64]  #: columns: across the fingers, closing, approach
    width: float  #: distance of the pads when closed [m]
    open_width: float  #: while the hand approaches [m]
    contacts: List[Contact]
    scores: Dict[str, float]  #: each in [0, 1]; "total" ranks
    epsilon: float  #: Ferrari and Canny's measure
    raw: Dict[str, Any] = field(repr=False)  #: as it stands in the file of pcl_sq_grasp
    thing: Optional[int] = None  #: number of the thing in its scene, from 1 on

    @property
    def approach(self) -> npt.NDArray[np.float64]:
        """Direction in which the hand moves towards the object."""
        return np.asarray(self.rotation[:, 2], dtype=np.float64)

    @property
    def closing(self) -> npt.NDArray[np.float64]:
        """Direction of the line between two jaws."""
        return np.asarray(self.rotation[:, 1], dtype=np.float64)

    @property
    def pose(self) -> npt.NDArray[np.float64]:
        """The hand's 4 x 4 matrix in the cloud's frame."""
        matrix = np.eye(4)
        matrix[:3, :3] = self.rotation
        matrix[:3, 3] = self.position
        return matrix

    @classmethod
    def from_json(cls, raw: Dict[str, Any]) -> "Grasp":
        """A grasp of a file of pcl_sq_grasp."""
        contacts = [Contact(np.array(c["position"]), np.array(c["normal"]), int(c["part"]),
                            float(c["observed"])) for c in raw["contacts"]]
        return cls(np.array(raw["position"]), np.array(raw["rotation"]), float(raw["width"]),
                   float(raw["open_width"]), contacts, dict(raw["scores"]),
                   float(raw["epsilon"]), raw)

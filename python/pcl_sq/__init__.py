# SPDX-License-Identifier: BSD-3-Clause
"""Superquadric surface estimation: point clouds, depth images and stereo pairs in; unions of
superquadrics, meshes and grasps out. Lengths are metres, arrays are numpy's.

    model = pcl_sq.estimate(points)
    model.distance(points), model.mesh(), model.plan_grasps(), model.show()
"""
from __future__ import annotations

import os
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._core import MultiSuperquadric, Superquadric, __version__
from . import _core
from ._arrays import array_of, points_of
from ._images import (DepthSequence, StereoSequence, estimate_depth, estimate_scene_depth,
                      estimate_scene_stereo, estimate_stereo)
from ._model import Model, PathLike
from ._options import in_python_words, words_of
from ._scene import Scene, Thing
from ._types import Array, Cloud, Contact, Error, Fit, Grasp, Mesh, OptionError

__all__ = ["Cloud", "Contact", "DepthSequence", "Error", "Fit", "Grasp", "Mesh", "Model",
           "MultiSuperquadric", "OptionError", "Scene", "StereoSequence", "Superquadric",
           "Thing", "__version__", "estimate",
           "estimate_depth", "estimate_scene", "estimate_scene_depth", "estimate_scene_stereo",
           "estimate_stereo", "fit_superquadric", "load", "load_scene", "read_cloud"]

_UNITS = {"mm": 1e-3, "cm": 1e-2, "in": 0.0254}


def estimate(points: npt.ArrayLike, *, colors: Optional[npt.ArrayLike] = None,
             mask: Optional[npt.ArrayLike] = None, roi: Optional[Sequence[int]] = None,
             box: Optional[Sequence[float]] = None, remove_plane: bool = False,
             parts: int = 0, taper: Optional[bool] = None, unit: str = "m",
             intrinsics: Optional[Sequence[float]] = None,
             viewpoint: Optional[npt.ArrayLike] = None,
             table: Optional[npt.ArrayLike] = None,
             up: Union[str, npt.ArrayLike, None] = None, frame: str = "", threads: int = 0,
             **options: Any) -> Model:
    """A union of superquadrics for the object in a point cloud.

    points: N x 3, or H x W x 3 for an image of points, NaN or 0 0 0 where there is none; also
    an array of the fields x, y, z. What a masked array masks is missing. mask: H x W, the
    object's pixels. roi: x, y, width, height in the image [px]. box: two corners [m].
    remove_plane: the largest thing on a plane. parts: their number, 0: found.
    viewpoint, table (n, d), up: what is known of the frame. Further options are those of
    pcl_sq_fit with underscores: max_parts, preset, decomposition, fit, ...

    Raises pcl_sq.Error with a sentence if the points give no model, OptionError for options
    that make no sense."""
    array = points_of(points)
    words = words_of(dict(options, roi=roi, box=box, remove_plane=remove_plane,
                          parts=parts or None, taper=taper,
                          unit=None if unit == "m" else unit, intrinsics=intrinsics,
                          viewpoint=viewpoint, table=table, up=up, threads=threads or None))
    with in_python_words():
        file, indices = _core.estimate(array, array_of(colors), array_of(mask), frame,
                                       words)
    scale = _UNITS.get(unit)
    return Model(file, array if scale is None else array * scale,
                 None if colors is None else np.asarray(colors, np.uint8), indices)


def estimate_scene(points: npt.ArrayLike, *, colors: Optional[npt.ArrayLike] = None,
                   labels: Optional[npt.ArrayLike] = None, unit: str = "m", frame: str = "",
                   **options: Any) -> Scene:
    """All things on a table, each a model, from an image of points.

    points: H x W x 3, NaN or 0 0 0 where there is none. labels: H x W whole numbers, things
    told apart elsewhere, such as by a neural network: 0 nothing, another number for each
    thing. Options are those of pcl_sq_scene with underscores: min_pixels, max_parts, taper,
    intrinsics, viewpoint, table, up, threads."""
    array = points_of(points)
    with in_python_words():
        file, numbers = _core.estimate_scene(
            array, array_of(colors), array_of(labels), frame,
            words_of(dict(options, unit=None if unit == "m" else unit)))
    scale = _UNITS.get(unit)
    return Scene(file, array if scale is None else array * scale,
                 None if colors is None else np.asarray(colors, np.uint8), numbers)


def fit_superquadric(points: npt.ArrayLike, *, initial: Optional[Superquadric] = None,
                     taper: bool = False, noise: float = 0.0, robust: bool = True,
                     max_outlier_share: float = 0.6, min_epsilon: float = 0.05,
                     max_epsilon: float = 2.0) -> Fit:
    """One superquadric through points from all round, all eleven parameters.

    Points at an even distance in memory, float32 or float64, are used where they are.
    taper: where the points demand one. noise: of the points [m], 0: estimated."""
    try:
        found = _core.fit_superquadric(points_of(points), initial, taper, noise, robust,
                                       max_outlier_share, min_epsilon, max_epsilon)
    except ValueError as error:
        raise OptionError(str(error)) from None
    if not found.pop("ok"):
        raise Error({"TOO_FEW_POINTS": "there are too few finite points for a superquadric; "
                                       "give at least eleven.",
                     "DEGENERATE": "the points lie in one place, on a line or in a plane, so "
                                   "no body can be told; give points from several sides."}
                    .get(found["termination"],
                         "the points allow no fit (" + found["termination"] + ")."))
    return Fit(**found)


def read_cloud(path: PathLike, *, unit: str = "m", samples: Optional[int] = None) -> Cloud:
    """Reads PCD, PLY, OBJ, STL or text as the programs do; surfaces are sampled."""
    from . import _files
    with in_python_words():
        return Cloud(*_files.read_cloud(os.fsencode(path), words_of(
            {"unit": None if unit == "m" else unit, "samples": samples})))


def load(path: PathLike) -> Model:
    """Reads a model file."""
    return Model.load(path)


def load_scene(path: PathLike) -> Scene:
    """Reads a scene file."""
    return Scene.load(path)

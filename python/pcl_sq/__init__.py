# SPDX-License-Identifier: BSD-3-Clause
"""Superquadric surface estimation: point clouds, depth images and stereo pairs in; unions of
superquadrics, meshes and grasps out. Lengths are metres, arrays are numpy's.

    model = pcl_sq.estimate(points)
    model.distance(points), model.mesh(), model.plan_grasps(), model.show()
"""
from __future__ import annotations

import os
from typing import Any, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._core import MultiSuperquadric, Superquadric, __version__
from . import _core
from ._model import Model, PathLike
from ._options import in_python_words, words_of
from ._scene import Scene, Thing
from ._types import Array, Cloud, Contact, Error, Fit, Grasp, Mesh, OptionError

__all__ = ["Cloud", "Contact", "Error", "Fit", "Grasp", "Mesh", "Model", "MultiSuperquadric",
           "OptionError", "Scene", "Superquadric", "Thing", "__version__", "estimate",
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

    points: N x 3, or H x W x 3 for an image of points, NaN or 0 0 0 where there is none.
    mask: H x W, the object's pixels. roi: x, y, width, height in the image [px]. box: two
    corners [m]. remove_plane: the largest thing on a plane. parts: their number, 0: found.
    viewpoint, table (n, d), up: what is known of the frame. Further options are those of
    pcl_sq_fit with underscores: max_parts, preset, decomposition, fit, ...

    Raises pcl_sq.Error with a sentence if the points give no model, OptionError for options
    that make no sense."""
    array = np.asarray(points)
    words = words_of(dict(options, roi=roi, box=box, remove_plane=remove_plane,
                          parts=parts or None, taper=taper,
                          unit=None if unit == "m" else unit, intrinsics=intrinsics,
                          viewpoint=viewpoint, table=table, up=up, threads=threads or None))
    with in_python_words():
        file, indices = _core.estimate(array, None if colors is None else np.asarray(colors),
                                       None if mask is None else np.asarray(mask), frame,
                                       words)
    scale = _UNITS.get(unit)
    return Model(file, array if scale is None else array * scale,
                 None if colors is None else np.asarray(colors, np.uint8), indices)


def _array(image: Optional[npt.ArrayLike]) -> Optional[Array]:
    return None if image is None else np.asarray(image)


def _stereo_module() -> Any:
    try:
        from . import _stereo
    except ModuleNotFoundError as error:
        raise Error("this pcl_sq was built without stereo; build it with "
                    "PCL_SQ_BUILD_STEREO=ON.") from error
    return _stereo


def _files_of(calibration: Union[PathLike, Sequence[PathLike], None]) -> List[str]:
    if calibration is None:
        return []
    if isinstance(calibration, (str, os.PathLike)):
        return [os.fspath(calibration)]
    return [os.fspath(path) for path in calibration]


def _steps(depth: npt.ArrayLike,
           depth_scale: Optional[float]) -> Tuple[npt.NDArray[Any], float]:
    array = np.asarray(depth)
    if depth_scale is None:
        return array, 0.0
    if not 0 < depth_scale <= 1000:
        raise OptionError("depth_scale is %r, but the length of one step [m] is above 0 and up "
                          "to 1000." % depth_scale)
    # whole numbers of other kinds than a 16-bit image has: exact as floats below 2^24
    rare = array.dtype.kind in "iu" and array.dtype not in (np.uint8, np.uint16)
    return array.astype(np.float32) if rare else array, float(depth_scale)


def _from_images(left: Optional[npt.ArrayLike], right: Optional[npt.ArrayLike],
                 depth: Optional[npt.ArrayLike], mask: Optional[npt.ArrayLike],
                 calibration: Sequence[str], options: Any, depth_scale: float = 0.0) -> Model:
    stereo = _stereo_module()
    with in_python_words():
        text, cloud, colors, indices, notes = stereo.estimate(
            _array(left), _array(right), _array(depth), _array(mask), depth_scale,
            list(calibration), words_of(options))
    model = Model(_core.ModelFile.from_json(text), cloud, colors,
                  np.asarray(indices, np.int64))
    return model


def estimate_depth(depth: npt.ArrayLike, intrinsics: Sequence[float], *,
                   color: Optional[npt.ArrayLike] = None,
                   mask: Optional[npt.ArrayLike] = None, depth_scale: Optional[float] = None,
                   **options: Any) -> Model:
    """A union of superquadrics for the object in a depth image.

    depth: H x W, uint16 in millimetres or floats in metres, unless depth_scale says the length
    of a step. intrinsics: fx, fy, cx, cy [px]. color: H x W x 3 RGB or H x W. mask: H x W.
    Hints and further options are those of pcl_sq_stereo: roi, click, color of the object as
    color_hint, segment, parts, ..."""
    if "color_hint" in options:
        options["color"] = options.pop("color_hint")
    steps, scale = _steps(depth, depth_scale)
    return _from_images(color, None, steps, mask, [], dict(options, intrinsics=intrinsics),
                        scale)


def estimate_stereo(left: npt.ArrayLike, right: npt.ArrayLike,
                    calibration: Union[PathLike, Sequence[PathLike], None] = None, *,
                    mask: Optional[npt.ArrayLike] = None, **options: Any) -> Model:
    """A union of superquadrics for the object in a stereo pair.

    left, right: H x W x 3 RGB or H x W, of bytes or deeper. calibration: one file or two
    (OpenCV, ROS, Kalibr, ZED, Middlebury); or the options intrinsics and baseline. Hints and
    further options are those of pcl_sq_stereo: roi, click, matcher, parts, ..."""
    if "color_hint" in options:
        options["color"] = options.pop("color_hint")
    return _from_images(left, right, None, mask, _files_of(calibration), options)


def estimate_scene(points: npt.ArrayLike, *, colors: Optional[npt.ArrayLike] = None,
                   labels: Optional[npt.ArrayLike] = None, unit: str = "m", frame: str = "",
                   **options: Any) -> Scene:
    """All things on a table, each a model, from an image of points.

    points: H x W x 3, NaN or 0 0 0 where there is none. labels: H x W whole numbers, things
    told apart elsewhere, such as by a neural network: 0 nothing, another number for each
    thing. Options are those of pcl_sq_scene with underscores: min_pixels, max_parts, taper,
    intrinsics, viewpoint, table, up, threads."""
    array = np.asarray(points)
    with in_python_words():
        file, numbers = _core.estimate_scene(
            array, _array(colors), _array(labels), frame,
            words_of(dict(options, unit=None if unit == "m" else unit)))
    scale = _UNITS.get(unit)
    return Scene(file, array if scale is None else array * scale,
                 None if colors is None else np.asarray(colors, np.uint8), numbers)


def _scene_from_images(left: Optional[npt.ArrayLike], right: Optional[npt.ArrayLike],
                       depth: Optional[npt.ArrayLike], labels: Optional[npt.ArrayLike],
                       calibration: List[str], options: Any,
                       depth_scale: float = 0.0) -> Scene:
    stereo = _stereo_module()
    with in_python_words():
        text, cloud, colors, numbers = stereo.estimate_scene(
            _array(left), _array(right), _array(depth), _array(labels), depth_scale,
            calibration, words_of(options))
    return Scene(_core.SceneFile.from_json(text), cloud, colors, numbers)


def estimate_scene_depth(depth: npt.ArrayLike, intrinsics: Sequence[float], *,
                         color: Optional[npt.ArrayLike] = None,
                         labels: Optional[npt.ArrayLike] = None,
                         depth_scale: Optional[float] = None, **options: Any) -> Scene:
    """All things in a depth image; arguments as of estimate_depth() and estimate_scene()."""
    steps, scale = _steps(depth, depth_scale)
    return _scene_from_images(color, None, steps, labels, [],
                              dict(options, intrinsics=intrinsics), scale)


def estimate_scene_stereo(left: npt.ArrayLike, right: npt.ArrayLike,
                          calibration: Union[PathLike, Sequence[PathLike], None] = None, *,
                          labels: Optional[npt.ArrayLike] = None, **options: Any) -> Scene:
    """All things in a stereo pair; arguments as of estimate_stereo() and estimate_scene()."""
    return _scene_from_images(left, right, None, labels, _files_of(calibration), options)


def fit_superquadric(points: npt.ArrayLike, *, initial: Optional[Superquadric] = None,
                     taper: bool = False, noise: float = 0.0, robust: bool = True,
                     max_outlier_share: float = 0.6, min_epsilon: float = 0.05,
                     max_epsilon: float = 2.0) -> Fit:
    """One superquadric through points from all round, all eleven parameters.

    Points at an even distance in memory, float32 or float64, are used where they are.
    taper: where the points demand one. noise: of the points [m], 0: estimated."""
    try:
        found = _core.fit_superquadric(np.asarray(points), initial, taper, noise, robust,
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
        return Cloud(*_files.read_cloud(os.fspath(path), words_of(
            {"unit": None if unit == "m" else unit, "samples": samples})))


def load(path: PathLike) -> Model:
    """Reads a model file."""
    return Model.load(path)


def load_scene(path: PathLike) -> Scene:
    """Reads a scene file."""
    return Scene.load(path)

# SPDX-License-Identifier: BSD-3-Clause
"""Models and scenes of stereo pairs and depth images; OpenCV is loaded by the first call."""
from __future__ import annotations

import os
from typing import Any, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import array_of, plain
from ._model import Model, PathLike
from ._options import in_python_words, words_of
from ._scene import Scene
from ._types import Array, Error, OptionError


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
    array = plain(depth)
    if depth_scale is None:
        return array, 0.0
    if not 0 < depth_scale <= 1000:
        raise OptionError("depth_scale is %r, but the length of one step [m] is above 0 and up "
                          "to 1000." % depth_scale)
    # whole numbers of other kinds than a 16-bit image has: exact as floats below 2^24
    rare = array.dtype.kind in "iu" and array.dtype not in (np.uint8, np.uint16)
    return array.astype(np.float32) if rare else array, float(depth_scale)


class _Frames:
    """Models of images, frame by frame or each for itself."""

    def __init__(self, calibration: Sequence[str], options: Any, following: bool) -> None:
        if "color_hint" in options:
            options["color"] = options.pop("color_hint")
        self._calibration, self._words = list(calibration), words_of(options)
        self._frames = _stereo_module().Frames(following)

    def _model(self, left: Optional[npt.ArrayLike], right: Optional[npt.ArrayLike],
               depth: Optional[npt.ArrayLike], mask: Optional[npt.ArrayLike],
               depth_scale: float = 0.0) -> Model:
        with in_python_words():
            text, cloud, colors, indices = self._frames.estimate(
                array_of(left), array_of(right), array_of(depth), array_of(mask), depth_scale,
                self._calibration, self._words)
        return Model(_core.ModelFile.from_json(text), cloud, colors,
                     np.asarray(indices, np.int64))


class StereoSequence(_Frames):
    """Frames of one stereo camera, each a moment after the last one::

        frames = pcl_sq.StereoSequence("calib.yml", roi=(410, 250, 180, 260))
        for left, right in camera:
            model = frames.process(left, right)

    Much less is matched than for single pairs: the surroundings of the last outline, over the
    last depths. Arguments are those of estimate_stereo(); a hint is for the first frame. As
    pcl_sq_stereo --sequence."""

    def __init__(self, calibration: Union[PathLike, Sequence[PathLike], None] = None,
                 **options: Any) -> None:
        super().__init__(_files_of(calibration), options, True)

    def process(self, left: npt.ArrayLike, right: npt.ArrayLike, *,
                mask: Optional[npt.ArrayLike] = None) -> Model:
        """The model of the next frame; pcl_sq.Error where it shows none, or has another size
        than the first one."""
        return self._model(left, right, None, mask)


class DepthSequence(_Frames):
    """Frames of one depth camera, each a moment after the last one: the outline starts from
    the last one. Arguments are those of estimate_depth()."""

    def __init__(self, intrinsics: Sequence[float], *, depth_scale: Optional[float] = None,
                 **options: Any) -> None:
        super().__init__([], dict(options, intrinsics=intrinsics), True)
        self._depth_scale = depth_scale

    def process(self, depth: npt.ArrayLike, *, color: Optional[npt.ArrayLike] = None,
                mask: Optional[npt.ArrayLike] = None) -> Model:
        """The model of the next frame; pcl_sq.Error where it shows none, or has another size
        than the first one."""
        steps, scale = _steps(depth, self._depth_scale)
        return self._model(color, None, steps, mask, scale)


def estimate_depth(depth: npt.ArrayLike, intrinsics: Sequence[float], *,
                   color: Optional[npt.ArrayLike] = None,
                   mask: Optional[npt.ArrayLike] = None, depth_scale: Optional[float] = None,
                   **options: Any) -> Model:
    """A union of superquadrics for the object in a depth image.

    depth: H x W, uint16 in millimetres or floats in metres, unless depth_scale says the length
    of a step. intrinsics: fx, fy, cx, cy [px]. color: H x W x 3 RGB or H x W. mask: H x W.
    Hints and further options are those of pcl_sq_stereo: roi, click, color of the object as
    color_hint, segment, parts, ..."""
    steps, scale = _steps(depth, depth_scale)
    return _Frames([], dict(options, intrinsics=intrinsics), False)._model(
        color, None, steps, mask, scale)


def estimate_stereo(left: npt.ArrayLike, right: npt.ArrayLike,
                    calibration: Union[PathLike, Sequence[PathLike], None] = None, *,
                    mask: Optional[npt.ArrayLike] = None, **options: Any) -> Model:
    """A union of superquadrics for the object in a stereo pair.

    left, right: H x W x 3 RGB or H x W, of bytes or deeper. calibration: one file or two
    (OpenCV, ROS, Kalibr, ZED, Middlebury); or the options intrinsics and baseline. Hints and
    further options are those of pcl_sq_stereo: roi, click, matcher, parts, ..."""
    return _Frames(_files_of(calibration), options, False)._model(left, right, None, mask)


def _scene_from_images(left: Optional[npt.ArrayLike], right: Optional[npt.ArrayLike],
                       depth: Optional[npt.ArrayLike], labels: Optional[npt.ArrayLike],
                       calibration: List[str], options: Any,
                       depth_scale: float = 0.0) -> Scene:
    stereo = _stereo_module()
    with in_python_words():
        text, cloud, colors, numbers = stereo.estimate_scene(
            array_of(left), array_of(right), array_of(depth), array_of(labels), depth_scale,
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

# SPDX-License-Identifier: BSD-3-Clause
"""A scene: a table and all things on it, from one look."""
from __future__ import annotations

import json
import os
from typing import Any, Dict, Iterator, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._model import Bodies, Model, PathLike, View, render_json, write_export
from ._options import python_words
from ._types import Array, Error, Grasp


class Thing(Model):
    """One thing of a scene: a model, where it was seen, and what stands around it."""

    def __init__(self, scene: _core.SceneFile, number: int, cloud: Optional[Array],
                 colors: Optional[npt.NDArray[np.uint8]],
                 labels: Optional[npt.NDArray[np.uint16]]) -> None:
        rows = None if labels is None else np.flatnonzero(labels == number)
        super().__init__(scene.thing(number - 1), cloud, colors, rows)
        self.number = number  #: from 1 on, as in Scene.labels and in pcl_sq_grasp --object
        roi, self.pixels, self.visible, sure, self._notes = scene.seen(number - 1)
        self.roi: Tuple[int, int, int, int] = roi  #: x, y, width, height in the image [px]
        self._sure = sure
        self.obstacles = scene.all(number - 1)

    @property
    def confidence(self) -> Optional[float]:
        """How far the model explains what was seen, 0 to 1."""
        return self._sure

    @property
    def notes(self) -> List[str]:
        """Fall-backs and what to do about them, sentences."""
        return [python_words(note) for note in self._notes]


class Scene(Bodies):
    """A table and the things on it; objects from left to right in the image."""

    def __init__(self, file: _core.SceneFile, cloud: Optional[Array] = None,
                 colors: Optional[npt.NDArray[np.uint8]] = None,
                 labels: Optional[npt.NDArray[np.uint16]] = None) -> None:
        self._file: _core.SceneFile = file
        self.cloud = cloud  #: the points it was estimated from, where they are known
        self.colors = colors  #: their colours, or None
        #: number of each pixel's thing, 0 for none; None where the scene is from a file
        self.labels = labels
        self.objects: List[Thing] = [Thing(file, k + 1, cloud, colors, labels)
                                     for k in range(len(file))]
        self._plan: Optional[Dict[str, Any]] = None

    @classmethod
    def load(cls, path: PathLike) -> "Scene":
        """Reads a scene file."""
        return cls(_core.SceneFile.load(os.fsencode(path)))

    @classmethod
    def from_json(cls, text: str) -> "Scene":
        """The scene of a file's text."""
        return cls(_core.SceneFile.from_json(text))

    def __len__(self) -> int:
        return len(self.objects)

    def __getitem__(self, index: int) -> Thing:
        return self.objects[index]

    def __iter__(self) -> Iterator[Thing]:
        return iter(self.objects)

    @property
    def union(self) -> _core.MultiSuperquadric:
        """All things as one union."""
        return self._file.all()

    @property
    def notes(self) -> List[str]:
        """Fall-backs and what was left out, sentences."""
        return [python_words(note) for note in self._file.notes]

    def plan_grasps(self, number: Optional[int] = None, **options: Any) -> List[Grasp]:
        """Ranked grasps of one thing, best first; the others and the table are in the way.

        number: from 1 on; by default the thing with the best grasp. The Grasp.thing of each
        is its number. Options are those of Model.plan_grasps(). pcl_sq.Error says why there
        are none."""
        if number is not None and not 1 <= number <= len(self.objects):
            raise IndexError("the scene has the things 1 to %d" % len(self.objects))
        best: Optional[Thing] = None
        failure: Optional[Error] = None
        for thing in self.objects if number is None else [self.objects[number - 1]]:
            try:
                grasps = thing.plan_grasps(**options)
            except ValueError:
                raise
            except Error as error:
                failure = failure or error
                continue
            if best is None or grasps[0].scores["total"] > best.grasps[0].scores["total"]:
                best = thing
        if best is None:
            raise failure or Error("the scene holds no thing; there is nothing to grasp.")
        for grasp in best.grasps:
            grasp.thing = best.number
        self._plan = best.plan
        return best.grasps

    def render(self, *, view: str = "iso", width: int = 1280, height: int = 960,
               up: Optional[npt.ArrayLike] = None, opacity: float = 0.45,
               title: str = "") -> npt.NDArray[np.uint8]:
        """A picture, height x width x 3 bytes, also without a display. view: front, side,
        top, iso or camera."""
        if not self.objects:
            raise Error("the scene holds no thing; there is nothing to show.")
        first = self.objects[0]
        text = Model.from_parts(self.union.parts).to_json(-1)
        return render_json(text, self.cloud, self.colors, view,
                           first.report.get("up") if up is None else up, first.sensor, width,
                           height, opacity, title)

    def to_html(self, title: str = "pcl_sq") -> str:
        """A page to turn in a browser, with the cloud and the grasps that were planned."""
        file = _core.SceneFile.from_json(self.to_json(-1))
        if self._plan is not None:
            file.extra_json = json.dumps(dict(
                json.loads(file.extra_json), gripper=self._plan["gripper"],
                grasps=self._plan["grasps"]))
        return _core.scene_html(file, self.cloud, self.colors, title)

    def show(self, title: str = "pcl_sq", height: int = 500) -> View:
        """The page in a notebook; view.save("view.html") and view.open() elsewhere."""
        return View(self.to_html(title), height)

    def export(self, path: PathLike) -> None:
        """Writes all things and the table as MoveIt's .scene or as .glb; for URDF and SDF
        export one of the objects."""
        write_export(path, (".scene", ".glb"), lambda ending, name:
                     _core.scene_export(self._file, ending, name))

    def __repr__(self) -> str:
        return "<pcl_sq.Scene of %d thing%s>" % (len(self), "" if len(self) == 1 else "s")

# SPDX-License-Identifier: BSD-3-Clause
"""A model: a union of superquadrics with what is known of it."""
from __future__ import annotations

import json
import os
import tempfile
import webbrowser
from html import escape
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import points_of
from ._options import in_python_words, python_words, words_of
from ._types import Array, Error, Grasp, Mesh, OptionError

PathLike = Union[str, "os.PathLike[str]"]


class Bodies:
    """Superquadrics in one frame: what a model and a scene have in common."""

    _file: Union[_core.ModelFile, _core.SceneFile]

    @property
    def union(self) -> _core.MultiSuperquadric:
        """All superquadrics as one union."""
        raise NotImplementedError

    @property
    def frame(self) -> str:
        """Name of the coordinate frame."""
        return self._file.frame

    @property
    def table(self) -> Optional[npt.NDArray[np.float64]]:
        """The table n . p + d = 0 as nx, ny, nz, d, where one was found."""
        return None if self._file.table is None else np.array(self._file.table)

    def distance(self, points: npt.ArrayLike, *, method: str = "exact") -> Any:
        """Signed distance of each point to the surface [m], negative inside."""
        return self.union.distance(points, method=method)

    def contains(self, points: npt.ArrayLike) -> Any:
        """Whether each point lies inside."""
        return self.union.contains(points)

    def mesh(self, resolution: int = 96) -> Mesh:
        """The closed surface of all."""
        return self.union.mesh(resolution)

    def to_json(self, indent: int = 2) -> str:
        """The text of the file; indent -1: one line."""
        return self._file.to_json(indent)

    def save(self, path: PathLike) -> None:
        """Writes a file, whole or not at all."""
        self._file.save(os.fsencode(path))


class Model(Bodies):
    """A union of superquadrics with its frame, table, report, and the cloud it is from."""

    def __init__(self, file: _core.ModelFile, cloud: Optional[Array] = None,
                 colors: Optional[npt.NDArray[np.uint8]] = None,
                 object_indices: Optional[npt.NDArray[np.int64]] = None) -> None:
        self._file: _core.ModelFile = file
        self.cloud = cloud  #: the points it was estimated from, where they are known
        self.colors = colors  #: their colours, or None
        self.object_indices = object_indices  #: rows of the points that are the object
        self.grasps: List[Grasp] = []  #: of the last plan_grasps()
        #: what else stands there and must not be touched: in a scene the other things
        self.obstacles = _core.MultiSuperquadric([])
        self.plan: Optional[Dict[str, Any]] = None  #: the file of the last plan_grasps()

    @classmethod
    def load(cls, path: PathLike) -> "Model":
        """Reads a model file."""
        return cls(_core.ModelFile.load(os.fsencode(path)))

    @classmethod
    def from_json(cls, text: str) -> "Model":
        """The model of a file's text."""
        return cls(_core.ModelFile.from_json(text))

    @classmethod
    def from_parts(cls, parts: Sequence[_core.Superquadric]) -> "Model":
        """A model of superquadrics that come from elsewhere."""
        return cls(_core.ModelFile.of_union(_core.MultiSuperquadric(list(parts))))

    @property
    def union(self) -> _core.MultiSuperquadric:
        """The union itself."""
        return self._file.model

    @property
    def parts(self) -> List[_core.Superquadric]:
        """Its superquadrics."""
        return self._file.model.parts

    def __len__(self) -> int:
        return len(self._file.model)

    def __getitem__(self, index: int) -> _core.Superquadric:
        return self._file.model[index]

    def __iter__(self) -> Iterator[_core.Superquadric]:
        return iter(self.parts)

    @property
    def rms_distance(self) -> float:
        """Of the object's points to the surface [m]."""
        return self._file.rms_distance

    @property
    def extra(self) -> Dict[str, Any]:
        """Further members of the file: size, confidence, report."""
        members: Dict[str, Any] = json.loads(self._file.extra_json)
        return members

    @property
    def report(self) -> Dict[str, Any]:
        """What the estimation saw and did."""
        report: Dict[str, Any] = self.extra.get("report", {})
        return report

    @property
    def notes(self) -> List[str]:
        """Fall-backs and what to do about them, sentences."""
        return [python_words(note) for note in self.report.get("notes", [])]

    @property
    def confidence(self) -> Optional[float]:
        """How far the model explains what was seen, 0 to 1; None where nothing tells."""
        value = self.extra.get("confidence")
        return None if value is None else float(value)

    @property
    def size(self) -> Optional[npt.NDArray[np.float64]]:
        """Width, depth and height of the object [m], where it was estimated."""
        value = self.extra.get("size")
        return None if value is None else np.array(value)

    def plan_grasps(self, *, gripper: PathLike = "franka_hand", count: int = 10,
                    cloud: Optional[npt.ArrayLike] = None, **options: Any) -> List[Grasp]:
        """Ranked grasps, best first; pcl_sq.Error says why there are none.

        gripper: franka_hand, wsg_50, robotiq_2f_85, robotiq_3f, or a TOML file. cloud: what
        else stands there, by default the cloud that the model is from. Options of
        pcl_sq_grasp: friction, clearance, min_observed, viewpoint, table, up."""
        around = self.cloud if cloud is None else points_of(cloud)
        words = words_of(dict(options, gripper=os.fspath(gripper), count=count))
        with in_python_words():
            plan = json.loads(_core.plan_grasps(self._file, around, self.obstacles, words))
        self.plan = plan
        self.grasps = [Grasp.from_json(grasp) for grasp in plan["grasps"]]
        return self.grasps

    @property
    def sensor(self) -> Optional[Array]:
        """The camera's place [m], where it is known or was found."""
        place = self.report.get("sensor")
        return None if place is None else np.array(place)

    def render(self, *, view: str = "iso", width: int = 1280, height: int = 960,
               up: Optional[npt.ArrayLike] = None, opacity: float = 0.45,
               title: str = "") -> npt.NDArray[np.uint8]:
        """A picture, height x width x 3 bytes, also without a display. view: front, side,
        top, iso or camera."""
        return render_json(self.to_json(-1), self.cloud, self.colors, view,
                           self.report.get("up") if up is None else up, self.sensor, width,
                           height, opacity, title)

    def to_html(self, title: str = "pcl_sq") -> str:
        """A page to turn in a browser, with the cloud and the grasps that were planned."""
        file = _core.ModelFile.from_json(self.to_json(-1))
        if self.grasps and self.plan is not None:
            file.extra_json = json.dumps(dict(self.extra, gripper=self.plan["gripper"],
                                              grasps=self.plan["grasps"]))
        return _core.html(file, self.cloud, self.colors, title)

    def show(self, title: str = "pcl_sq", height: int = 500) -> "View":
        """The page in a notebook; view.save("view.html") and view.open() elsewhere."""
        return View(self.to_html(title), height)

    def export(self, path: PathLike, *, density: float = 500.0, mesh_prefix: str = "") -> None:
        """Writes .urdf, .sdf, MoveIt's .scene or .glb; URDF and SDF with their meshes beside
        them, named mesh_prefix + name. density: of a body without hollows [kg/m^3]."""
        write_export(path, (".urdf", ".sdf", ".scene", ".glb"), lambda ending, name:
                     _core.robot_export(self._file, ending, name, density, mesh_prefix))

    def __repr__(self) -> str:
        sure = "" if self.confidence is None else ", confidence %.0f %%" % (
            100.0 * self.confidence)
        return "<pcl_sq.Model of %d superquadric%s%s>" % (
            len(self), "" if len(self) == 1 else "s", sure)


class View:
    """A model to turn: shown by a notebook, saved, or opened in the browser."""

    def __init__(self, html: str, height: int) -> None:
        self.html = html
        self.height = height

    def _repr_html_(self) -> str:
        return ('<iframe srcdoc="%s" width="100%%" height="%d" style="border:0"></iframe>'
                % (escape(self.html, quote=True), self.height))

    def save(self, path: PathLike) -> None:
        """Writes the page, whole or not at all."""
        _core.write_file(os.fsencode(path), self.html.encode())

    def open(self) -> None:
        """Shows the page in the browser."""
        with tempfile.NamedTemporaryFile("w", suffix=".html", delete=False,
                                         encoding="utf-8") as file:
            file.write(self.html)
        webbrowser.open("file://" + file.name)


def write_export(path: PathLike, endings: Sequence[str],
                 files_of: Callable[[str, str], List[Tuple[str, bytes]]]) -> None:
    """Writes what files_of(ending, name) gives: the file that is asked for, and meshes."""
    folder, base = os.path.split(os.fsdecode(path))
    stem, ending = os.path.splitext(base)
    name = "".join(c if c.isascii() and (c.isalnum() or c in "_-") else "_" for c in stem)
    if ending.lower() not in endings:
        raise OptionError("export writes %s or %s here, not '%s'." % (
            ", ".join(endings[:-1]), endings[-1], ending))
    files = files_of(ending.lower(), name or "object")
    if not files:
        raise Error("the model has no parts, so '%s' is not written." % os.fsdecode(path))
    for number, (file, contents) in enumerate(files):
        place = os.path.join(folder, base if number == 0 else file)
        _core.write_file(os.fsencode(place), contents)


def render_json(text: str, cloud: Optional[Array], colors: Optional[npt.NDArray[np.uint8]],
                view: str, up: Optional[npt.ArrayLike], sensor: Optional[Array], width: int,
                height: int, opacity: float, title: str) -> npt.NDArray[np.uint8]:
    """A picture of a model file's text."""
    try:
        from . import _render
    except ModuleNotFoundError as error:
        raise Error("this pcl_sq was built without pictures; build it with "
                    "PCL_SQ_BUILD_VISUALIZATION=ON.") from error
    try:
        return _render.render(text, cloud, colors, view,
                              None if up is None else np.asarray(up, float), sensor, width,
                              height, opacity, title)
    except RuntimeError as error:
        raise Error(str(error)) from None

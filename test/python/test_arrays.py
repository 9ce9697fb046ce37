# SPDX-License-Identifier: BSD-3-Clause
"""Arrays as users have them: masked, of fields, of images; what is none is told."""
import copy
import os
import pickle

import numpy as np
import pytest

import pcl_sq
from conftest import numbers

CUP = pcl_sq.Superquadric([.04, .04, .05], epsilon=(.2, 1.0), center=[0, 0, .6])
CAMERA = (300, 300, 80, 60)


def seen():
    points = CUP.sample(2000)
    return points[np.sum(CUP.normal(points) * points, axis=1) < 0]


def depth_of_a_cup():
    """H x W [m]: a cup in front of nothing."""
    v, u = np.mgrid[0:120, 0:160]
    depth = np.full(u.shape, np.nan)
    points = CUP.sample(200000)
    points = points[np.sum(CUP.normal(points) * points, axis=1) < 0]
    x, y = np.round(300 * points[:, :2].T / points[:, 2] + [[80], [60]]).astype(int)
    depth[y, x] = points[:, 2]
    return depth


@pytest.fixture(scope="module")
def depth():
    return depth_of_a_cup()


def test_what_is_masked_is_missing():
    points = seen()
    truth = numbers(pcl_sq.estimate(points))
    masked = np.ma.masked_array(np.vstack([points, np.full((50, 3), 1.5)]), mask=False)
    masked[len(points):] = np.ma.masked
    assert numbers(pcl_sq.estimate(masked)) == truth
    assert np.isnan(CUP.distance(masked)[-50:]).all()
    whole = np.ma.masked_less(np.array([[1, 2, 3], [-1, 2, 3]]), 0)
    assert np.isnan(CUP.distance(whole)).tolist() == [False, True]


def test_fields_x_y_z_are_points():
    points = seen()
    fields = np.zeros(len(points), [("z", "f8"), ("rgb", "f4"), ("x", "f8"), ("y", "f8")])
    fields["x"], fields["y"], fields["z"] = points.T
    assert numbers(pcl_sq.estimate(fields)) == numbers(pcl_sq.estimate(points))
    assert np.array_equal(CUP.distance(fields.reshape(-1, 1)).ravel(), CUP.distance(points))
    with pytest.raises(TypeError, match="numbers"):
        pcl_sq.estimate(fields[["x", "y"]])


def test_what_is_not_finite_has_no_distance():
    union = pcl_sq.MultiSuperquadric([CUP, CUP])
    for body in CUP, union:
        for method in "exact", "fast":
            distances = body.distance([[np.nan, 0, 0], [0, 0, np.inf], [0, 0, .6]],
                                      method=method)
            assert np.isnan(distances).tolist() == [True, True, False]


def test_an_option_may_be_numpys_truth():
    points = seen()
    truth = numbers(pcl_sq.estimate(points, taper=False))
    assert numbers(pcl_sq.estimate(points, taper=np.bool_(False))) == truth
    assert numbers(pcl_sq.estimate(points, remove_plane=np.bool_(False), taper=False)) == truth


@pytest.mark.parametrize("wrong", [
    lambda: pcl_sq.estimate(np.zeros((4, 2))), lambda: CUP.distance(np.zeros((4, 2))),
    lambda: pcl_sq.Superquadric([1.0, -1.0, 1.0]), lambda: CUP.mesh(1),
    lambda: pcl_sq.MultiSuperquadric([]).bounds,
    lambda: pcl_sq.Model.from_parts([CUP]).export("a.urdf", density=-1)])
def test_what_makes_no_sense_is_an_option_error(wrong):
    with pytest.raises(pcl_sq.OptionError):
        wrong()


def test_notes_name_options_as_python_does():
    assert any("give unit mm" in note for note in pcl_sq.estimate(seen() * 1000).notes)


def test_copies_of_a_union_and_of_a_model_are_whole():
    union = pcl_sq.MultiSuperquadric([CUP, CUP])
    model = pcl_sq.Model.from_parts([CUP])
    model.grasps, model.obstacles = ["one"], union
    for again in pickle.loads(pickle.dumps(model)), copy.deepcopy(model):
        assert again.to_json() == model.to_json()
        assert again.grasps == ["one"] and repr(again.obstacles) == repr(union)


@pytest.mark.parametrize("name", ["\udcff.json", b"\xff.json", "\u00fc.json"])
def test_any_name_of_a_file_is_one(tmp_path, name):
    model = pcl_sq.Model.from_parts([CUP])
    path = os.path.join(os.fsencode(tmp_path), os.fsencode(name))
    path = path if isinstance(name, bytes) else os.fsdecode(path)
    with pytest.raises(pcl_sq.Error, match="does not exist"):
        pcl_sq.load(path)
    model.save(path)
    assert pcl_sq.load(path).to_json() == model.to_json()
    with pytest.raises(pcl_sq.Error, match="zero byte"):
        model.save(str(tmp_path) + "/a\0b.json")


@pytest.mark.parametrize("form", ["swapped bytes", "last side", "masked", "whole numbers"])
def test_a_depth_image_of_any_form_is_the_same(depth, form):
    pytest.importorskip("pcl_sq._stereo")
    steps = np.round(1000 * np.nan_to_num(depth)).astype(np.uint16)
    mask = np.isfinite(depth)
    truth = numbers(pcl_sq.estimate_depth(steps, CAMERA, mask=mask))
    if form == "swapped bytes":
        steps = steps.astype(">u2")
    elif form == "last side":
        steps, mask = steps[..., None], mask[..., None]
    elif form == "masked":
        steps = np.ma.masked_array(np.where(mask, steps, 9000), mask=~mask)
    else:
        mask = 7 * mask.astype(np.int64)
    assert numbers(pcl_sq.estimate_depth(steps, CAMERA, mask=mask)) == truth


@pytest.mark.parametrize("images, kind", [
    ({"color": np.zeros((120, 160, 3))}, TypeError),  # from 0 to 1
    ({"color": np.zeros((120, 160, 4), np.uint8)}, pcl_sq.OptionError),
    ({"mask": np.ones((120, 160, 3), bool)}, pcl_sq.OptionError),
    ({"depth": np.zeros((0, 0), np.uint16)}, pcl_sq.OptionError)])
def test_an_image_of_no_use_is_told_by_its_name(depth, images, kind):
    pytest.importorskip("pcl_sq._stereo")
    (name,) = images
    with pytest.raises(kind, match="^" + name):
        pcl_sq.estimate_depth(**dict({"depth": depth, "intrinsics": CAMERA}, **images))

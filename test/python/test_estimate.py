# SPDX-License-Identifier: BSD-3-Clause
"""The chain of the programs, from arrays: the same models, the same sentences."""
import json
import pickle
import shutil
import threading

import numpy as np
import pytest

import pcl_sq
from conftest import numbers, write_xyz


@pytest.fixture(scope="module")
def model(bottle):
    return pcl_sq.estimate(bottle[1])


def test_a_bottle_has_its_size(bottle, model):
    parts, cloud = bottle
    assert model.confidence > 0.5
    assert 0.02 < max(p.sides.max() for p in model.parts) < 0.3
    assert np.median(np.abs(model.distance(cloud))) < 1.5e-3
    assert model.cloud is cloud


def test_the_model_is_the_programs_to_the_bit(bottle, model, program, tmp_path):
    path = write_xyz(tmp_path / "bottle.xyz", bottle[1])
    program("pcl_sq_fit", path, "-q", "-o", tmp_path / "model.json")
    assert numbers((tmp_path / "model.json").read_text()) == numbers(model)


def test_options_are_the_programs(bottle, program, tmp_path):
    path = write_xyz(tmp_path / "bottle.xyz", bottle[1] * 1000)
    program("pcl_sq_fit", path, "-q", "--unit", "mm", "--decomposition", "none", "--taper",
            "--viewpoint", "0,0,0", "-o", tmp_path / "model.json")
    cloud = pcl_sq.read_cloud(path).points
    same = pcl_sq.estimate(cloud, unit="mm", decomposition="none", taper=True,
                           viewpoint=np.zeros(3))
    assert numbers((tmp_path / "model.json").read_text()) == numbers(same)


@pytest.mark.parametrize("options, sentence", [
    ({"parts": 99}, "parts"), ({"max_part": 2}, "max_part"), ({"cost": "radial", "parts": 2}, ""),
    ({"box": (0, 0, 0, -1, -1, -1)}, "minimum"), ({"output": "x.json"}, "output"),
    ({"mask": np.ones((2, 2)), "remove_plane": True}, "mask")])
def test_options_that_make_no_sense_are_refused(bottle, options, sentence):
    with pytest.raises(pcl_sq.OptionError, match=sentence) as error:
        pcl_sq.estimate(bottle[1], **options)
    assert isinstance(error.value, ValueError) and "--" not in str(error.value)


def test_points_without_a_model_are_told_why():
    for points in (np.zeros((0, 3)), np.full((50, 3), np.nan), np.zeros((50, 3)),
                   np.outer(np.arange(50.0), [1, 1, 1])):
        with pytest.raises(pcl_sq.Error) as error:
            pcl_sq.estimate(points)
        assert str(error.value).endswith(".") and not isinstance(error.value, ValueError)


def test_a_file_keeps_the_model(model, tmp_path):
    model.save(tmp_path / "m.json")
    again = pcl_sq.load(tmp_path / "m.json")
    assert again.to_json() == model.to_json()
    assert numbers(pickle.loads(pickle.dumps(model))) == numbers(model)
    with pytest.raises(pcl_sq.Error, match="nowhere"):
        pcl_sq.load(tmp_path / "nowhere.json")
    with pytest.raises(pcl_sq.Error):
        model.save(tmp_path / "no" / "folder.json")
    with pytest.raises(pcl_sq.Error, match="no model"):
        pcl_sq.Model.from_json("{}")


def test_grasps_are_the_programs(model, program, tmp_path):
    cloud = write_xyz(tmp_path / "cloud.xyz", model.cloud)
    model.save(tmp_path / "m.json")
    program("pcl_sq_grasp", tmp_path / "m.json", "--cloud", cloud, "--count", 5, "-q",
            "-o", tmp_path / "g.json")
    truth = json.loads((tmp_path / "g.json").read_text())["grasps"]
    grasps = model.plan_grasps(count=5)
    assert len(grasps) == len(truth) > 0
    for grasp, other in zip(grasps, truth):
        assert grasp.raw == other
        np.testing.assert_allclose(grasp.pose[:3, :3] @ grasp.pose[:3, :3].T, np.eye(3),
                                   atol=1e-9)


def test_no_grasp_is_an_error_that_says_why():
    house = pcl_sq.Model.from_parts([pcl_sq.Superquadric([3.0, 3.0, 3.0])])
    with pytest.raises(pcl_sq.Error, match="wide|open"):
        house.plan_grasps()
    with pytest.raises(pcl_sq.OptionError, match="friction"):
        house.plan_grasps(friction=9)


def test_threads_fit_beside_each_other(bottle, model):
    results = [None] * 4

    def work(i):
        results[i] = pcl_sq.estimate(bottle[1], threads=1)
    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(numbers(r) == numbers(model) for r in results)


def test_clouds_are_read_as_the_programs_read_them(bottle, tmp_path):
    path = write_xyz(tmp_path / "b.xyz", bottle[1])
    cloud = pcl_sq.read_cloud(path)
    assert cloud.points.dtype == np.float32 and np.array_equal(cloud.points, bottle[1])
    assert cloud.colors is None
    with pytest.raises(pcl_sq.Error, match="cannot"):
        pcl_sq.read_cloud(tmp_path / "none.pcd")


def test_a_stereo_pair_and_a_depth_image_give_the_programs_models(program, tmp_path):
    pytest.importorskip("pcl_sq._stereo")
    from imagefile import read_png
    program("pcl_sq_render", "can", "--out", tmp_path / "can", "-q", "--size", "512,384",
            check=False)
    if not (tmp_path / "can" / "left.png").exists():
        program("pcl_sq_render", "can", "--out", tmp_path / "can", "-q")
    left, right = tmp_path / "can" / "left.png", tmp_path / "can" / "right.png"
    calibration = tmp_path / "can" / "calib.yml"
    program("pcl_sq_stereo", left, right, "--calib", calibration, "-q", "-o",
            tmp_path / "m.json")
    model = pcl_sq.estimate_stereo(read_png(left), read_png(right), calibration)
    assert numbers((tmp_path / "m.json").read_text()) == numbers(model)
    assert model.cloud.shape == read_png(left).shape
    # the same scene as a depth image
    camera = json.loads(model.to_json())["stereo"]["camera"]
    depth = np.nan_to_num(model.cloud[:, :, 2])
    intrinsics = [camera[k] for k in ("fx", "fy", "cx", "cy")]
    seen = pcl_sq.estimate_depth((depth * 1e4).astype(np.uint16), intrinsics,
                                 color=read_png(left), depth_scale=1e-4)
    np.testing.assert_allclose(seen.union.bounds, model.union.bounds, atol=0.03)
    with pytest.raises(pcl_sq.Error):
        pcl_sq.estimate_stereo(read_png(left), read_png(right), tmp_path / "none.yml")
    with pytest.raises(pcl_sq.OptionError, match="calib"):
        pcl_sq.estimate_stereo(read_png(left), read_png(right))


def test_frames_that_follow_each_other_give_the_programs_models(program, tmp_path):
    pytest.importorskip("pcl_sq._stereo")
    from imagefile import read_png
    program("pcl_sq_render", "box", "--rig", "vga", "--out", tmp_path, "-q")
    calibration = tmp_path / "calib.yml"
    left, right = read_png(tmp_path / "left.png"), read_png(tmp_path / "right.png")
    for number in range(3):
        for side in ("left", "right"):
            shutil.copy(tmp_path / (side + ".png"), tmp_path / ("%s_%d.png" % (side, number)))
    program("pcl_sq_stereo", "--sequence", tmp_path / "left_*.png", tmp_path / "right_*.png",
            "--calib", calibration, "-q", "-o", tmp_path / "models.jsonl")
    lines = (tmp_path / "models.jsonl").read_text().splitlines()
    frames = pcl_sq.StereoSequence(calibration)
    assert [numbers(frames.process(left, right)) for _ in lines] == list(map(numbers, lines))
    assert len(lines) == 3 and numbers(lines[0]) != numbers(lines[1])  # less was looked at
    with pytest.raises(pcl_sq.Error, match="320 x 240.*640 x 480"):
        frames.process(left[:240, :320], right[:240, :320])
    grey = np.zeros_like(left)
    with pytest.raises(pcl_sq.Error):
        frames.process(grey, grey)
    assert numbers(frames.process(left, right)) == numbers(lines[0])  # starts anew

    camera = json.loads(lines[0])["stereo"]["camera"]
    depth = np.nan_to_num(pcl_sq.estimate_stereo(left, right, calibration).cloud[:, :, 2])
    intrinsics = [camera[k] for k in ("fx", "fy", "cx", "cy")]
    once = pcl_sq.estimate_depth(depth, intrinsics, color=left)
    depths = pcl_sq.DepthSequence(intrinsics)
    assert numbers(depths.process(depth, color=left)) == numbers(once)
    np.testing.assert_allclose(depths.process(depth, color=left).union.bounds,
                               once.union.bounds, atol=0.003)


def test_a_picture_shows_the_model(model):
    pytest.importorskip("pcl_sq._render")
    picture = model.render(width=320, height=240)
    assert picture.shape == (240, 320, 3) and picture.std() > 5
    with pytest.raises(ValueError, match="view"):
        model.render(view="inside")

# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: what pcl_sq_scene finds, and what can be done with it."""
import json
import pickle
import shutil
import subprocess

import numpy as np
import pytest

import pcl_sq
from conftest import numbers, schema
from imagefile import read_png, write_png16

WIDTH, HEIGHT, F = 320, 240, 300.0
PITCH, LIFT = np.radians(25), 0.40
CANS = [(-0.09, 0.55, 0.033, 0.12), (0.08, 0.60, 0.028, 0.10)]  # x, ahead, radius, height [m]


def depth_of_cans():
    """Depth of each pixel and its can's number, seen from LIFT above a table."""
    u, v = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    x, y = (u - WIDTH / 2) / F, (v - HEIGHT / 2) / F
    down, ahead = y * np.cos(PITCH) + np.sin(PITCH), np.cos(PITCH) - y * np.sin(PITCH)
    with np.errstate(divide="ignore", invalid="ignore"):
        depth = np.where(down > 1e-6, LIFT / down, np.nan)
        labels = np.zeros(depth.shape, np.uint16)
        for number, (cx, cz, radius, tall) in enumerate(CANS, 1):
            lid = (LIFT - tall) / down
            hits = [np.where((down > 0) & (np.hypot(lid * x - cx, lid * ahead - cz) <= radius),
                             lid, np.nan)]
            a, b = x * x + ahead * ahead, -(x * cx + ahead * cz)
            side = (-b - np.sqrt(b * b - a * (cx * cx + cz * cz - radius * radius))) / a
            hits.append(np.where((LIFT - side * down > 0) & (LIFT - side * down < tall), side,
                                 np.nan))
            nearest = np.fmin(*hits)
            labels[nearest < depth] = number
            depth = np.fmin(depth, nearest)
    depth[depth > 1.5] = np.nan
    return depth, labels


@pytest.fixture(scope="module")
def cans():
    """(points H x W x 3, labels, depth [mm])"""
    depth, labels = depth_of_cans()
    depth = np.round(1000 * depth) / 1000
    u, v = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    points = np.dstack([(u - WIDTH / 2) / F * depth, (v - HEIGHT / 2) / F * depth, depth])
    return points.astype(np.float32), labels, np.nan_to_num(1000 * depth).astype(np.uint16)


@pytest.fixture(scope="module")
def scene(cans):
    return pcl_sq.estimate_scene(cans[0])


def write_pcd(path, points):
    flat = np.ascontiguousarray(points, "<f4")
    with open(path, "wb") as out:
        out.write(("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH %d\n"
                   "HEIGHT %d\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA binary\n" % (
                       points.shape[1], points.shape[0], flat.size // 3)).encode())
        out.write(flat.tobytes())
    return path


def bodies(text):
    return [numbers(json.dumps(thing)) for thing in json.loads(text)["objects"]]


def test_every_thing_is_found_with_its_pixels_and_size(scene, cans):
    assert len(scene) == 2 and [t.number for t in scene] == [1, 2]
    for thing, (_, _, radius, tall) in zip(scene, CANS):
        own = scene.labels == thing.number
        true = cans[1] == thing.number
        assert (own & true).sum() / (own | true).sum() > 0.9
        assert thing.size == pytest.approx([2 * radius, 2 * radius, tall], rel=0.06)
        assert np.array_equal(thing.object_indices, np.flatnonzero(own))
        assert thing.pixels == pytest.approx(own.sum(), rel=0.05) and thing.confidence > 0.5
        assert thing.visible == pytest.approx(1.0, abs=0.05) and len(thing.roi) == 4
    normal = [0, -np.cos(PITCH), -np.sin(PITCH)]
    assert scene.table[:3] == pytest.approx(normal, abs=0.01)


def test_the_result_is_the_programs(scene, cans, program, tmp_path):
    path = write_pcd(tmp_path / "cans.pcd", cans[0])
    program("pcl_sq_scene", path, "-q", "-o", tmp_path / "scene.json", "--write-labels",
            tmp_path / "labels.png")
    text = (tmp_path / "scene.json").read_text()
    assert bodies(text) == bodies(scene.to_json())
    assert np.array_equal(read_png(tmp_path / "labels.png").squeeze(), scene.labels)
    # grasps of one thing among the others
    program("pcl_sq_grasp", tmp_path / "scene.json", "--cloud", path, "--object", "2", "-q",
            "-o", tmp_path / "grasps.json")
    grasps = json.loads((tmp_path / "grasps.json").read_text())["grasps"]
    loaded = pcl_sq.load_scene(tmp_path / "scene.json")
    ours = loaded.plan_grasps(2, cloud=cans[0])
    assert [g.raw for g in ours] == grasps and {g.thing for g in ours} == {2}
    # the same page and exports
    program("pcl_sq_scene", path, "-q", "--html", tmp_path / "s.html", "--export",
            tmp_path / "s.scene", "--export", tmp_path / "s.glb")
    for ending in ("scene", "glb"):
        wrote = (tmp_path / ("s." + ending)).read_bytes()
        scene.export(tmp_path / ("s." + ending))
        assert (tmp_path / ("s." + ending)).read_bytes() == wrote
    page = (tmp_path / "s.html").read_text()
    assert '"thing 2"' in page and '"thing 2"' in scene.to_html()


def test_depth_images_give_what_the_program_gives(cans, program, tmp_path):
    intrinsics = [F, F, WIDTH / 2, HEIGHT / 2]
    try:
        found = pcl_sq.estimate_scene_depth(cans[2], intrinsics)
    except pcl_sq.Error as error:
        if "without stereo" in str(error):
            pytest.skip(str(error))
        raise
    write_png16(tmp_path / "depth.png", cans[2])
    program("pcl_sq_scene", "--depth", tmp_path / "depth.png", "--intrinsics",
            ",".join(str(k) for k in intrinsics), "-q", "-o", tmp_path / "scene.json")
    assert bodies(found.to_json()) == bodies((tmp_path / "scene.json").read_text())
    assert len(found) == 2
    # steps of another length, which are not rounded another way
    write_png16(tmp_path / "fine.png", 7 * cans[2])
    program("pcl_sq_scene", "--depth", tmp_path / "fine.png", "--depth-scale", "0.000143",
            "--intrinsics", ",".join(str(k) for k in intrinsics), "-q", "-o",
            tmp_path / "fine.json")
    text = bodies((tmp_path / "fine.json").read_text())
    for steps in (7 * cans[2], 7 * cans[2].astype(np.int64)):
        fine = pcl_sq.estimate_scene_depth(steps, intrinsics, depth_scale=0.000143)
        assert bodies(fine.to_json()) == text and len(fine) == 2
    with pytest.raises(pcl_sq.OptionError, match="depth_scale"):
        pcl_sq.estimate_scene_depth(cans[2], intrinsics, depth_scale=-1.0)


def test_stereo_pairs_give_what_the_program_gives(program, tmp_path):
    pytest.importorskip("pcl_sq._stereo")
    program("pcl_sq_render", "box", "--rig", "vga", "--out", tmp_path, "-q")
    left, right = tmp_path / "left.png", tmp_path / "right.png"
    program("pcl_sq_scene", left, right, "--calib", tmp_path / "calib.yml", "-q", "-o",
            tmp_path / "scene.json")
    found = pcl_sq.estimate_scene_stereo(read_png(left), read_png(right),
                                         tmp_path / "calib.yml")
    assert bodies(found.to_json()) == bodies((tmp_path / "scene.json").read_text())
    assert len(found) == 1 and found.colors.shape == read_png(left).shape
    with pytest.raises(pcl_sq.OptionError, match="calib"):
        pcl_sq.estimate_scene_stereo(read_png(left), read_png(right))


def test_labels_from_elsewhere_are_used_as_they_are(cans):
    labels = np.where(cans[1] == 2, 40000, 0)
    one = pcl_sq.estimate_scene(cans[0], labels=labels)
    assert len(one) == 1 and np.array_equal(one.labels == 1, labels > 0)
    with pytest.raises(ValueError, match="labels"):
        pcl_sq.estimate_scene(cans[0], labels=labels.astype(float))
    with pytest.raises(ValueError, match="65535"):
        pcl_sq.estimate_scene(cans[0], labels=-labels)
    with pytest.raises(pcl_sq.Error):
        pcl_sq.estimate_scene(cans[0], labels=labels[:100])


def test_grasps_do_not_touch_the_other_things(scene):
    best = scene.plan_grasps(count=3)
    assert best[0].scores["total"] == max(
        scene.plan_grasps(k, count=1)[0].scores["total"] for k in (1, 2))
    assert len(scene[0].obstacles) == len(scene[1])
    # between two walls no hand fits
    walled = pcl_sq.Model.from_parts(scene[0].parts)
    around = [pcl_sq.Superquadric([0.3, 0.3, 0.3], epsilon=(0.1, 0.1),
                                  center=scene[0][0].center + np.array(d))
              for d in ([0.35, 0, 0], [-0.35, 0, 0], [0, 0, 0.35], [0, 0, -0.35], [0, -0.4, 0])]
    assert walled.plan_grasps(count=1, cloud=[[0.0, 0.0, 0.1]])
    walled.obstacles = pcl_sq.MultiSuperquadric(around)
    with pytest.raises(pcl_sq.Error):
        walled.plan_grasps(count=1, cloud=[[0.0, 0.0, 0.1]])
    with pytest.raises(IndexError, match="1 to 2"):
        scene.plan_grasps(3)


def test_all_things_are_one_union_to_ask_and_to_look_at(scene, tmp_path):
    centers = np.array([thing.union.parts[0].center for thing in scene])
    assert scene.contains(centers).all() and (scene.distance(centers) < 0).all()
    assert len(scene.mesh(32).triangles) > 100
    try:
        picture = scene.render(width=320, height=240)
        assert picture.shape == (240, 320, 3) and picture.std() > 5
    except pcl_sq.Error as error:
        assert "without pictures" in str(error)
    scene.export(tmp_path / "things.scene")
    lines = (tmp_path / "things.scene").read_text().splitlines()
    assert [l for l in lines if l.startswith("* ")] == ["* things_1", "* things_2",
                                                        "* things_table"]
    assert lines[-1] == "."
    with pytest.raises(pcl_sq.OptionError, match="glb"):
        scene.export(tmp_path / "things.urdf")
    scene[1].export(tmp_path / "second.urdf")
    scene.export(tmp_path / "things.glb")
    if shutil.which("assimp"):
        told = subprocess.run(["assimp", "info", tmp_path / "things.glb"], capture_output=True,
                              text=True, check=True).stdout
        assert "thing 1" in told and "thing 2" in told


def test_a_scene_comes_back_from_its_file_and_from_other_processes(scene, tmp_path):
    scene.save(tmp_path / "scene.json")
    back = pcl_sq.load_scene(tmp_path / "scene.json")
    assert json.loads(back.to_json()) == json.loads(scene.to_json()) and back.labels is None
    copy = pickle.loads(pickle.dumps(scene))
    assert bodies(copy.to_json()) == bodies(scene.to_json()) and np.array_equal(copy.labels, scene.labels)
    with pytest.raises(pcl_sq.Error, match="no scene"):
        pcl_sq.Scene.from_json("{}")


def test_scene_files_are_as_their_schema_says(scene):
    contents = json.loads(scene.to_json())
    schema("scene.schema.json").validate(contents)
    contents["objects"][0]["superquadrics"][0]["epsilon"] = [3, 1]
    assert not schema("scene.schema.json").is_valid(contents)
    contents = json.loads(scene.to_json())
    del contents["objects"][1]["visible"]
    assert not schema("scene.schema.json").is_valid(contents)


def test_what_is_no_image_of_points_or_holds_nothing_is_refused(cans):
    with pytest.raises(pcl_sq.Error):
        pcl_sq.estimate_scene(cans[0].reshape(-1, 3))
    with pytest.raises(pcl_sq.Error):
        pcl_sq.estimate_scene(np.full((50, 50, 3), np.nan, np.float32))
    with pytest.raises(pcl_sq.OptionError, match="min_pixels"):
        pcl_sq.estimate_scene(cans[0], min_pixels=1)


def test_a_copied_thing_is_still_one_of_its_scene(scene):
    for again in pickle.loads(pickle.dumps(scene[1])), pickle.loads(pickle.dumps(scene))[1]:
        assert isinstance(again, pcl_sq.Thing) and again.number == 2
        assert again.roi == scene[1].roi and again.confidence == scene[1].confidence
        assert repr(again.obstacles) == repr(scene[1].obstacles)

# SPDX-License-Identifier: BSD-3-Clause
"""Exports read back by the formats' own tools, files by their schemas, where these are there."""
import json
import os
import shutil
import subprocess

import numpy as np
import pytest

import pcl_sq
from conftest import schema, write_xyz



@pytest.fixture(scope="module")
def model(bottle):
    cup = pcl_sq.Superquadric([0.04, 0.04, 0.05], epsilon=(0.2, 1.0), center=[0.2, 0, 0.7],
                              rim=0.9, wall=0.004)
    return pcl_sq.Model.from_parts(bottle[0] + [cup])


def tool(name):
    path = shutil.which(name)
    if path is None:
        pytest.skip(name + " is not installed")
    return path


def test_check_urdf_takes_the_urdf(model, tmp_path):
    model.export(tmp_path / "thing.urdf")
    done = subprocess.run([tool("check_urdf"), tmp_path / "thing.urdf"], capture_output=True,
                          text=True, check=True)
    assert "Successfully Parsed" in done.stdout and "thing" in done.stdout
    assert len(list(tmp_path.glob("*.stl"))) > 10  # the cup's wall


def test_sdf_is_well_formed_xml(model, tmp_path):
    from xml.etree import ElementTree
    model.export(tmp_path / "thing.sdf", density=1000, mesh_prefix="model://thing/")
    root = ElementTree.parse(tmp_path / "thing.sdf").getroot()
    mass = float(root.find("model/link/inertial/mass").text)
    assert mass == pytest.approx(1000 * model.union.volume, rel=1e-6)
    for uri in root.iter("uri"):
        assert (tmp_path / uri.text.replace("model://thing/", "")).exists()


def test_libsdformat_reads_what_the_model_holds(model, tmp_path):
    reader = os.environ.get("PCL_SQ_READ_SDF")
    if not reader:
        pytest.skip("libsdformat-dev is not installed")
    model.export(tmp_path / "thing.sdf", density=1000)
    done = subprocess.run([reader, tmp_path / "thing.sdf"], capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0] == "model thing links 1"
    words = lines[2].split()
    assert float(words[1]) == pytest.approx(1000 * model.union.volume, rel=1e-4)
    assert words[3] == "1"  # inertia as of a body that can be
    assert int(words[7]) == len(lines) - 3 and "unknown" not in lines
    for line in lines[3:]:
        if line.startswith("mesh "):
            assert (tmp_path / line[5:]).exists()
    assert "cylinder" in lines  # the bottle's body
    # a file that is none is refused, so that the test tells
    (tmp_path / "bad.sdf").write_text((tmp_path / "thing.sdf").read_text().replace(
        "<mass>", "<mess>").replace("</mass>", "</mess>").replace("<link", "<lonk").replace(
            "</link", "</lonk"))
    assert subprocess.run([reader, tmp_path / "bad.sdf"], capture_output=True).returncode


@pytest.mark.parametrize("ending", ["glb", "stl"])
def test_assimp_reads_what_is_written(model, tmp_path, ending):
    model.export(tmp_path / "thing.glb")
    model.export(tmp_path / "thing.urdf")
    path = tmp_path / ("thing.glb" if ending == "glb" else "thing_visual.stl")
    done = subprocess.run([tool("assimp"), "info", path], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    if ending == "glb":
        assert "Meshes:             3" in done.stdout, done.stdout
        for part in (1, 2, 3):
            assert "part %d" % part in done.stdout


def test_the_programs_write_the_same(model, program, tmp_path):
    model.save(tmp_path / "thing.json")
    program("pcl_sq_snapshot", tmp_path / "thing.json", "--export", tmp_path / "a.glb",
            "--export", tmp_path / "a.scene", "--export", tmp_path / "a.urdf", "--html",
            tmp_path / "a.html", "-q")
    for ending in ("glb", "scene", "urdf"):
        program_wrote = (tmp_path / ("a." + ending)).read_bytes()
        os.makedirs(tmp_path / "py", exist_ok=True)
        model.export(tmp_path / "py" / ("a." + ending))
        assert (tmp_path / "py" / ("a." + ending)).read_bytes() == program_wrote
    assert (tmp_path / "a.html").stat().st_size > 10000


def test_another_ending_is_refused(model, tmp_path):
    with pytest.raises(pcl_sq.OptionError, match="glb"):
        model.export(tmp_path / "thing.step")
    with pytest.raises(pcl_sq.Error):
        pcl_sq.Model.from_parts([]).export(tmp_path / "nothing.glb")


def test_models_and_grasps_are_as_their_schemas_say(model, bottle, program, tmp_path):
    validator = schema("model.schema.json")
    validator.validate(json.loads(model.to_json()))
    estimated = pcl_sq.estimate(bottle[1])
    validator.validate(json.loads(estimated.to_json()))
    tapered = pcl_sq.Model.from_parts([pcl_sq.Superquadric([1, 1, 2], taper=(0.2, 0.1))])
    validator.validate(json.loads(tapered.to_json()))
    broken = json.loads(model.to_json())
    broken["superquadrics"][0]["epsilon"] = [3, 1]
    assert not validator.is_valid(broken)
    estimated.save(tmp_path / "m.json")
    program("pcl_sq_grasp", tmp_path / "m.json", "-q", "-o", tmp_path / "g.json")
    schema("grasps.schema.json").validate(json.loads((tmp_path / "g.json").read_text()))


def test_each_line_of_many_clouds_is_as_its_schema_says(bottle, program, tmp_path):
    good = write_xyz(tmp_path / "good.xyz", bottle[1])
    (tmp_path / "bad.xyz").write_text("no numbers\n")
    done = program("pcl_sq_fit", good, tmp_path / "bad.xyz", "--jsonl", "-q", check=False)
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    assert ["error" in line for line in lines] == [False, True]
    validator = schema("line.schema.json")
    for line in lines:
        validator.validate(line)
    assert not validator.is_valid(dict(lines[0], error="both"))
    assert not validator.is_valid({"error": "of what?"})


def test_a_scene_of_moveit_names_object_and_table(tmp_path):
    file = pcl_sq.Model.from_parts([pcl_sq.Superquadric([0.1] * 3)])
    text = json.loads(file.to_json())
    text.update(table=[0, 0, 1, 0.1], version=3)
    pcl_sq.Model.from_json(json.dumps(text)).export(tmp_path / "ball.scene")
    lines = (tmp_path / "ball.scene").read_text().splitlines()
    assert lines[0] == "ball" and lines[-1] == "."
    assert [l for l in lines if l.startswith("* ")] == ["* ball", "* ball_table"]
    assert "sphere" in lines and np.isclose(float(lines[lines.index("sphere") + 1]), 0.1)

# SPDX-License-Identifier: BSD-3-Clause
"""Run by ctest with PYTHONPATH and PCL_SQ_BIN_DIR set to the build."""
import json
import os
import subprocess

import numpy as np
import pytest

import pcl_sq

BIN = os.environ.get("PCL_SQ_BIN_DIR", "")


@pytest.fixture
def program():
    """Runs one of our programs; its standard output. Skips where it is not built."""
    def run(name, *arguments, check=True):
        path = os.path.join(BIN, name)
        if not os.path.exists(path):
            pytest.skip(name + " is not built")
        done = subprocess.run([path] + [str(a) for a in arguments], capture_output=True,
                              text=True)
        if check and done.returncode:
            pytest.fail(done.stderr)
        return done
    return run


@pytest.fixture(scope="session")
def bottle():
    """A bottle of two parts and points on the side that a camera at the origin sees."""
    turn = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
    body = pcl_sq.Superquadric([0.04, 0.04, 0.07], epsilon=(0.2, 1.0), center=[0, 0.05, 0.7],
                               rotation=turn)
    neck = pcl_sq.Superquadric([0.015, 0.015, 0.05], epsilon=(0.2, 1.0),
                               center=[0, -0.06, 0.7], rotation=turn)
    parts = [body, neck]
    points = []
    for part, count in ((body, 3000), (neck, 800)):
        surface = part.sample(count, 1)
        seen = np.sum(part.normal(surface) * surface, axis=1) < 0
        points.append(surface[seen])
    noise = np.random.default_rng(0).normal(0, 0.0005, (sum(map(len, points)), 3))
    cloud = (np.vstack(points) + noise).astype(np.float32)
    return parts, cloud


def schema(name):
    """The validator of a schema of docs/schemas, which may name others there."""
    jsonschema = pytest.importorskip("jsonschema")
    folder = os.path.join(os.environ["PCL_SQ_SOURCE_DIR"], "docs", "schemas")
    contents = {}
    for file_name in os.listdir(folder):
        with open(os.path.join(folder, file_name)) as file:
            contents[file_name] = json.load(file)
        jsonschema.Draft7Validator.check_schema(contents[file_name])
    return jsonschema.Draft7Validator(contents[name], resolver=jsonschema.RefResolver(
        name, contents[name], store=contents))


def numbers(model):
    """What two equal models have in common: their bodies, to the bit."""
    text = model if isinstance(model, str) else model.to_json()
    return [[part[key] for key in ("semi_axes", "epsilon", "translation", "rotation")] +
            [part.get("taper"), part.get("rim"), part.get("wall")]
            for part in json.loads(text)["superquadrics"]]


def write_xyz(path, points):
    """Text that gives back the same floats."""
    with open(path, "w") as out:
        for p in np.asarray(points).reshape(-1, 3):
            out.write(" ".join(repr(float(c)) for c in p) + "\n")
    return path

# SPDX-License-Identifier: BSD-3-Clause
"""Every Python block of README.md and docs/, run as a reader would: in order, in one folder."""
import glob
import os
import re
import subprocess
import sys

import pytest

SOURCE = os.environ["PCL_SQ_SOURCE_DIR"]
PAGES = [os.path.join(SOURCE, "README.md")] + sorted(
    glob.glob(os.path.join(SOURCE, "docs", "**", "*.md"), recursive=True))
BLOCKS = {os.path.relpath(p, SOURCE): re.findall(r"^```python\n(.*?)^```", open(p).read(),
                                                 re.S | re.M) for p in PAGES}


@pytest.fixture(scope="module")
def scene(tmp_path_factory, program_path):
    folder = tmp_path_factory.mktemp("scene")
    sys.path.insert(0, os.path.join(SOURCE, "test", "commands"))
    import scene_files
    scene_files.depth_scene(str(folder))
    subprocess.run([program_path, "can.pcd", "-q", "-o", "can.json"], cwd=folder, check=True)
    return folder


@pytest.fixture(scope="module")
def program_path():
    path = os.path.join(os.environ.get("PCL_SQ_BIN_DIR", ""), "pcl_sq_fit")
    if not os.path.exists(path):
        pytest.skip("pcl_sq_fit is not built")
    return path


@pytest.mark.parametrize("page", [page for page, blocks in BLOCKS.items() if blocks])
def test_the_blocks_of_a_page_run(page, scene):
    code = "\n".join(BLOCKS[page])
    done = subprocess.run([sys.executable, "-c", code], cwd=scene, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_there_are_blocks():
    assert BLOCKS["README.md"] and sum(map(len, BLOCKS.values())) >= 6

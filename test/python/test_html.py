# SPDX-License-Identifier: BSD-3-Clause
"""The page to turn, in headless Chromium where there is one."""
import json
import os
import shutil
import subprocess

import numpy as np
import pytest

import pcl_sq
from imagefile import read_png

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


@pytest.fixture(scope="module")
def model(bottle):
    parts, cloud = bottle
    model = pcl_sq.Model.from_parts(parts)
    model.cloud = cloud
    model.colors = np.full(cloud.shape, 90, np.uint8)
    model.plan_grasps(count=3)
    return model


def screenshot(html, folder, script=""):
    """The page as a picture, after a script has run in it."""
    if CHROMIUM is None:
        pytest.skip("chromium is not installed")
    path = folder / "page.html"
    path.write_text(html.replace("</body>", "<script>%s</script></body>" % script))
    picture = folder / "page.png"
    try:
        done = run_chromium(path, picture, folder)
    except subprocess.TimeoutExpired:  # drawing without a graphics card on a busy machine
        pytest.skip("chromium took longer than the test waits")
    assert picture.exists(), done.stderr[-2000:]
    return read_png(picture).astype(int)


def run_chromium(path, picture, folder):
    """Headless, with WebGL drawn by the processor."""
    return subprocess.run(
        [CHROMIUM, "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
         "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
         "--window-size=800,600", "--virtual-time-budget=4000",
         "--user-data-dir=%s" % (folder / "profile"), "--screenshot=%s" % picture,
         "file://%s" % path], capture_output=True, text=True, timeout=240,
        env=dict(os.environ, HOME=str(folder)))


def painted(picture):
    """Pixels right of the list that are not white."""
    return (picture[:560, 260:].min(axis=2) < 245).sum()


def test_the_page_shows_the_model_and_a_click_takes_a_part_away(model, tmp_path):
    os.makedirs(tmp_path / "a")
    os.makedirs(tmp_path / "b")
    page = model.to_html("bottle")
    everything = screenshot(page, tmp_path / "a")
    assert painted(everything) > 5000
    clicks = "for (const id of ['part_1', 'cloud']) document.getElementById('show_' + id).click();"
    without = screenshot(page, tmp_path / "b", clicks)
    # blue is the first part's
    blue = [((p[:560, 260:, 2] - p[:560, 260:, 0]) > 60).sum() for p in (everything, without)]
    assert blue[0] > 2000 and blue[1] < 0.2 * blue[0], blue


def test_a_click_takes_a_thing_of_a_scene_away(tmp_path):
    things = [pcl_sq.Superquadric([0.04, 0.04, 0.06], epsilon=(0.2, 1.0), center=[x, 0, 0.7])
              for x in (-0.06, 0.06)]
    contents = {"schema": "pcl_sq/scene", "version": 1, "unit": "m", "objects": [
        json.loads(pcl_sq.Model.from_parts([t]).to_json()) for t in things]}
    page = pcl_sq.Scene.from_json(json.dumps(contents)).to_html("two")
    for name in "ab":
        os.makedirs(tmp_path / name)
    both = screenshot(page, tmp_path / "a")
    one = screenshot(page, tmp_path / "b", "document.getElementById('show_thing_2').click();")
    assert painted(both) > 3000 and painted(one) < 0.7 * painted(both)


def test_the_pointer_over_a_part_tells_its_size(model, tmp_path):
    script = ("const r = canvas.getBoundingClientRect(); let found = '';"
              "for (let y = 100; y < 500 && !found; y += 20) {"
              " canvas.dispatchEvent(new PointerEvent('pointermove',"
              "  {clientX: r.width / 2, clientY: y}));"
              " if (tip.style.display === 'block') found = tip.textContent; }"
              "document.body.style.background = found.includes('mm') ? '#00ff00' : '#ff0000';"
              "canvas.style.display = 'none';")
    picture = screenshot(model.to_html("bottle"), tmp_path, script)
    assert tuple(picture[300, 790]) == (0, 255, 0)


def test_fifty_thousand_points_stay_below_three_megabytes(model):
    big = pcl_sq.Model.from_parts(model.parts)
    big.cloud = np.random.default_rng(0).normal(0, 0.1, (200000, 3)) + [0, 0, 0.7]
    big.colors = np.zeros(big.cloud.shape, np.uint8)
    page = big.to_html()
    assert len(page) < 3 << 20
    assert "50000 of" not in page and '"of":' in page


def test_a_notebook_gets_the_page_by_itself(model, tmp_path):
    view = model.show("bottle", height=300)
    assert view._repr_html_().startswith("<iframe srcdoc=") and "<script>" not in view._repr_html_()
    view.save(tmp_path / "v.html")
    assert (tmp_path / "v.html").read_text() == view.html
    assert "http://" not in view.html and "https://" not in view.html

# SPDX-License-Identifier: BSD-3-Clause
import pickle
import subprocess
import sys

import numpy as np
import pytest

import pcl_sq


def ball(radius=2.0, center=(1.0, 0.0, 0.0)):
    return pcl_sq.Superquadric([radius] * 3, center=center)


def random_points(count=500):
    return np.random.default_rng(3).uniform(-4, 4, (count, 3))


def test_distances_of_a_ball_are_those_of_geometry():
    points = random_points()
    truth = np.linalg.norm(points - [1, 0, 0], axis=1) - 2.0
    np.testing.assert_allclose(ball().distance(points), truth, atol=1e-9)
    np.testing.assert_allclose(ball().distance(points, method="fast"), truth, atol=1e-5)
    assert np.array_equal(ball().contains(points), truth <= 0)
    np.testing.assert_allclose(np.linalg.norm(ball().closest_point(points) - [1, 0, 0], axis=1),
                               2.0, atol=1e-9)


@pytest.mark.parametrize("layout", ["float32", "columns", "every second", "reversed", "image",
                                    "fortran", "swapped bytes", "read only", "wide", "int"])
def test_every_layout_of_the_same_points_gives_the_same(layout):
    points = np.round(random_points(240) * 4) / 4  # exact in float32
    truth = ball().distance(points)
    shape = (240,)
    if layout == "float32":
        points = points.astype(np.float32)
    elif layout == "columns":
        points = np.ascontiguousarray(points.T).T
    elif layout == "every second":
        points = np.repeat(points, 2, axis=0)[::2]
    elif layout == "reversed":
        points, truth = points[::-1], truth[::-1]
    elif layout == "image":
        points, shape = points.reshape(12, 20, 3)[:, ::1], (12, 20)
    elif layout == "fortran":
        points = np.asfortranarray(points)
    elif layout == "swapped bytes":
        points = points.astype(">f8")
    elif layout == "read only":
        points.setflags(write=False)
    elif layout == "wide":
        wide = np.zeros((240, 8), np.float32)
        wide[:, 2:5] = points
        points = wide[:, 2:5]
    elif layout == "int":
        points = np.round(points).astype(np.int16)
        truth = ball().distance(points.astype(float))
    result = ball().distance(points)
    assert result.shape == shape
    assert np.array_equal(result.ravel(), truth)


def test_a_single_point_gives_a_number():
    assert ball().distance([4.0, 0.0, 0.0]) == pytest.approx(1.0)
    assert ball().contains([1.0, 0.0, 0.0]) is True
    assert np.isnan(ball().distance([np.nan, 0, 0]))


@pytest.mark.parametrize("wrong", [np.zeros((4, 2)), np.zeros(()), np.zeros((2, 2, 2, 3))])
def test_other_shapes_are_refused_with_a_sentence(wrong):
    with pytest.raises(ValueError, match="N x 3"):
        ball().distance(wrong)


@pytest.mark.parametrize("wrong", [np.zeros((4, 3), complex), np.full((4, 3), "a"),
                                   np.full((4, 3), None)])
def test_what_is_no_number_is_refused(wrong):
    with pytest.raises(TypeError, match="numbers"):
        ball().distance(wrong)


def test_a_body_out_of_range_is_refused_with_its_sentence():
    with pytest.raises(ValueError, match="no superquadric"):
        pcl_sq.Superquadric([1.0, -1.0, 1.0])
    with pytest.raises(ValueError, match="method"):
        ball().distance([[0.0, 0, 0]], method="nearly")


def test_a_mesh_is_closed_and_lies_on_the_surface():
    body = pcl_sq.Superquadric([0.1, 0.2, 0.3], epsilon=(0.3, 1.2))
    vertices, triangles = body.mesh()
    assert np.abs(body.gauge(vertices) - 1).max() < 1e-9
    edges = np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]))
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    corners = vertices[triangles]
    volume = np.sum(np.cross(corners[:, 0], corners[:, 1]) * corners[:, 2]) / 6
    assert volume == pytest.approx(body.volume, rel=0.02)


def test_a_union_takes_the_nearest_part():
    union = pcl_sq.MultiSuperquadric([ball(center=(0, 0, 0)), ball(center=(10.0, 0, 0))])
    points = np.array([[4.0, 0, 0], [7.0, 0, 0], [0, 0, 0]])
    np.testing.assert_allclose(union.distance(points), [2, 1, -2])
    assert union.nearest_part(points).tolist() == [0, 1, 0]
    assert union.nearest_part(points[1]) == 1  # one point, one number
    assert union.nearest_part([[np.nan, 0, 0]]).tolist() == [-1]
    assert len(union) == len(union.parts) == 2
    with pytest.raises(IndexError):
        union[2]


def test_pickled_bodies_are_the_same():
    body = pcl_sq.Superquadric([1, 2, 3], epsilon=(0.5, 0.7), taper=(0.1, -0.2), rim=0.5,
                               wall=0.1)
    bent = pcl_sq.Superquadric([0.02, 0.02, 0.1], bend=(5.0, 0.3))
    assert pickle.loads(pickle.dumps(bent)).bend == (5.0, 0.3)
    again = pickle.loads(pickle.dumps(body))
    assert repr(again) == repr(body) and again.wall == body.wall and again.rim == body.rim


def test_a_fit_finds_the_body_that_points_lie_on():
    body = pcl_sq.Superquadric([0.05, 0.08, 0.12], epsilon=(0.4, 0.8), center=[0.1, 0.2, 0.9])
    points = body.sample(3000) + np.random.default_rng(1).normal(0, 2e-4, (3000, 3))
    fit = pcl_sq.fit_superquadric(points)
    assert np.abs(body.distance(fit.superquadric.mesh().vertices)).max() < 2e-3
    assert fit.sigma == pytest.approx(2e-4, rel=0.2)
    same = pcl_sq.fit_superquadric(points.astype(np.float32))
    np.testing.assert_allclose(same.superquadric.sides, fit.superquadric.sides, rtol=1e-3)


def test_points_that_allow_no_fit_are_told_why():
    with pytest.raises(pcl_sq.Error, match="too few"):
        pcl_sq.fit_superquadric(np.zeros((3, 3)))
    with pytest.raises(pcl_sq.Error, match="line"):
        pcl_sq.fit_superquadric(np.outer(np.arange(100.0), [1, 2, 3]))
    with pytest.raises(ValueError):
        pcl_sq.fit_superquadric(np.zeros((30, 3)), max_epsilon=7)


def test_an_import_loads_neither_opencv_nor_vtk():
    code = ("import pcl_sq; libraries = open('/proc/self/maps').read().lower(); "
            "assert 'vtk' not in libraries and 'opencv' not in libraries")
    subprocess.run([sys.executable, "-c", code], check=True)

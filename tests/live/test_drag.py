# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drag makes of a handle's pose, in the coordinates of the object."""

import numpy as np
import pytest
from pure import load

drag = load("drag", "handles/gizmos")

IDENTITY = tuple(np.eye(4).ravel().tolist())
TURNED = np.array([[0.36, -0.8, 0.48], [0.48, 0.6, 0.64], [-0.8, 0.0, 0.6]])
LINEARS = {
    "plain": np.eye(3),
    "turned": TURNED,
    "stretched": TURNED @ np.diag([1.0, 2.0, -0.5]),
    "sheared": np.array([[1.0, 0.4, 0.0], [0.0, 2.0, 0.3], [0.0, 0.0, 1.0]]),
}
POSE = np.eye(4)
POSE[:3] = np.column_stack((TURNED.T @ np.diag([1.5, 1.0, 0.5]), [0.3, -0.2, 0.7]))
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1.0)])


def begin(linear, pose, axes=None):
    matrix = np.float32(pose)
    axes = np.eye(3) if axes is None else axes
    values = tuple(matrix.astype(float).ravel().tolist())
    return drag.Drag(values, linear, seen(CORNERS, values).mean(axis=0), axes)


def seen(points, pose):
    """Return where a pose takes points of the object, in its coordinates."""
    matrix = np.reshape(pose, (4, 4))
    return points @ matrix[:3, :3].T + matrix[:3, 3]


@pytest.mark.parametrize("pose", [np.eye(4), POSE], ids=["at rest", "posed"])
@pytest.mark.parametrize("linear", LINEARS.values(), ids=LINEARS)
def test_the_world_sees_what_the_mouse_does(linear, pose):
    d = begin(linear, pose, TURNED)
    before = seen(CORNERS, d.pose) @ linear.T
    centre = d.center @ linear.T

    moved = seen(CORNERS, d.moved([0.5, -1.0, 2.0])) @ linear.T
    np.testing.assert_allclose(moved, before + [0.5, -1.0, 2.0], atol=1e-5)

    turned = seen(CORNERS, d.turned([0.0, 0.0, 1.0], np.pi / 2)) @ linear.T
    way = before - centre
    wanted = centre + np.column_stack((-way[:, 1], way[:, 0], way[:, 2]))
    np.testing.assert_allclose(turned, wanted, atol=1e-5)

    scaled = seen(CORNERS, d.scaled([2.0, 1.0, 0.5])) @ linear.T
    wanted = way @ TURNED * [2.0, 1.0, 0.5]
    np.testing.assert_allclose((scaled - centre) @ TURNED, wanted, atol=1e-5)


@pytest.mark.parametrize("linear", LINEARS.values(), ids=LINEARS)
def test_without_a_motion_the_pose_is_the_same_bit_for_bit(linear):
    d = begin(linear, POSE)
    assert d.moved([0, 0, 0]) == d.turned([0, 1, 0], 0.0) == d.scaled([1, 1, 1]) == d.pose


def test_moving_changes_nothing_but_the_place():
    pose = np.reshape(begin(LINEARS["sheared"], POSE).moved([3.0, 4.0, 5.0]), (4, 4))
    assert np.array_equal(pose[:3, :3], np.float32(POSE)[:3, :3])
    assert pose[3].tolist() == [0.0, 0.0, 0.0, 1.0]


def test_poses_are_of_single_precision():
    d = begin(LINEARS["turned"], POSE)
    for pose in (d.moved([0.1, 0.2, 0.3]), d.turned([1, 0, 0], 0.1), d.scaled([1.1, 1, 1])):
        assert np.array_equal(np.float32(pose), pose)


def test_nothing_is_scaled_flat_or_turned_inside_out():
    d = begin(np.eye(3), IDENTITY)
    for factor in (0.0, -2.0):
        sizes = np.diag(np.reshape(d.scaled([factor, 1.0, 1.0]), (4, 4)))
        np.testing.assert_allclose(sizes, [drag.SMALLEST_FACTOR, 1, 1, 1])

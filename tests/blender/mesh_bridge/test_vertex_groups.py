# SPDX-License-Identifier: GPL-3.0-or-later
import bpy
import numpy as np
import pytest


@pytest.fixture
def cube():
    bpy.ops.mesh.primitive_cube_add()
    return bpy.context.object


def test_weights(bridge, cube):
    for name in ("Other", "Map"):
        cube.vertex_groups.new(name=name).add([0, 2], 0.75, "REPLACE")
    cube.vertex_groups["Other"].add([3, 5], 0.5, "REPLACE")
    cube.vertex_groups["Map"].add([2, 5], 0.25, "REPLACE")
    cube.vertex_groups["Map"].add([6], 0.0, "REPLACE")
    weights = bridge.group_weights(cube, "Map")
    assert weights.dtype == np.float64
    assert weights.tolist() == [0.75, 0, 0.25, 0, 0, 0.25, 0, 0]
    both = bridge.weights_of_groups(cube, ("Other", "Map"))
    assert both["Map"].tolist() == weights.tolist()
    assert both["Other"].tolist() == [0.75, 0, 0.75, 0.5, 0, 0.5, 0, 0]


def test_empty_group(bridge, cube):
    cube.vertex_groups.new(name="Map")
    assert bridge.group_weights(cube, "Map").tolist() == [0] * 8


@pytest.mark.parametrize("name", ["Missing", "map", ""])
def test_missing_group(bridge, error, cube, name):
    cube.vertex_groups.new(name="Map")
    with pytest.raises(error, match=f'"Cube" has no vertex group "{name}"; pick another'):
        bridge.group_weights(cube, name)

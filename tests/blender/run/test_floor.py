# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep on Floor: what stands on the ground stands there afterwards."""

import bpy
import numpy as np
import pytest
from live_steps import bits, confirm
from mathutils import Euler, Matrix
from rich_mesh import position_of
from scene import add_monkey, cubify, select


def heights(obj):
    world = np.array(obj.matrix_world, dtype=np.float64)
    return position_of(obj.data) @ world[2, :3] + world[2, 3]


@pytest.mark.parametrize("space", ["OBJECT", "WORLD"])
def test_the_lowest_point_keeps_its_height(space):
    obj = add_monkey()
    obj.matrix_world = Matrix.LocRotScale((1, 2, 3), Euler((0.7, 0.9, 0.2)), (1.0, 2.0, 0.5))
    bpy.context.view_layer.update()
    before = heights(obj).min()
    cubify(space=space)
    sunk = heights(obj).min() - before
    assert abs(sunk) > 1e-4
    cubify(space=space, floor="ON")
    assert heights(obj).min() == pytest.approx(before, abs=2e-6)


def test_of_several_objects_those_keep_it_that_stand():
    standing, hovering = add_monkey("Standing"), add_monkey("Hovering", location=(5, 0, 2))
    select(standing, hovering)
    cubify()
    free = [heights(obj) for obj in (standing, hovering)]
    bpy.ops.cubic_craft.restore()
    before = heights(standing).min()
    cubify(floor="ON")
    assert heights(standing).min() == pytest.approx(before, abs=2e-6)
    assert heights(standing).min() != pytest.approx(free[0].min(), abs=1e-3)
    assert heights(hovering) == pytest.approx(free[1], abs=2e-6)


def test_live_follows_when_the_object_is_turned(begin, live):
    obj, other = add_monkey(), add_monkey("Other")
    turn = Euler((1.0, 0.2, 0.0)).to_matrix().to_4x4()
    session = begin(obj, floor="ON", space="OBJECT")
    for one in (obj, other):
        one.matrix_world = turn
    bpy.context.view_layer.update()
    session.wake()
    confirm(live, session)
    select(other)
    cubify(floor="ON", space="OBJECT", max_iterations=1000)
    assert bits(obj) == bits(other)

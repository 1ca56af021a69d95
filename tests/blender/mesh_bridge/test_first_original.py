# SPDX-License-Identifier: GPL-3.0-or-later
"""*From Here* replaces the original; the first one stays on the mesh until Apply."""

import bpy
import numpy as np
import pytest
from rich_mesh import points_of, position_of, set_position
from scene import add_monkey, select
from sculpting import check_bits, check_near, sculpt, shapes_of
from snapshot import STORED, unchanged


def test_there_is_none_before_from_here(bridge, cubify, error, monkey):
    mesh = monkey.data
    assert not bridge.has_first(mesh) and not bridge.has_first(None)
    cubify(monkey)
    sculpt(monkey)
    for start in ("EDITS", "ORIGINAL"):
        cubify(monkey, start=start)
        assert not bridge.has_first(mesh)
    with unchanged(monkey), pytest.raises(error, match='"Suzanne" is the only one: use Restore'):
        bridge.restore_first(monkey)


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_the_first_is_restored_bit_for_bit(bridge, cubify, monkey, result):
    before = shapes_of(monkey)
    cubify(monkey, seed=1)
    sculpt(monkey)
    made = cubify(monkey, result, 2, "HERE")
    assert bridge.has_first(made.data)
    bridge.restore_first(made)
    check_bits(shapes_of(made), before)
    assert not bridge.has_traces(made.data)


def test_it_stays_the_first(bridge, cubify, monkey):
    """However often the shape there was is taken for the original."""
    before = shapes_of(monkey)
    for seed in (1, 2, 3):
        cubify(monkey, seed=seed)
        sculpt(monkey, slice(30 * seed, 30 * seed + 40))
    cubify(monkey, seed=4)
    cubify(monkey, seed=5)
    bridge.restore_first(monkey)
    assert shapes_of(monkey)[0].tobytes() == before[0].tobytes()
    check_near(shapes_of(monkey), before)


def test_strokes_that_were_kept_are_part_of_here(bridge, cubify, plain_monkey):
    mesh = plain_monkey.data
    before = position_of(mesh)
    cubify(plain_monkey, seed=1)
    sculpt(plain_monkey)
    cubify(plain_monkey, seed=2, start="EDITS")
    here = position_of(mesh)
    assert bridge.starts_here(mesh) and not bridge.starts_here(mesh, "EDITS")
    cubify(plain_monkey, seed=3)
    assert not bridge.has_strokes(mesh)
    bridge.restore(plain_monkey)
    assert position_of(mesh).tobytes() == here.tobytes()
    bridge.restore_first(plain_monkey)
    assert position_of(mesh).tobytes() == before.tobytes()


def test_restore_leaves_it(bridge, cubify, error, monkey):
    """And so do the next results of the restored shape, also once that was edited."""
    mesh = monkey.data
    before = position_of(mesh)
    cubify(monkey, seed=1)
    sculpt(monkey)
    with unchanged(monkey, STORED):
        cubify(monkey, seed=2)
        bridge.restore(monkey)
    assert bridge.has_first(mesh) and not bridge.has_original(mesh)
    with unchanged(monkey), pytest.raises(error, match="Restore First brings back the first"):
        bridge.restore(monkey)
    sculpt(monkey, slice(70, 80))
    cubify(monkey, seed=3)
    bridge.restore_first(monkey)
    assert position_of(mesh).tobytes() == before.tobytes()


def test_it_is_transformed_with_the_mesh(bridge, cubify, monkey):
    mesh = monkey.data
    before = shapes_of(monkey)
    ways = (np.diag([2.0, 2.0, 2.0]), np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], float))

    def transform(linear):
        keys = mesh.shape_keys.key_blocks if mesh.shape_keys else ()
        moved = {key.name: points_of(mesh, key.name) @ linear.T for key in keys}
        set_position(mesh, position_of(mesh) @ linear.T)
        for name, points in moved.items():
            keys[name].points.foreach_set("co", points.astype(np.float32).ravel())

    cubify(monkey, seed=1)
    sculpt(monkey)
    cubify(monkey, seed=2)
    transform(ways[0])
    sculpt(monkey, slice(100, 120))
    cubify(monkey, seed=3)
    transform(ways[1])
    bridge.restore_first(monkey)
    whole = (ways[1] @ ways[0]).T
    check_near(shapes_of(monkey), [points @ whole for points in before], 1e-5)


def test_joined_meshes_go_back_each_to_its_own(bridge, cubify):
    one, other, never = (add_monkey(name) for name in ("One", "Other", "Never"))
    before = position_of(one.data)
    for obj in (one, other):
        cubify(obj, seed=1)
    sculpt(one)
    cubify(one, seed=2)
    select(one, other, never)
    assert bpy.ops.object.join() == {"FINISHED"}
    bridge.restore_first(one)
    assert np.array_equal(position_of(one.data), np.tile(before, (3, 1)))

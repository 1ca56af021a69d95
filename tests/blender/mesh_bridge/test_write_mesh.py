# SPDX-License-Identifier: GPL-3.0-or-later

import bpy
import numpy as np
import pytest
from rich_mesh import cubic_like, points_of, position_of, set_position
from snapshot import POSITIONS, SHAPE_KEY_POINTS, STORED, unchanged

LOOSE = slice(-4, None)  # what the rich monkey has in no face
CHANGED = POSITIONS + SHAPE_KEY_POINTS + STORED


def test_only_positions_change(bridge, monkey):
    mesh = monkey.data
    with unchanged(monkey, CHANGED):
        base = bridge.read_positions(mesh)
        positions, rotations = cubic_like(base)
        bridge.write_mesh(mesh, positions, rotations)
    expected = np.vstack((positions[:-4], base[LOOSE]))
    assert bridge.read_positions(mesh).tobytes() == expected.tobytes()
    assert position_of(mesh).tobytes() == expected.tobytes()
    assert bridge.has_original(mesh)
    assert bridge.original_positions(mesh).tobytes() == base.tobytes()


def test_blender_notices(bridge, monkey):
    """The viewport, selection and ray casts use cached bounds, normals and triangles."""
    mesh = monkey.data
    monkey.modifiers.clear()
    if mesh.shape_keys:
        for key in mesh.shape_keys.key_blocks[1:]:
            key.driver_remove("value")
            key.mute = True
    graph = bpy.context.evaluated_depsgraph_get()
    assert monkey.evaluated_get(graph).bound_box is not None
    normal = mesh.vertices[0].normal.copy()
    mesh.calc_loop_triangles()
    bridge.write_mesh(mesh, *cubic_like(4 * bridge.read_positions(mesh)))
    written = bridge.read_positions(mesh)
    graph = bpy.context.evaluated_depsgraph_get()
    evaluated = monkey.evaluated_get(graph)
    assert np.array_equal(position_of(evaluated.data), written)
    for obj in (monkey, evaluated):
        assert np.array_equal(np.max(obj.bound_box, axis=0), written.max(axis=0))
    assert mesh.vertices[0].normal != normal
    fresh = mesh.copy()
    set_position(fresh, written)
    fresh.vertices[0].co = fresh.vertices[0].co
    for copy in (mesh, fresh):
        copy.calc_loop_triangles()
    assert [t.vertices[:] for t in mesh.loop_triangles] == [
        t.vertices[:] for t in fresh.loop_triangles
    ]


@pytest.mark.parametrize("active", [0, 1])
def test_edit_mode_and_back_changes_nothing(bridge, cubify, monkey, active):
    mesh = monkey.data
    monkey.active_shape_key_index = active
    _toggle_edit_mode()  # Blender itself turns -0 into 0 in shape keys at the first time
    before = _shapes(mesh)
    cubify(monkey)
    written = _shapes(mesh)
    _toggle_edit_mode()
    assert _shapes(mesh) == written
    assert bridge.has_original(mesh)
    bridge.restore(monkey)
    assert _shapes(mesh) == before


def _shapes(mesh):
    keys = mesh.shape_keys.key_blocks if mesh.shape_keys else []
    return [position_of(mesh).tobytes()] + [points_of(mesh, key.name).tobytes() for key in keys]


def _toggle_edit_mode():
    for mode in ("EDIT", "OBJECT"):
        bpy.ops.object.mode_set(mode=mode)

# SPDX-License-Identifier: GPL-3.0-or-later
"""A preview taken back in Edit Mode, as after a file was saved with one on and opened elsewhere."""

import bmesh
import bpy
import numpy as np
import pytest
from previewed import add_monkey, live_attributes, show_some
from rich_mesh import points_of, position_of
from snapshot import STORED, differences, snapshot_object

# Edit Mode numbers all attributes anew, so that any one may become the active one.
_OF_EDIT_MODE = ("*attributes/order", "*attributes/active", "*attributes/active index")


@pytest.fixture
def mode():
    def set_mode(obj, name):
        for other in bpy.context.view_layer.objects:  # all selected ones enter Edit Mode
            other.select_set(other == obj)
        bpy.context.view_layer.objects.active = obj
        bpy.ops.object.mode_set(mode=name)

    yield set_mode
    if bpy.context.object and bpy.context.object.mode == "EDIT":
        bpy.ops.object.mode_set(mode="OBJECT")


def through_edit_mode(obj, mode):
    """Tell what Edit Mode alone makes of an object: it drops the sign of zeros in shape keys."""
    mode(obj, "EDIT")
    mode(obj, "OBJECT")
    return snapshot_object(obj)


KEYS = {
    "plain": 0,
    "cubified": 0,
    "keys": 5,
    "cubified keys": 5,
    "Cubic": 2,
    "Cubic beside keys": 6,
}
"""how many shape keys there are"""


@pytest.mark.thorough(10)
@pytest.mark.parametrize(
    ("state", "active"), [(state, n) for state, count in KEYS.items() for n in range(count or 1)]
)
def test_all_bits_are_there_after_edit_mode(bridge, mode, state, active):
    obj = add_monkey(bridge, state)
    mesh = obj.data
    assert KEYS[state] == (len(mesh.shape_keys.key_blocks) if mesh.shape_keys else 0)
    base = position_of(mesh)
    if KEYS[state]:
        obj.active_shape_key_index = active
    before = through_edit_mode(obj, mode)
    show_some(bridge, mesh)
    mode(obj, "EDIT")
    assert bridge.end_preview(mesh)
    assert obj.mode == "EDIT" and not bridge.has_preview(mesh)
    assert not bridge.end_preview(mesh)
    mode(obj, "OBJECT")
    assert differences(before, snapshot_object(obj), ignore=_OF_EDIT_MODE) == []
    assert live_attributes(mesh) == []
    assert bridge.has_original(mesh) == (state not in ("plain", "keys"))
    if not KEYS[state]:  # then Edit Mode loses nothing, not even the sign of zeros
        assert position_of(mesh).tobytes() == base.tobytes()


@pytest.mark.parametrize("result", ["Edit Mode", "later"])
def test_active_key_changed_in_edit_mode(bridge, mode, keyed_monkey, result):
    obj, mesh = keyed_monkey, keyed_monkey.data
    before = through_edit_mode(obj, mode)
    show_some(bridge, mesh)
    mode(obj, "EDIT")
    for active in (1, 4, 0):
        obj.active_shape_key_index = active
    if result == "later":
        mode(obj, "OBJECT")
    assert bridge.end_preview(mesh)
    obj.active_shape_key_index = 2
    if result != "later":
        mode(obj, "OBJECT")
    after = snapshot_object(obj)
    changed = differences(before, after, ignore=_OF_EDIT_MODE)
    assert [path for path in changed if not path.endswith("points")] == []
    for path in changed:  # dependent on the Basis, and so without the sign of zeros
        one, other = (np.frombuffer(taken[path], np.float32) for taken in (before, after))
        assert np.array_equal(one, other)


def _move(bm):
    bm.verts[3].co.x += 1


def _add(bm):
    bm.verts.new((1, 2, 3))


def _delete(bm):
    bmesh.ops.delete(bm, geom=[bm.verts[3]], context="VERTS")


@pytest.mark.parametrize("edit", [_move, _add, _delete])
@pytest.mark.parametrize("state", ["plain", "cubified", "keys"])
def test_shape_of_the_artist_is_kept(bridge, mode, state, edit):
    obj = add_monkey(bridge, state)
    mesh = obj.data
    obj.active_shape_key_index = 0
    show_some(bridge, mesh)
    copy = obj.copy()
    copy.data = mesh.copy()
    bpy.context.collection.objects.link(copy)
    shapes = []
    for each in (copy, obj):
        mode(each, "EDIT")
        bm = bmesh.from_edit_mesh(each.data)
        bm.verts.ensure_lookup_table()
        edit(bm)
        bmesh.update_edit_mesh(each.data)
        if each == obj:
            assert bridge.end_preview(mesh)
        mode(each, "OBJECT")
        keys = each.data.shape_keys.key_blocks.keys() if each.data.shape_keys else []
        shapes.append([position_of(each.data).tobytes()])
        shapes[-1] += [points_of(each.data, name).tobytes() for name in keys]
    assert shapes[0] == shapes[1]
    assert live_attributes(mesh) == [] and not bridge.has_preview(mesh)


def test_faces_deleted_and_vertices_kept(bridge, mode, plain_monkey):
    mesh = plain_monkey.data
    base = position_of(mesh)
    show_some(bridge, mesh)
    mode(plain_monkey, "EDIT")
    bm = bmesh.from_edit_mesh(mesh)
    bmesh.ops.delete(bm, geom=bm.faces[:5], context="FACES_ONLY")
    assert bridge.end_preview(mesh)
    mode(plain_monkey, "OBJECT")
    assert position_of(mesh).tobytes() == base.tobytes()


@pytest.mark.parametrize("state", ["plain", "keys"])
def test_undo_in_edit_mode(bridge, mode, state):
    obj = add_monkey(bridge, state)
    name, before = obj.name, through_edit_mode(obj, mode)
    show_some(bridge, obj.data)
    mode(obj, "EDIT")
    bpy.ops.ed.undo_push(message="Edit Mode with a preview on")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.translate(value=(1, 0, 0))
    bpy.ops.ed.undo_push(message="moved")
    bpy.ops.ed.undo()
    mesh = bpy.data.objects[name].data
    assert mesh.is_editmode
    assert bridge.end_preview(mesh)
    mode(bpy.data.objects[name], "OBJECT")
    after = snapshot_object(bpy.data.objects[name])
    selection = ("*.select_*", "*total_*_sel", "*rna/is_evaluated")
    assert differences(before, after, ignore=(*_OF_EDIT_MODE, *selection)) == []


@pytest.mark.parametrize("edited", [False, True])
def test_left_on_through_edit_mode(bridge, mode, monkey, edited):
    mesh = monkey.data
    monkey.active_shape_key_index = 0
    before = through_edit_mode(monkey, mode)
    show_some(bridge, mesh)
    mode(monkey, "EDIT")
    if edited:
        _move_first(mesh)
    mode(monkey, "OBJECT")
    shown = snapshot_object(monkey)
    assert bridge.end_preview(mesh)
    after = snapshot_object(monkey)
    if edited:
        assert differences(shown, after, ignore=STORED) == []
    else:
        assert differences(before, after, ignore=_OF_EDIT_MODE) == []


def _move_first(mesh):
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    bm.verts[0].co.z += 1
    bmesh.update_edit_mesh(mesh)

# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of a pose when object and empties are renamed, saved, copied or moved."""

import bpy
import numpy as np
from posing import LEFT, RIGHT, add_posable, pose
from rich_mesh import position_of
from scene import cubify, select

FAR = {"location": (40, -30, 20), "rotation_euler": (1, 2, 3), "scale": (2, 2, 2)}


def put(obj, where):
    for name, value in where.items():
        setattr(obj, name, value)
    bpy.context.view_layer.update()


def solved(obj):
    select(obj)
    assert cubify() == {"FINISHED"}
    return position_of(obj.data)


def test_a_deleted_target_stays_deleted_in_the_file(posed, reopen):
    obj, _, _ = add_posable()
    select(pose(obj))
    bpy.ops.object.delete()
    before = posed(obj)
    assert posed(reopen("Body")) == before


def duplicate(*objects, linked=False):
    """Duplicate as Shift-D or Alt-D does; return the copy of the first."""
    select(*objects)
    bpy.ops.object.duplicate(linked=linked)
    return bpy.context.object


def test_a_copy_of_the_object_alone_keeps_the_pose_where_it_is_moved(posed):
    obj, _, _ = add_posable()
    obj.cubic_craft.space = "OBJECT"  # the cube turns with the copy
    empty = pose(obj)
    shape = solved(obj)
    copy = duplicate(obj)
    assert copy.cubic_craft.handles[1].target == empty
    put(copy, FAR)
    assert posed(copy) == posed(obj)
    put(copy, {"scale": (1, 1, 1)})
    np.testing.assert_array_equal(solved(copy), shape)
    empty.location.z += 0.3  # poses both
    assert posed(copy) == posed(obj)
    np.testing.assert_array_equal(solved(copy), solved(obj))


def test_a_copy_with_its_empties_has_a_pose_of_its_own(posed):
    obj, _, _ = add_posable()
    empty = pose(obj)
    before = posed(obj)
    copy = duplicate(obj, empty)
    own = copy.cubic_craft.handles[1].target
    assert own not in (empty, None) and own.parent == copy
    put(copy, FAR)
    assert posed(copy) == before
    own.location.z += 1
    assert posed(copy) != before
    assert posed(obj) == before
    select(own)
    bpy.ops.cubic_craft.handle_remove()
    assert posed(obj) == before


def test_a_linked_copy_has_the_same_pose_and_the_same_shape(posed):
    obj, _, _ = add_posable()
    obj.cubic_craft.space = "OBJECT"  # the cube turns with the copy
    pose(obj)
    copy = duplicate(obj, linked=True)
    assert copy.data == obj.data
    put(copy, {"location": (3, 2, 1), "rotation_euler": (1, 2, 3)})
    assert posed(copy) == posed(obj)
    select(obj, copy)
    assert cubify() == {"FINISHED"}
    alone = position_of(obj.data)
    np.testing.assert_array_equal(solved(copy), alone)


def test_renaming_a_vertex_group(posed):
    obj, left, _ = add_posable()
    pose(obj)
    obj.cubic_craft.map_group = obj.cubic_craft.detail_group = RIGHT
    before = position_of(obj.data)
    bpy.context.view_layer.update()
    for old, new in ((LEFT, "Foot"), (RIGHT, "Hand"), ("Foot", "Paw")):
        obj.vertex_groups[old].name = new
        bpy.context.view_layer.update()
    assert [handle.group for handle in obj.cubic_craft.handles] == ["Paw", "Hand"]
    assert obj.cubic_craft.map_group == obj.cubic_craft.detail_group == "Hand"
    assert solved(obj)[left].tobytes() == before[left].tobytes()


def test_renaming_a_vertex_group_after_loading(reopen):
    obj, _, _ = add_posable()
    pose(obj)
    obj = reopen("Body")
    obj.vertex_groups[LEFT].name = "Foot"
    bpy.context.view_layer.update()
    assert [handle.group for handle in obj.cubic_craft.handles] == ["Foot", RIGHT]


def test_undo_and_redo_of_a_rename():
    obj, _, _ = add_posable()
    pose(obj)
    bpy.ops.ed.undo_push(message="Posed")
    bpy.context.view_layer.update()
    obj.vertex_groups[LEFT].name = "Foot"
    bpy.ops.ed.undo_push(message="Renamed")  # before the add-on can see it, as in a window
    bpy.context.view_layer.update()
    bpy.data.objects["Body"].location.x = 1
    bpy.ops.ed.undo_push(message="Moved")
    for undo, name in (
        (bpy.ops.ed.undo, "Foot"),
        (bpy.ops.ed.undo, LEFT),
        (bpy.ops.ed.redo, "Foot"),
    ):
        undo()
        bpy.context.view_layer.update()
        obj = bpy.data.objects["Body"]
        assert obj.cubic_craft.handles[0].group == name
        assert name in obj.vertex_groups


def test_other_changes_of_the_vertex_groups_are_no_rename():
    obj, _, _ = add_posable()
    pose(obj)
    bpy.context.view_layer.update()
    obj.vertex_groups.new(name="More")
    obj.vertex_groups.active_index = 2
    bpy.ops.object.select_all(action="DESELECT")
    select(obj)
    bpy.ops.object.vertex_group_move(direction="UP")
    obj.vertex_groups.remove(obj.vertex_groups[LEFT])
    bpy.context.view_layer.update()
    assert [handle.group for handle in obj.cubic_craft.handles] == [LEFT, RIGHT]

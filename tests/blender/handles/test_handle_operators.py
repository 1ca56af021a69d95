# SPDX-License-Identifier: GPL-3.0-or-later
"""The buttons of the section "Handles", each as one undo step."""

import importlib

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Vector
from posing import IDENTITY, LEFT, RIGHT, add_posable, pin, pose
from recorder import Recorder
from rich_mesh import position_of
from scene import add_empty, add_monkey, cubify, select


@pytest.fixture
def shown(extension):
    """Return `panel_object` of the installed extension."""
    module = f"{extension.__name__}.cubic_craft_addon.handles.owner"
    return importlib.import_module(module).panel_object


def groups(name="Body"):
    return [handle.group for handle in bpy.data.objects[name].cubic_craft.handles]


def click(operator, **options):
    """Run an operator as a click on its button does, with its undo step."""
    assert operator("INVOKE_DEFAULT", True, **options) == {"FINISHED"}


def test_the_section_has_a_button_for_each(part):
    obj, _, _ = add_posable()
    pin(obj, LEFT)
    pin(obj, RIGHT)
    layout = Recorder()
    part("handles.panel").draw(layout, obj)
    verbs = ("add", "remove", "pin_selection", "reset_pose")
    assert {f"cubic_craft.handle_{verb}" for verb in verbs} <= set(layout.drawn)
    assert {"handles", "group", "threshold", "hold_rest"} <= set(layout.drawn)


def test_add_takes_the_active_group_then_the_others():
    obj, _, _ = add_posable()
    obj.vertex_groups.active_index = 1
    bpy.ops.ed.undo_push(message="Before")
    click(bpy.ops.cubic_craft.handle_add)
    click(bpy.ops.cubic_craft.handle_add)
    assert groups() == [RIGHT, LEFT]
    assert obj.cubic_craft.active_handle == 1
    with pytest.raises(RuntimeError, match="Every vertex group already has a handle"):
        bpy.ops.cubic_craft.handle_add()
    bpy.ops.ed.undo()
    assert groups() == [RIGHT]
    bpy.ops.ed.undo()
    assert groups() == []


def test_add_takes_no_map_unasked():
    obj, _, _ = add_posable()
    for name in ("Map", "Details"):
        obj.vertex_groups.active = obj.vertex_groups.new(name=name)
    obj.cubic_craft.map_group, obj.cubic_craft.detail_group = "Map", "Details"
    for add, entries in (
        (bpy.ops.cubic_craft.handle_add, obj.cubic_craft.handles),
        (bpy.ops.cubic_craft.region_add, obj.cubic_craft.regions),
    ):
        add()
        add()
        assert [entry.group for entry in entries] == [LEFT, RIGHT]
        with pytest.raises(RuntimeError, match="or is a map"):
            add()
        add(group="Map")
        assert entries[-1].group == "Map"


def test_add_refuses_a_group_that_is_not_there_or_has_a_handle():
    add_posable()
    bpy.ops.cubic_craft.handle_add(group=LEFT)
    with pytest.raises(RuntimeError, match='"Left" already has a handle'):
        bpy.ops.cubic_craft.handle_add(group=LEFT)
    with pytest.raises(RuntimeError, match='"Body" has no vertex group "Ear"'):
        bpy.ops.cubic_craft.handle_add(group="Ear")


def test_what_is_missing_is_said_before_the_click():
    add_monkey()
    with pytest.raises(RuntimeError, match="no vertex group; add one, or use Pin Selection"):
        bpy.ops.cubic_craft.handle_add()
    for verb in ("remove", "follow"):
        with pytest.raises(RuntimeError, match="Add a handle first"):
            getattr(bpy.ops.cubic_craft, f"handle_{verb}")()
    with pytest.raises(RuntimeError, match="No handle is posed or follows anything"):
        bpy.ops.cubic_craft.handle_reset_pose()
    bpy.context.view_layer.objects.active = None
    for verb in ("add", "remove", "follow", "reset_pose"):
        with pytest.raises(RuntimeError, match="Make a mesh object active first"):
            getattr(bpy.ops.cubic_craft, f"handle_{verb}")()


def select_vertices(obj, indices):
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="VERT")
    bpy.ops.mesh.select_all(action="DESELECT")
    edited = bmesh.from_edit_mesh(obj.data)
    edited.verts.ensure_lookup_table()
    for index in indices:
        edited.verts[index].select = True
    edited.select_flush(True)
    bmesh.update_edit_mesh(obj.data)


def test_pin_selection_in_edit_mode_is_one_undo_step():
    obj = add_monkey()
    before = position_of(obj.data)
    select_vertices(obj, [3, 5, 7])
    bpy.ops.ed.undo_push(message="Select")
    click(bpy.ops.cubic_craft.handle_pin_selection)
    obj = bpy.context.object
    assert groups("Suzanne") == ["Handle"]
    assert [g.name for g in obj.vertex_groups] == ["Handle"]
    cubify(cubeness=0.8)
    after = position_of(obj.data)
    assert [i for i in range(9) if after[i].tobytes() == before[i].tobytes()] == [3, 5, 7]
    bpy.ops.ed.undo()
    obj = bpy.context.object
    assert bpy.context.mode == "EDIT_MESH"
    assert groups("Suzanne") == []
    assert not obj.vertex_groups
    assert obj.data.total_vert_sel == 3
    bpy.ops.object.mode_set(mode="OBJECT")


def test_pin_selection_wants_to_see_the_selection():
    obj = add_monkey()
    select_vertices(obj, [4, 6])
    bpy.ops.object.mode_set(mode="OBJECT")
    with pytest.raises(RuntimeError, match="Select vertices in Edit Mode first"):
        bpy.ops.cubic_craft.handle_pin_selection()
    for name in ("Handle", "Handle.001"):
        bpy.ops.object.mode_set(mode="EDIT")
        click(bpy.ops.cubic_craft.handle_pin_selection)
        group = obj.vertex_groups[name].index
        assert [v.index for v in obj.data.vertices if group in [g.group for g in v.groups]] == [
            4,
            6,
        ]
    assert groups("Suzanne") == ["Handle", "Handle.001"]


@pytest.mark.parametrize(("action", "words"), [("SELECT", "fewer"), ("DESELECT", "select some")])
def test_pin_selection_of_all_or_nothing_is_refused(action, words):
    obj = add_monkey()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action=action)
    with pytest.raises(RuntimeError, match=f"{words}.* in Edit Mode first"):
        bpy.ops.cubic_craft.handle_pin_selection()
    assert obj.mode == "EDIT"
    assert not obj.vertex_groups
    bpy.ops.object.mode_set(mode="OBJECT")


def test_follow_makes_an_empty_where_the_part_is_seen(posed):
    obj, _, right = add_posable(location=(3, 4, 5), rotation_euler=(1, 2, 3), scale=(2, 2, 2))
    pin(obj, LEFT)
    pin(obj, RIGHT)
    cubify(cubeness=1.0)
    bpy.ops.ed.undo_push(message="Before")
    click(bpy.ops.cubic_craft.handle_follow)
    obj, empty = bpy.data.objects["Body"], bpy.context.object
    seen = position_of(obj.data)[right]
    middle = (seen.min(axis=0) + seen.max(axis=0)) / 2
    bpy.context.view_layer.update()
    wanted = obj.matrix_world @ Vector(middle)
    np.testing.assert_allclose(empty.matrix_world.translation, wanted, rtol=1e-6)
    assert (empty.name, empty.parent, empty.type) == ("Body Right", obj, "EMPTY")
    assert bpy.context.selected_objects == [empty]
    assert empty.users_collection == obj.users_collection
    assert [handle.matrix for handle in posed(obj)] == [IDENTITY, IDENTITY]
    radius = empty.empty_display_size
    assert 1.0 < radius / (np.ptp(seen, axis=0).max() / 2) < 1.5
    bpy.ops.ed.undo()
    assert "Body Right" not in bpy.data.objects
    assert [h.mode for h in bpy.data.objects["Body"].cubic_craft.handles] == ["PINNED"] * 2


def test_follow_says_what_is_in_the_way():
    obj, _, _ = add_posable()
    pin(obj, RIGHT).threshold = 1.0
    obj.vertex_groups[RIGHT].add(range(len(obj.data.vertices)), 0.9, "REPLACE")
    with pytest.raises(RuntimeError, match='no vertex of "Body" has a weight of 1 or more'):
        bpy.ops.cubic_craft.handle_follow()
    obj.cubic_craft.handles[0].threshold = 0.5
    bpy.ops.cubic_craft.handle_follow()
    with pytest.raises(RuntimeError, match='already follows "Body Right"'):
        bpy.ops.cubic_craft.handle_follow()


def test_the_empty_stands_for_its_mesh(shown):
    """What the artist clicks while the empty is selected is meant for the mesh."""
    obj, left, _ = add_posable()
    other = add_monkey("Other")
    before = position_of(obj.data)
    empty = pose(obj)
    assert bpy.context.object == empty and shown(bpy.context) == obj
    assert cubify() == {"FINISHED"}
    posed = position_of(obj.data)
    assert posed[left].tobytes() == before[left].tobytes() and posed.tobytes() != before.tobytes()
    assert "taichi" in obj.cubic_craft.status or "numpy" in obj.cubic_craft.status
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert position_of(obj.data).tobytes() == before.tobytes()
    assert bpy.ops.cubic_craft.auto_orient() == {"FINISHED"}
    assert bpy.ops.cubic_craft.handle_reset_pose() == {"FINISHED"}
    # A mesh that is selected comes first.
    select(empty, other)
    cubify()
    assert position_of(obj.data).tobytes() == before.tobytes()
    assert "507 vertices" in other.cubic_craft.status


def test_any_other_object_stands_for_nothing(shown):
    add_posable()
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
    bpy.context.collection.objects.link(lamp)
    select(lamp)
    assert shown(bpy.context) is None
    with pytest.raises(RuntimeError, match="Select a mesh object first"):
        cubify()


def test_remove_takes_its_own_empty_along():
    obj, _, _ = add_posable()
    pose(obj)
    bpy.ops.ed.undo_push(message="Before")
    click(bpy.ops.cubic_craft.handle_remove)
    assert groups() == [LEFT]
    assert "Body Right" not in bpy.data.objects
    assert bpy.context.object == bpy.data.objects["Body"]
    assert RIGHT in bpy.context.object.vertex_groups
    click(bpy.ops.cubic_craft.handle_remove)
    assert groups() == []
    for _ in range(2):
        bpy.ops.ed.undo()
    assert groups() == [LEFT, RIGHT]
    assert bpy.data.objects["Body"].cubic_craft.handles[1].target == bpy.data.objects["Body Right"]


@pytest.mark.parametrize("use", ["copy of the mesh", "constraint", "child", "not made by us"])
def test_remove_leaves_a_target_that_something_else_uses(use):
    obj, _, _ = add_posable()
    empty = pose(obj)
    if use == "copy of the mesh":
        bpy.context.collection.objects.link(obj.copy())
    elif use == "constraint":
        add_monkey().constraints.new("COPY_LOCATION").target = empty
    elif use == "child":
        add_monkey().parent = empty
    else:
        empty = add_empty("Target")
        obj.cubic_craft.handles[1].target = empty
    select(obj)
    bpy.ops.cubic_craft.handle_remove()
    assert empty.name in bpy.context.scene.objects


def test_reset_pose_puts_every_target_back(posed):
    obj, _, _ = add_posable(location=(5, 6, 7), rotation_euler=(1, 2, 3))
    own = pose(obj)
    free = add_empty("Target", location=(5, 7, 7))
    select(obj)
    obj.cubic_craft.handles[0].target = free
    place = own.matrix_basis.copy()
    free.location.z += 3
    bpy.context.view_layer.update()
    assert IDENTITY not in [handle.matrix for handle in posed(obj)]
    bpy.ops.ed.undo_push(message="Before")
    click(bpy.ops.cubic_craft.handle_reset_pose)
    bpy.context.view_layer.update()
    obj = bpy.data.objects["Body"]
    assert [handle.matrix for handle in posed(obj)] == [IDENTITY, IDENTITY]
    np.testing.assert_allclose(bpy.data.objects["Target"].location, (5, 7, 7), atol=1e-5)
    bpy.ops.ed.undo()
    assert bpy.data.objects["Body Right"].matrix_basis == place

# SPDX-License-Identifier: GPL-3.0-or-later
"""A result that was edited by hand: what the panel knows of it, and what the next run starts from.

The row in the panel is tested in a window.
"""

import importlib

import bpy
import pytest
from live_steps import add_monkey, bits, confirm, tick_to_rest
from rich_mesh import position_of
from scene import cubify, reports_of, select


@pytest.fixture
def edited(extension):
    return importlib.import_module(f"{extension.__name__}.cubic_craft_addon.ui.edited")


def edit(obj):
    obj.data.vertices[3].co.x += 0.5
    obj.data.update()
    return position_of(obj.data)


def update():
    bpy.context.view_layer.update()


def test_it_follows_what_happens_to_the_mesh(edited):
    obj = add_monkey()
    assert not edited.is_edited(obj.data)
    cubify()
    update()
    assert not edited.is_edited(obj.data)
    edit(obj)
    update()
    assert edited.is_edited(obj.data)
    cubify(start="ORIGINAL")
    update()
    assert not edited.is_edited(obj.data)
    obj.scale = (2, 2, 2)
    bpy.ops.object.transform_apply(scale=True)
    update()
    assert not edited.is_edited(obj.data)
    edit(obj)
    update()
    assert edited.is_edited(obj.data)
    bpy.ops.cubic_craft.restore()
    update()
    assert not edited.is_edited(obj.data)


def test_undo_is_followed(edited):
    obj = add_monkey()
    cubify()
    bpy.ops.ed.undo_push(message="Cubify")
    select(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.mesh.select_random(ratio=0.1)
    bpy.ops.transform.translate(value=(0, 0, 1))
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.ed.undo_push(message="Edit")
    update()
    assert edited.is_edited(bpy.data.objects["Suzanne"].data)
    bpy.ops.ed.undo()
    assert not edited.is_edited(bpy.data.objects["Suzanne"].data)
    bpy.ops.ed.redo()
    assert edited.is_edited(bpy.data.objects["Suzanne"].data)


def test_it_is_found_out_once(edited, extension, monkeypatch):
    """The panel is drawn often, and reading the positions takes time."""
    calls = []
    bridge = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.mesh_bridge")
    real = bridge.is_edited
    monkeypatch.setattr(bridge, "is_edited", lambda mesh: calls.append(mesh) or real(mesh))
    obj = add_monkey()
    cubify()
    update()
    calls.clear()
    for _ in range(5):
        assert not edited.is_edited(obj.data)
    assert len(calls) == 1


@pytest.mark.parametrize("start", ["HERE", "ORIGINAL", "EDITS"])
@pytest.mark.parametrize("change", ["edited", "transformed"])
def test_live_starts_from_what_cubify_starts_from(live, begin, start, change):
    shapes = []
    for is_live in (False, True):
        obj = add_monkey()
        cubify(max_iterations=1000)
        if change == "edited":
            obj.data.vertices[3].co.x += 0.5
            obj.data.update()
        else:
            obj.scale = (1, 1, 2)
            bpy.ops.object.transform_apply(scale=True)
        changed = bits(obj)
        if is_live:
            session = tick_to_rest(begin(obj, start=start, cubeness=0.3))
            session.on(live.Event.CANCEL)
            assert bits(obj) == changed and obj.cubic_craft.start == start
            session = begin(obj)
            live.live_properties().cubeness = 0.7
            confirm(live, session)
        else:
            bpy.ops.cubic_craft.cubify(start=start, cubeness=0.7)
        assert obj.cubic_craft.start == "EDITS"
        shapes.append(bits(obj))
        bpy.ops.cubic_craft.restore()
        shapes.append(bits(obj))
        assert (shapes[-1] == changed) == (change == "edited" and start == "HERE")
    assert shapes[:2] == shapes[2:]


def test_an_edited_mesh_may_start_from_where_it_is():
    obj = add_monkey()
    cubify()
    edited = edit(obj)
    cubify(start="HERE")
    bpy.ops.cubic_craft.restore()
    assert position_of(obj.data).tobytes() == edited.tobytes()


@pytest.mark.parametrize("by", ["object", "operator"])
def test_an_edited_mesh_may_start_from_the_original(by):
    obj = add_monkey()
    cubify()
    cubic = position_of(obj.data)
    edit(obj)
    if by == "object":
        obj.cubic_craft.start = "ORIGINAL"
        cubify()
    else:
        cubify(start="ORIGINAL")
    assert obj.cubic_craft.start == "EDITS"  # it was for that run
    assert position_of(obj.data).tobytes() == cubic.tobytes()
    edited = edit(obj)
    cubify()
    assert position_of(obj.data).tobytes() == edited.tobytes()


def test_each_of_several_edited_meshes_starts_from_what_it_says():
    one, other = add_monkey("One"), add_monkey("Other", location=(3, 0, 0))
    select(one, other)
    cubify(together="PARTS")
    edit(one)
    edited = edit(other)
    one.cubic_craft.start, other.cubic_craft.start = "ORIGINAL", "HERE"
    cubify(together="PARTS")
    bpy.ops.cubic_craft.restore()
    assert position_of(one.data)[3, 0] != edited[3, 0]
    assert position_of(other.data).tobytes() == edited.tobytes()


def test_restore_takes_back_an_edit_as_well():
    obj = add_monkey()
    before = position_of(obj.data)
    cubify()
    edit(obj)
    said = reports_of(bpy.ops.cubic_craft.restore)
    assert position_of(obj.data).tobytes() == before.tobytes()
    assert "Restored Suzanne; edits made by hand are lost (Ctrl-Z brings them back)" in said

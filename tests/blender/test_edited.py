# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel knows of edits by hand; the row itself is tested in a window."""

import importlib

import bpy
import pytest
from live_steps import bits, confirm, tick_to_rest
from scene import add_monkey, cubify, select


@pytest.fixture
def edited(extension):
    return importlib.import_module(f"{extension.__name__}.cubic_craft_addon.edited")


def update():
    bpy.context.view_layer.update()


def test_it_follows_what_happens_to_the_mesh(edited):
    obj = add_monkey()
    assert not edited.is_edited(obj.data)
    cubify()
    update()
    assert not edited.is_edited(obj.data)
    obj.data.vertices[3].co.x += 0.5
    obj.data.update()
    update()
    assert edited.is_edited(obj.data)
    cubify(start="ORIGINAL")
    update()
    assert not edited.is_edited(obj.data)
    obj.scale = (2, 2, 2)
    bpy.ops.object.transform_apply(scale=True)
    update()
    assert not edited.is_edited(obj.data)
    obj.data.vertices[3].co.x += 0.5
    obj.data.update()
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
    update()
    assert not edited.is_edited(bpy.data.objects["Suzanne"].data)
    bpy.ops.ed.redo()
    update()
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


@pytest.mark.parametrize("start", ["HERE", "ORIGINAL"])
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
            session = begin(obj, start=start, cubeness=0.3)
            tick_to_rest(session)
            session.on(live.Event.CANCEL)
            assert bits(obj) == changed and obj.cubic_craft.start == start
            session = begin(obj)
            live.live_properties().cubeness = 0.7
            confirm(live, session)
        else:
            bpy.ops.cubic_craft.cubify(start=start, cubeness=0.7)
        assert obj.cubic_craft.start == "HERE"
        shapes.append(bits(obj))
        bpy.ops.cubic_craft.restore()
        shapes.append(bits(obj))
        assert (shapes[-1] == changed) == (change == "edited" and start == "HERE")
    assert shapes[:2] == shapes[2:]

# SPDX-License-Identifier: GPL-3.0-or-later
"""A result that was edited by hand: what the panel knows of it, and what the next run starts from.

The row in the panel is tested in a window.
"""

import bmesh
import bpy
import numpy as np
import pytest
from live_steps import add_monkey, bits, confirm, tick_to_rest
from mathutils import Matrix
from recorder import Recorder
from rich_mesh import position_of
from scene import bmesh_of, cubify, reports_of


@pytest.fixture
def edited(part):
    return part("ui.edited")


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


@pytest.mark.thorough(2)
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
    np.testing.assert_allclose(position_of(obj.data), edited, atol=1e-6)


def test_strokes_stay_while_the_cubeness_changes(edited):
    obj = add_monkey()
    original = position_of(obj.data)
    cubify(cubeness=0.4)
    cubic = position_of(obj.data)
    sculpted = edit(obj)
    cubify(cubeness=0.1)
    softer = position_of(obj.data)
    assert np.abs(softer - sculpted).max() > 0.01 and softer[3, 0] > original[3, 0] + 0.3
    cubify(cubeness=0.4)
    np.testing.assert_allclose(position_of(obj.data), sculpted, atol=1e-6)
    update()
    assert not edited.is_edited(obj.data) and edited.mesh_bridge.has_strokes(obj.data)
    said = reports_of(bpy.ops.cubic_craft.restore)
    assert position_of(obj.data).tobytes() == original.tobytes()
    assert "edits made by hand are lost (Ctrl-Z brings them back)" in said
    cubify(cubeness=0.4)
    assert position_of(obj.data).tobytes() == cubic.tobytes()


def test_the_first_original_comes_back():
    obj = add_monkey()
    original = position_of(obj.data)
    cubify()
    assert not bpy.ops.cubic_craft.restore_first.poll()
    edited = edit(obj)
    cubify(start="HERE")
    bpy.ops.cubic_craft.restore()
    assert position_of(obj.data).tobytes() == edited.tobytes()
    obj.vertex_groups.new(name="Ear").add(range(50), 1.0, "REPLACE")
    handle = obj.cubic_craft.handles.add()
    handle.group, handle.pose = "Ear", Matrix.Translation((0, 0, 0.1))
    cubify()
    assert handle.is_baked
    said = reports_of(bpy.ops.cubic_craft.restore_first)
    assert not handle.is_baked, "its pose is in the mesh no longer"
    assert "Restored the first original of Suzanne" in said
    assert position_of(obj.data).tobytes() == original.tobytes()
    assert not bpy.ops.cubic_craft.restore_first.poll() and not bpy.ops.cubic_craft.restore.poll()


def test_the_panel_says_what_from_here_replaces(edited, part, monkeypatch):
    monkeypatch.setattr(part("screen.text_fit"), "room_for_text", lambda *_: 1e6)
    obj = add_monkey()
    cubify()
    for shape in ("cubic", "edited", "with strokes"):
        layout = Recorder()
        edited.draw(bpy.context, layout, obj)
        assert layout.drawn == ([] if shape == "cubic" else ["start"])
        obj.cubic_craft.start = "HERE"
        layout = Recorder()
        edited.draw(bpy.context, layout, obj)
        is_said = "This shape replaces the original. Restore First brings that" in str(
            layout.labels
        )
        assert is_said == (shape != "cubic")
        obj.cubic_craft.property_unset("start")
        if shape == "cubic":
            edit(obj)
        else:
            cubify()
        update()


def test_a_lost_original_is_named(edited, part, monkeypatch):
    """New vertices that were moved each its own way: Cubify starts from here, and says so."""
    monkeypatch.setattr(part("screen.text_fit"), "room_for_text", lambda *_: 1e6)
    obj = add_monkey()
    cubify(max_iterations=2)
    with bmesh_of(obj.data) as bm:
        made = bmesh.ops.extrude_vert_indiv(bm, verts=bm.verts[100:200])["verts"]
        for vertex in made:
            vertex.co = np.multiply(vertex.co, 1 + np.sin(9 * np.array(vertex.co)))
    update()
    layout = Recorder()
    edited.draw(bpy.context, layout, obj)
    assert "no longer be determined: Cubify starts from here" in layout.labels[0]
    assert layout.drawn == []
    shape = position_of(obj.data)
    said = reports_of(lambda: cubify(max_iterations=2))
    assert '"Suzanne" starts from its current shape' in said
    update()
    assert not edited.is_lost(obj.data)
    bpy.ops.cubic_craft.restore()
    assert position_of(obj.data).tobytes() == shape.tobytes()

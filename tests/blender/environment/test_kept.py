# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made from other objects is kept while nothing changes, and never longer."""

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Matrix
from scene import add_monkey
from solids import add_solid


@pytest.fixture
def cache(part):
    module = part("environment.kept")
    module._forget()
    yield module
    module._forget()


def is_empty(cache):
    return not any(each.uids for each in cache._all)


@pytest.fixture
def counted(part, monkeypatch):
    """Return a list that grows when an object's mesh is read."""
    bridge, reads = part("mesh_bridge"), []
    read = bridge.read_evaluated
    monkeypatch.setattr(bridge, "read_evaluated", lambda obj: reads.append(obj.name) or read(obj))
    return reads


@pytest.fixture
def body(part):
    """Return a function that returns the form of the monkey as numbers."""
    settings_of, form_of = part("settings.properties").settings_of, part("form.body").form_of

    def sides():
        form = form_of(settings_of(bpy.data.objects["Suzanne"]))
        return form.normals * form.offsets[:, None]

    return sides


def prepare(kind="OBJECT"):
    """Add the monkey and a gem that is its form, both seen."""
    gem = add_solid("cone", "Gem", location=(9, 0, 0))
    monkey = add_monkey()
    monkey.cubic_craft.form, monkey.cubic_craft.form_object = kind, gem
    return gem


def stretch(mesh):
    for vertex in mesh.vertices:
        vertex.co.z *= 2.0 if vertex.co.z > 0 else 1.0


def edit_vertices(gem):
    stretch(gem.data)
    gem.data.update()


def edit_by_transform(gem):
    gem.data.transform(Matrix.Diagonal((1, 1, 3, 1)))
    gem.data.update()


def in_edit_mode(gem):
    bpy.context.view_layer.objects.active = gem
    bpy.ops.object.mode_set(mode="EDIT")
    edited = bmesh.from_edit_mesh(gem.data)
    bmesh.ops.scale(edited, vec=(1, 1, 3), verts=edited.verts)
    bmesh.update_edit_mesh(gem.data)


def turn(gem):
    gem.rotation_euler = (0.3, 0.4, 0.5)


def turn_by_parent(gem):
    empty = bpy.data.objects.new("Parent", None)
    bpy.context.collection.objects.link(empty)
    gem.parent = empty
    bpy.context.view_layer.update()
    empty.scale = (1, 2, 3)


def add_modifier(gem):
    modifier = gem.modifiers.new("Cast", "CAST")
    modifier.cast_type, modifier.factor = "CUBOID", 0.9


def change_data(gem):
    mesh = gem.data.copy()
    stretch(mesh)
    gem.data = mesh


def edit_through_another_user(gem):
    other = bpy.data.objects.new("Other", gem.data)
    bpy.context.collection.objects.link(other)
    edit_vertices(other)


CHANGES = (
    *(edit_vertices, edit_by_transform, in_edit_mode, turn, turn_by_parent, add_modifier),
    *(change_data, edit_through_another_user),
)


@pytest.fixture(autouse=True)
def object_mode():
    yield
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def check_is_new(cache, body, before):
    """Check that the form is another one: the one that is made without what was kept."""
    found = body()
    assert found.shape != before.shape or np.abs(found - before).max() > 1e-3
    cache._forget()
    np.testing.assert_array_equal(found, body())


@pytest.mark.parametrize("kind", ["OBJECT", "DIRECTIONS"])
@pytest.mark.parametrize("change", CHANGES)
def test_each_change_is_seen_and_nothing_is_read_twice(cache, counted, body, change, kind):
    gem = prepare(kind)
    before = body()
    reads = len(counted)
    for _ in range(3):
        np.testing.assert_array_equal(body(), before)
    assert len(counted) == reads == 1
    change(gem)
    check_is_new(cache, body, before)


def test_what_a_modifier_depends_on_is_seen(cache, body):
    gem = prepare()
    hook = bpy.data.objects.new("Hook", None)
    bpy.context.collection.objects.link(hook)
    modifier = gem.modifiers.new("Cast", "CAST")
    modifier.object, modifier.factor = hook, 0.5
    bpy.context.view_layer.update()
    before = body()
    hook.location = gem.location + gem.location.normalized() * 0.4
    check_is_new(cache, body, before)
    before = body()
    modifier.factor = 1.0
    check_is_new(cache, body, before)


def test_shape_keys_and_frames_are_seen(cache, body):
    gem = prepare()
    gem.shape_key_add(name="Basis")
    key = gem.shape_key_add(name="High")
    for point in key.data:
        point.co.z *= 3.0 if point.co.z > 0 else 1.0
    key.value = 0.0
    before = body()
    key.value = 1.0
    check_is_new(cache, body, before)
    key.keyframe_insert("value", frame=1)
    key.value = 0.2
    key.keyframe_insert("value", frame=10)
    bpy.context.scene.frame_set(1)
    before = body()
    bpy.context.scene.frame_set(10)
    check_is_new(cache, body, before)


def test_undo_and_redo_are_seen(cache, body):
    gem = prepare()
    bpy.ops.ed.undo_push(message="Before")
    before = body()
    edit_vertices(gem)
    bpy.ops.ed.undo_push(message="Edit")
    after = body()
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(body(), before)
    bpy.ops.ed.redo()
    np.testing.assert_array_equal(body(), after)


def test_what_was_kept_first_is_forgotten_first(cache):
    kept = cache.Kept()
    for uid in (1, 2, 1, 3):
        kept.keep(uid, f"of {uid}")
    assert kept.uids == [1, 3]
    made = cache.KeptFrom()
    for uid in range(20):
        made.keep(uid, f"of {uid}")
    assert made.uids == [*range(4, 20)]


def test_an_object_in_no_scene_is_read_each_time(cache, counted, body):
    gem = prepare()
    bpy.context.collection.objects.unlink(gem)
    body()
    gem.data.transform(Matrix.Diagonal((1, 1, 3, 1)))
    before = len(counted)
    body()
    assert len(counted) == before + 1 and is_empty(cache)


def test_without_our_handlers_nothing_is_kept(cache, counted, body, monkeypatch):
    prepare()
    bpy.app.handlers.depsgraph_update_post.remove(cache._on_update)
    try:
        body()
        body()
        assert len(counted) == 2 and is_empty(cache)
    finally:
        bpy.app.handlers.depsgraph_update_post.append(cache._on_update)

# SPDX-License-Identifier: GPL-3.0-or-later
"""A preview is taken back from what lies on the mesh, wherever that mesh has come from."""

import bpy
import numpy as np
import pytest
from previewed import NOTE, STATES, add_monkey, live_attributes, show_some
from rich_mesh import cubic_like, points_of, position_of, set_points
from snapshot import differences, snapshot_mesh, snapshot_object


def healed(bridge, mesh):
    assert bridge.has_preview(mesh)
    assert bridge.end_preview(mesh)
    assert not bridge.has_preview(mesh) and live_attributes(mesh) == []


@pytest.mark.parametrize("state", STATES)
def test_copy_of_the_mesh(bridge, state):
    obj = add_monkey(bridge, state)
    plain_copy = snapshot_mesh(obj.data.copy())
    show_some(bridge, obj.data)
    copy = obj.data.copy()
    bridge.end_preview(obj.data)
    assert bridge.has_preview(copy)
    healed(bridge, copy)
    changed = differences(plain_copy, snapshot_mesh(copy))
    # Names, users and evaluated values are of the copy itself.
    assert [p for p in changed if not p.startswith(("rna/", "shape_keys/"))] == []
    assert [p for p in changed if p.endswith("/points")] == []
    assert bridge.has_original(copy) == bridge.has_original(obj.data)


@pytest.mark.parametrize("state", STATES)
def test_undo_step(bridge, state):
    obj = add_monkey(bridge, state)
    name, before = obj.name, snapshot_object(obj)
    preview = show_some(bridge, obj.data)
    bpy.ops.ed.undo_push(message="captured while a preview is on")
    bridge.end_preview(obj.data)
    bpy.ops.ed.undo_push(message="ended")
    bpy.context.scene.frame_end += 1
    bpy.ops.ed.undo_push(message="something else")
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    mesh = bpy.data.objects[name].data
    healed(bridge, mesh)
    assert differences(before, snapshot_object(bpy.data.objects[name])) == []
    base = bridge.original_positions(mesh)
    assert preview.needs_rotations == ("keys" in state)
    assert len(base) == len(mesh.vertices)


@pytest.mark.parametrize("state", STATES)
def test_file(bridge, state, reopen):
    add_monkey(bridge, state)
    obj = reopen("Suzanne")
    before = snapshot_object(obj)
    show_some(bridge, obj.data)
    obj = reopen("Suzanne")
    assert bridge.end_all_previews() == [obj.data.name]
    assert differences(before, snapshot_object(obj)) == []


def test_linked_mesh_is_left_alone(bridge, plain_monkey, tmp_path):
    show_some(bridge, plain_monkey.data)
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(path, link=True) as (there, here):
        here.meshes = there.meshes
    mesh = here.meshes[0]
    mesh.use_fake_user = True  # Blender 5.3 makes nothing local that nobody uses
    shape = position_of(mesh)
    assert bridge.has_preview(mesh)
    assert not bridge.end_preview(mesh)
    assert bridge.end_all_previews() == []
    assert position_of(mesh).tobytes() == shape.tobytes()
    local = mesh.make_local()
    healed(bridge, local)


def test_vertex_added(bridge, plain_monkey):
    mesh = plain_monkey.data
    show_some(bridge, mesh)
    mesh.vertices.add(1)
    shape = position_of(mesh)
    healed(bridge, mesh)
    assert position_of(mesh).tobytes() == shape.tobytes()


def test_edited_shape_key_keeps_its_edit_on_the_base_before(bridge, keyed_monkey):
    mesh = keyed_monkey.data
    before = snapshot_object(keyed_monkey)
    wide = points_of(mesh, "Wide")
    show_some(bridge, mesh)
    edited = points_of(mesh, "Wide")
    edited[5] += 0.5
    set_points(mesh, "Wide", edited)
    healed(bridge, mesh)
    changed = [p for p in differences(before, snapshot_object(keyed_monkey)) if "points" in p]
    assert changed == ["mesh/shape_keys/blocks/Wide/points"]
    # Its offsets stay turned: how the preview has turned them is not kept.
    assert np.abs(points_of(mesh, "Wide") - wide).max() < 1


def test_shape_keys_come_and_go(bridge, monkey):
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    show_some(bridge, mesh)
    if mesh.shape_keys:
        shape = position_of(mesh)
        monkey.shape_key_clear()
        assert position_of(mesh).tobytes() == shape.tobytes()
    else:
        monkey.shape_key_add(name="Basis", from_mix=False)
    healed(bridge, mesh)
    assert position_of(mesh).tobytes() == base.tobytes()
    assert bridge.read_positions(mesh).tobytes() == base.tobytes()


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("kind", ["gone", "other kind"])
def test_stored_base_damaged(bridge, state, kind):
    """What cannot be put back stays; everything else is. One of another kind is not ours."""
    obj = add_monkey(bridge, state)
    mesh = obj.data
    keys = mesh.shape_keys.key_blocks.keys()[1:] if mesh.shape_keys else []
    points = {name: points_of(mesh, name).tobytes() for name in keys}
    show_some(bridge, mesh)
    shown = bridge.read_positions(mesh)
    mesh.attributes.remove(mesh.attributes["cubic_craft_live"])
    if kind == "other kind":
        mesh.attributes.new("cubic_craft_live", "FLOAT", "FACE")
    healed(bridge, mesh)
    assert ("cubic_craft_live" in mesh.attributes) == (kind == "other kind")
    assert bridge.read_positions(mesh).tobytes() == shown.tobytes()
    assert {name: points_of(mesh, name).tobytes() for name in keys} == points


@pytest.mark.parametrize("state", STATES)
def test_note_gone(bridge, state):
    """Nothing tells any more what was shown: the attributes are strays, which go at the next."""
    obj = add_monkey(bridge, state)
    mesh = obj.data
    show_some(bridge, mesh)
    del mesh[NOTE]
    shape = bridge.read_positions(mesh)
    assert not bridge.has_preview(mesh) and not bridge.end_preview(mesh)
    assert bridge.has_traces(mesh)
    show_some(bridge, mesh)
    assert bridge.end_preview(mesh)
    assert live_attributes(mesh) == []
    assert bridge.read_positions(mesh).tobytes() == shape.tobytes()


def test_keys_that_do_not_fit(bridge, keyed_monkey):
    mesh = keyed_monkey.data
    show_some(bridge, mesh)
    mesh.clear_geometry()
    healed(bridge, mesh)


def test_joined_into_another(bridge):
    one, other = add_monkey(bridge, "plain"), add_monkey(bridge, "plain")
    show_some(bridge, one.data)
    with bpy.context.temp_override(
        active_object=other, object=other, selected_editable_objects=[one, other]
    ):
        bpy.ops.object.join()
    assert not bridge.has_preview(other.data) and bridge.has_traces(other.data)
    base = bridge.read_positions(other.data)
    preview = bridge.Preview(other.data)
    preview.show(other.data, cubic_like(base)[0])
    healed(bridge, other.data)
    assert bridge.read_positions(other.data).tobytes() == base.tobytes()

# SPDX-License-Identifier: GPL-3.0-or-later
"""What artists do with an object beside us: undo, links, rigs, animation, many objects at once."""

import bpy
import pytest
from rich_mesh import add_rich_monkey, points_of, position_of
from scene import add_monkey, cubify, select
from snapshot import differences
from world import snapshot_world


def step(message):
    bpy.ops.ed.undo_push(message=message)


def the(name="Suzanne"):
    return bpy.data.objects[name]


@pytest.mark.thorough(1)
@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_undo_and_redo_through_a_whole_session(result):
    """Each state comes back whole, forth and back, whatever was done in between."""
    add_rich_monkey(keys=True)
    actions = [
        lambda: cubify(result=result, max_iterations=3),
        lambda: cubify(result="MESH", cubeness=0.9, max_iterations=3),
        bpy.ops.cubic_craft.restore,
        lambda: cubify(result="SHAPE_KEY", cubeness=0.2, max_iterations=3),
        lambda: cubify(result="MESH", cubeness=0.6, max_iterations=3),
        bpy.ops.cubic_craft.apply,
        lambda: cubify(result=result, max_iterations=3),
    ]
    step("Begin")
    states = [snapshot_world()]
    for action in actions:
        assert action() == {"FINISHED"}
        step("Action")
        states.append(snapshot_world())
    for _ in range(2):
        for state in states[-2::-1]:
            bpy.ops.ed.undo()
            assert differences(state, snapshot_world()) == []
        for state in states[1:]:
            bpy.ops.ed.redo()
            assert differences(state, snapshot_world()) == []
    bpy.ops.ed.undo()
    assert cubify(max_iterations=3) == {"FINISHED"}


def library_with(tmp_path, obj):
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {obj}, fake_user=True)
    return path


def link(path, name="Suzanne"):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = [name]
    obj = wanted.objects[0]
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.update()
    return obj


def test_a_linked_result_is_seen_and_left_alone_beside_a_local_mesh(tmp_path):
    obj = add_monkey()
    cubify(cubeness=0.8)
    shape = position_of(obj.data).tobytes()
    linked = link(library_with(tmp_path, obj))
    local = add_monkey("Local")
    select(local, linked)
    assert cubify(cubeness=0.8) == {"FINISHED"}
    assert position_of(linked.data).tobytes() == shape == position_of(local.data).tobytes()
    select(linked)
    with pytest.raises(RuntimeError, match="linked from another file"):
        cubify()
    for operator in (bpy.ops.cubic_craft.restore, bpy.ops.cubic_craft.apply):
        assert not operator.poll()
        with pytest.raises(RuntimeError, match=r'poll\(\).*"Suzanne" has mesh data linked from'):
            operator()


def test_an_override_of_a_linked_object_with_a_mesh_of_its_own(tmp_path):
    linked = link(library_with(tmp_path, add_monkey()))
    override = linked.override_create(remap_local_usages=True)
    override.data = linked.data.copy()
    bpy.context.view_layer.update()
    select(override)
    before = position_of(override.data).tobytes()
    assert cubify() == {"FINISHED"}
    assert position_of(override.data).tobytes() != before
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert position_of(override.data).tobytes() == before


def test_rigged_subdivided_keyed_animated_and_driven():
    """All that is on top stays and still works; Restore gives each bit back on every frame."""
    obj = add_rich_monkey(keys=True)
    bones = bpy.data.armatures.new("Bones")
    rig = bpy.data.objects.new("Rig", bones)
    bpy.context.collection.objects.link(rig)
    select(rig)
    bpy.ops.object.mode_set(mode="EDIT")
    bone = bones.edit_bones.new("Map")  # the name of a vertex group
    bone.head, bone.tail = (0, 0, -1), (0, 0, 1)
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.modifiers.new("Armature", "ARMATURE").object = rig
    obj.modifiers["Subdivision"].levels = 1
    rig.pose.bones["Map"].location.x = 0.5
    for frame, value in ((1, 0.0), (10, 1.0)):
        obj.cubic_craft.cubeness = value
        obj.cubic_craft.keyframe_insert("cubeness", frame=frame)
        rig.pose.bones["Map"].rotation_quaternion.x = value
        rig.pose.bones["Map"].keyframe_insert("rotation_quaternion", frame=frame)
    select(obj)

    def evaluated(frame):
        bpy.context.scene.frame_set(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        return position_of(obj.evaluated_get(depsgraph).data).tobytes()

    frames = (1, 5, 10)
    before = [evaluated(frame) for frame in frames]
    names = [key.name for key in obj.data.shape_keys.key_blocks]
    keys = {name: points_of(obj.data, name) for name in names}
    bpy.context.scene.frame_set(5)
    assert cubify(cubeness=0.7, max_iterations=5) == {"FINISHED"}
    shown = [evaluated(frame) for frame in frames]
    assert all(a != b for a, b in zip(before, shown, strict=True))
    assert len(set(shown)) == len(frames), "the rig no longer moves it"
    bpy.context.scene.frame_set(5)
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert [evaluated(frame) for frame in frames] == before
    for name, points in keys.items():
        assert points_of(obj.data, name).tobytes() == points.tobytes()

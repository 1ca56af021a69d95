# SPDX-License-Identifier: GPL-3.0-or-later
"""The follower: where it stands, and that it keeps in the end what the artist has given it."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from live_steps import add_monkey, bits, check_gone, confirm, follower_of, tick_to_rest
from mathutils import Matrix, Vector
from scene import select

NAME = "The Sculpture"


def link(data, name="Other"):
    other = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(other)
    return other


def dress(follower):
    """Give it what an artist might, while it is only a follower."""
    follower.name = NAME
    follower.data.materials.append(bpy.data.materials.new("Marble"))
    follower.modifiers.new("Bevel", "BEVEL")
    follower["price"] = 3
    shelf = bpy.data.collections.new("Shelf")
    bpy.context.scene.collection.children.link(shelf)
    shelf.objects.link(follower)
    follower.vertex_groups.new(name="Shine").add(range(100), 0.5, "REPLACE")
    sketch = link(None, "Sketch")
    sketch.parent = follower


def check_dressed(follower):
    assert [m.name for m in follower.data.materials] == ["Marble"]
    assert [m.name for m in follower.modifiers] == ["Bevel"] and follower["price"] == 3
    assert "Shelf" in [c.name for c in follower.users_collection]
    assert follower.vertex_groups["Shine"].weight(99) == 0.5
    assert bpy.data.objects["Sketch"].parent == follower
    assert not [key for key in follower.keys() if "follower" in key]  # noqa: SIM118 - of an object


@pytest.mark.parametrize("with_modifiers", [False, True])
def test_the_result_keeps_what_the_artist_has_given_it(live, follow, with_modifiers):
    obj = add_monkey()
    session = tick_to_rest(follow(obj, with_modifiers=with_modifiers))
    follower = follower_of(obj)
    shown, original = bits(follower), bits(obj)
    dress(follower)
    tick_to_rest(session)
    confirm(live, session)
    check_gone(live)
    assert bpy.data.objects[NAME] == follower and bits(follower) == shown
    assert len(bpy.data.meshes) == 2 and len(bpy.data.objects) == 3
    check_dressed(follower)
    assert bpy.context.object == obj and bpy.context.selected_objects == [obj]
    assert follower.cubic_craft.result == "MESH"
    select(follower)
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert bits(follower) == original


def test_it_keeps_that_when_a_file_is_saved_and_in_the_file(live, follow, tmp_path):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    follower = follower_of(obj)
    dress(follower)
    tick_to_rest(session)
    shown, path, name = bits(follower), str(tmp_path / "live.blend"), obj.name
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    tick_to_rest(session)
    assert bits(follower) == shown
    confirm(live, session)
    check_dressed(bpy.data.objects[NAME])
    bpy.ops.wm.open_mainfile(filepath=path)
    check_dressed(bpy.data.objects[NAME])
    assert bits(bpy.data.objects[NAME]) == shown
    assert bpy.context.object == bpy.data.objects[name] and len(bpy.data.objects) == 3


def test_weights_painted_on_it_are_kept_and_so_is_the_mode(live, follow):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    follower = follower_of(obj)
    select(follower)
    follower.vertex_groups.new(name="Shine").add([7], 0.25, "REPLACE")
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    tick_to_rest(session)
    shown = bits(follower)
    confirm(live, session)
    assert follower.mode == "WEIGHT_PAINT" and bpy.context.object == follower
    assert follower.vertex_groups["Shine"].weight(7) == 0.25 and bits(follower) == shown


def seen(obj):
    """Return the visible vertices in world space."""
    found = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    matrix = np.array(found.matrix_world)
    points = np.array([v.co for v in found.data.vertices])
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def add_hook(obj):
    hand = link(None)
    modifier = obj.modifiers.new("Hook", "HOOK")
    modifier.object, modifier.strength = hand, 1.0
    modifier.vertex_indices_set(range(100))
    hand.location = (0.3, 0.0, 0.4)


def add_mirror(obj):
    mirror = link(None)
    mirror.location.x = 1.5
    obj.modifiers.new("Mirror", "MIRROR").mirror_object = mirror


def add_deforming_parent(obj):
    lattice = bpy.data.lattices.new("Lattice")
    lattice.points_w = 3
    obj.parent, obj.parent_type = link(lattice), "LATTICE"
    for point in list(lattice.points)[6:]:
        point.co_deform.z += 0.5
    obj.update_tag()


def add_nodes(obj):
    tree = bpy.data.node_groups.new("Join", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    put_in, put_out, info, join = (
        tree.nodes.new(kind)
        for kind in (
            "NodeGroupInput",
            "NodeGroupOutput",
            "GeometryNodeObjectInfo",
            "GeometryNodeJoinGeometry",
        )
    )
    bpy.ops.mesh.primitive_cube_add(location=(0.0, 0.0, 2.0))
    info.inputs["Object"].default_value = bpy.context.object
    info.transform_space = "RELATIVE"
    tree.links.new(put_in.outputs[0], join.inputs[0])
    tree.links.new(info.outputs["Geometry"], join.inputs[0])
    tree.links.new(join.outputs[0], put_out.inputs[0])
    obj.modifiers.new("Nodes", "NODES").node_group = tree
    return tree


def add_nodes_with_a_socket(obj):
    tree = add_nodes(obj)
    (info,) = (node for node in tree.nodes if node.bl_idname == "GeometryNodeObjectInfo")
    other = info.inputs["Object"].default_value
    info.inputs["Object"].default_value = None
    name = tree.interface.new_socket("Other", socket_type="NodeSocketObject").identifier
    put_in = next(node for node in tree.nodes if node.bl_idname == "NodeGroupInput")
    tree.links.new(put_in.outputs["Other"], info.inputs["Object"])
    modifier = obj.modifiers["Nodes"]
    if hasattr(modifier, "properties"):  # from Blender 5.3 on
        getattr(modifier.properties.inputs, name).value = other
    else:
        modifier[name] = other


@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (2.0, 0.5, 1.0)])
@pytest.mark.parametrize(
    "deform", [add_hook, add_mirror, add_deforming_parent, add_nodes, add_nodes_with_a_socket]
)
def test_what_other_objects_deform_is_seen_alike_beside_the_original(live, follow, deform, scale):
    obj = add_monkey(scale=scale, rotation=(0.0, 0.0, 0.5))
    deform(obj)
    session = tick_to_rest(follow(obj, cubeness=0.0))

    def check():
        shift = seen(follower_of(obj)) - seen(obj)
        assert np.ptp(shift, axis=0).max() < 1e-3
        width = np.ptp(seen(obj)[:, 0])
        assert shift[0, 0] > width and abs(shift[0, 1:]).max() < 1e-3

    check()
    confirm(live, session)
    check()


def look_along(direction, distance, is_perspective):
    """Return what is needed of a view at a distance from the origin."""
    matrix = Vector(direction).to_track_quat("-Z", "Y").to_matrix().to_4x4()
    matrix.translation = -distance * Vector(direction).normalized()
    projection = Matrix.Identity(4)
    if is_perspective:
        projection[3] = (0.0, 0.0, -1.0, 0.0)
    view = matrix.inverted()
    return SimpleNamespace(view_matrix=view, perspective_matrix=projection @ view)


@pytest.mark.parametrize("is_perspective", [False, True])
@pytest.mark.parametrize(
    "direction", [(0, 1, 0), (-1, 0, 0), (0, -1, 0), (1, 2, -1), (-1, 0.3, -2)]
)
def test_neither_hides_the_other_from_the_view(part, monkeypatch, direction, is_perspective):
    beside = part("live.follower")
    view = look_along(direction, 6.0, is_perspective)
    monkeypatch.setattr(beside, "_view", lambda: view)
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.object
    shift = beside.shift_beside([obj])
    assert abs(shift.z) < 1e-6
    points = seen(obj)
    assert not beside._is_hidden(view, points, points + np.array(shift))
    assert (view.view_matrix.to_3x3() @ shift).x > 2.0  # to the right

# SPDX-License-Identifier: GPL-3.0-or-later
"""Sharp Edges: those of crisp shapes, which follow them."""

import bpy
import numpy as np
import pytest
from live_steps import confirm, tick_to_rest
from scene import add_monkey, cubify


def sharp(mesh):
    """Return which edges are sharp, or None."""
    marks = mesh.attributes.get("sharp_edge")
    return None if marks is None else np.array([each.value for each in marks.data])


def expected(mesh):
    """Return which edges turn by more than 30 degrees."""
    copy = mesh.copy()
    copy.set_sharp_from_angle(angle=np.radians(30.0))
    found = sharp(copy)
    bpy.data.meshes.remove(copy)
    return found


def is_unmarked(mesh):
    return sharp(mesh) is None and "cubic_craft_sharp_edges" not in mesh


@pytest.fixture
def monkey():
    obj = add_monkey()
    obj.data.shade_smooth()
    return obj


def test_marks_follow_the_shape_until_restore(monkey):
    mesh = monkey.data
    cubify(cubeness=0.4)
    first = sharp(mesh)
    assert first.sum() > 20 and np.array_equal(first, expected(mesh))
    cubify(cubeness=0.4, orientation=(0.0, 0.0, 0.6))
    assert not np.array_equal(sharp(mesh), first)
    assert np.array_equal(sharp(mesh), expected(mesh))
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert sharp(mesh) is None and not list(mesh.keys())


def test_the_switch_shades_a_result_at_once_and_apply_keeps_the_marks(monkey):
    mesh = monkey.data
    cubify(cubeness=0.4)
    marks = sharp(mesh)
    monkey.cubic_craft.sharp_edges = False
    assert is_unmarked(mesh)
    cubify()
    assert is_unmarked(mesh)
    monkey.cubic_craft.sharp_edges = True
    assert np.array_equal(sharp(mesh), marks)
    bpy.ops.cubic_craft.apply()
    assert np.array_equal(sharp(mesh), marks) and not list(mesh.keys())


def test_a_soft_result_loses_them(monkey):
    cubify(cubeness=0.4)
    cubify(crispness=0.0)
    assert is_unmarked(monkey.data)


def test_a_new_object_has_them_and_the_original_has_none(monkey):
    cubify(cubeness=0.4, result="NEW_OBJECT")
    new = bpy.context.object
    assert is_unmarked(monkey.data) and np.array_equal(sharp(new.data), expected(new.data))


def test_marks_that_the_artist_has_removed_do_not_keep_restore_from_its_work(monkey):
    mesh = monkey.data
    cubify(cubeness=0.4)
    mesh.attributes.remove(mesh.attributes["sharp_edge"])
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert sharp(mesh) is None and not list(mesh.keys())


def test_an_empty_attribute_of_the_artist_stays(monkey):
    mesh = monkey.data
    mesh.attributes.new("sharp_edge", "BOOLEAN", "EDGE")
    cubify(cubeness=0.4)
    assert sharp(mesh).any()
    bpy.ops.cubic_craft.restore()
    assert not sharp(mesh).any()


def normals_of(mesh):
    """Return the normal (k,3) of each corner, as it is shaded."""
    values = np.empty(3 * len(mesh.loops), np.float32)
    mesh.corner_normals.foreach_get("vector", values)
    return values.reshape(-1, 3)


def test_normals_of_importers_that_are_those_of_blender_return_with_restore(monkey):
    mesh = monkey.data
    offsets = np.random.default_rng(0).normal(0.0, 0.01, (len(mesh.vertices), 3))
    normals = np.array([vertex.normal[:] for vertex in mesh.vertices]) + offsets
    mesh.normals_split_custom_set_from_vertices(normals.tolist())
    before = normals_of(mesh)
    cubify(cubeness=0.4)
    plain = mesh.copy()
    if "cubic_craft_normals" in plain.attributes:
        plain.attributes.remove(plain.attributes["cubic_craft_normals"])
    plain.set_sharp_from_angle(angle=np.radians(30.0))
    assert np.array_equal(sharp(mesh), sharp(plain)) and sharp(mesh).any()
    assert np.einsum("ij,ij->i", normals_of(mesh), normals_of(plain)).min() > 0.98
    bpy.data.meshes.remove(plain)
    bpy.ops.cubic_craft.restore()
    assert mesh.has_custom_normals and np.array_equal(normals_of(mesh), before)
    assert not sharp(mesh).any(), "Blender has made the attribute for the normals"
    assert not list(mesh.keys()) and "cubic_craft_normals" not in mesh.attributes


def _subdivision(obj):
    obj.modifiers.new("Subdivision", "SUBSURF")


def _by_angle(obj):
    modifier = obj.modifiers.new("Smooth by Angle", "NODES")
    modifier.node_group = bpy.data.node_groups.new("Smooth by Angle", "GeometryNodeTree")


def _own_edge(obj):
    obj.data.edges[7].use_edge_sharp = True


def _flat_faces(obj, share=0.6):
    for polygon in obj.data.polygons[: int(share * len(obj.data.polygons))]:
        polygon.use_smooth = False


def _own_normals(obj):
    mesh = obj.data
    mesh.normals_split_custom_set([(0.0, 0.0, 1.0)] * len(mesh.loops))


@pytest.mark.parametrize("own", [_subdivision, _by_angle, _own_edge, _flat_faces, _own_normals])
def test_what_looks_as_the_artist_wants_is_not_touched(monkey, own):
    own(monkey)
    before = sharp(monkey.data)
    cubify(cubeness=0.4)
    assert "cubic_craft_sharp_edges" not in monkey.data
    now = sharp(monkey.data)
    assert (before is None) == (now is None) and (now is None or np.array_equal(now, before))


def test_a_few_flat_faces_stay_flat_beside_sharp_edges(monkey):
    """As importers of glTF make them where the normals of the corners are those of the face."""
    _flat_faces(monkey, share=0.02)
    cubify(cubeness=0.4)
    assert np.array_equal(sharp(monkey.data), expected(monkey.data)) and sharp(monkey.data).any()
    assert not monkey.data.polygons[0].use_smooth and monkey.data.polygons[-1].use_smooth


def test_a_shape_key_has_none(monkey):
    cubify(cubeness=0.4, result="SHAPE_KEY")
    assert is_unmarked(monkey.data)


@pytest.fixture
def session(monkey, begin):
    return tick_to_rest(begin(monkey, cubeness=0.4))


def test_live_shows_them_and_cancel_removes_them(monkey, session, live):
    mesh = monkey.data
    assert np.array_equal(sharp(mesh), expected(mesh))
    live.live_properties().crispness = 0.0
    session.wake()
    tick_to_rest(session)
    assert sharp(mesh) is None
    session.on(live.Event.CANCEL)
    assert sharp(mesh) is None and not list(mesh.keys())


def test_live_gives_back_those_of_an_earlier_result(monkey, begin, live):
    mesh = monkey.data
    cubify(cubeness=0.4)
    before = sharp(mesh)
    session = tick_to_rest(begin(monkey, crispness=0.0))
    assert is_unmarked(mesh)
    session.on(live.Event.CANCEL)
    assert np.array_equal(sharp(mesh), before)


def test_live_keeps_them_when_confirmed_and_in_a_file(monkey, session, live):
    mesh = monkey.data
    shown = sharp(mesh)
    session.on(live.Event.SAVE)
    assert np.array_equal(sharp(mesh), shown), "the file has a result"
    session.on(live.Event.SAVED)
    confirm(live, session)
    assert np.array_equal(sharp(mesh), shown) and np.array_equal(shown, expected(mesh))


def test_edit_mode_during_live_leaves_none_of_its_marks(monkey, session, live, part):
    mesh = monkey.data
    bpy.ops.object.mode_set(mode="EDIT")
    part("mesh_bridge").end_preview(mesh)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not any(edge.use_edge_sharp for edge in mesh.edges)
    session.on(live.Event.CANCEL)

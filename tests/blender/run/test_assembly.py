# SPDX-License-Identifier: GPL-3.0-or-later
"""Several selected objects are solved as one: in world space, and read back by each."""

import importlib

import bpy
import numpy as np
import pytest
from live_steps import bits, confirm, tick_to_rest
from mathutils import Euler, Matrix
from posing import follow, pin
from rich_mesh import position_of
from scene import cubify, reports_of, select

PLACES = {
    "Body": Matrix.Identity(4),
    "Turned": Matrix.LocRotScale((1.6, 0.2, 0.3), Euler((0.4, -0.9, 2.0)), (0.6, 0.6, 0.6)),
    "Mirrored": Matrix.LocRotScale((-1.5, 0.1, 0.2), Euler((0.1, 0.3, -0.2)), (-0.5, 0.8, 0.6)),
}
# Of each object in its own coordinates: a vertex is where float32 puts it, and its opposite ones
# may be others.
ROUNDING = 2e-4


@pytest.fixture
def trio():
    """Three lumps that touch, each with another transform."""
    objects = []
    for number, (name, place) in enumerate(PLACES.items()):
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3 + number % 2)
        obj = bpy.context.object
        obj.name = name
        # Without symmetry: on a ball every vertex has many others opposite, by rounding.
        V = position_of(obj.data)
        V *= 1 + 0.2 * np.sin(3 * V[:, :1] + number) * np.cos(2 * V[:, 1:2] - V[:, 2:])
        obj.data.vertices.foreach_set("co", V.ravel())
        obj.data.update()
        obj.matrix_world = place
        obj.cubic_craft.refine = "OFF"  # on a finer copy each solve takes several times as long
        objects.append(obj)
    bpy.context.view_layer.update()
    select(*objects)
    return objects


def world_positions(obj):
    matrix = np.array(obj.matrix_world, dtype=np.float64)
    return position_of(obj.data).astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def joined(objects):
    """Make one object of what the objects are in world space, faces turned out everywhere."""
    V, F = [], []
    for obj in objects:
        flip = -1 if obj.matrix_world.determinant() < 0.0 else 1
        F += [[len(V) + v for v in p.vertices][::flip] for p in obj.data.polygons]
        V += world_positions(obj).tolist()
    mesh = bpy.data.meshes.new("Joined")
    mesh.from_pydata(V, [], F)
    obj = bpy.data.objects.new("Joined", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.update()
    return obj


@pytest.mark.thorough(2)
@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_three_objects_become_what_their_joined_mesh_becomes(trio, result):
    one = joined(trio)
    options = {"space": "WORLD", "orientation": (0.1, 0.2, 0.3), "tolerance": 1e-4}
    options["refine"] = "AUTO" if result == "MESH" else "OFF"
    select(one)
    bpy.ops.cubic_craft.cubify(**options)
    select(*trio)
    assert bpy.ops.cubic_craft.cubify(**options, result=result) == {"FINISHED"}
    made = trio if result != "NEW_OBJECT" else [bpy.data.objects[f"{n} Cubic"] for n in PLACES]
    if result == "SHAPE_KEY":
        for obj in made:
            obj.data.shape_keys.key_blocks["Cubic"].value = 1.0
            key = obj.data.shape_keys.key_blocks["Cubic"]
            points = np.array([point.co for point in key.points], dtype=np.float32)
            obj.data.attributes["position"].data.foreach_set("vector", points.ravel())
    found = np.concatenate([world_positions(obj) for obj in made])
    np.testing.assert_allclose(found, position_of(one.data), atol=ROUNDING)


@pytest.mark.parametrize("together", ["OFF", "PARTS"])
def test_without_the_selection_each_is_solved_for_itself(trio, together):
    cubify(together=together)
    found = [position_of(obj.data) for obj in trio]
    for obj, shape in zip(trio, found, strict=True):
        select(obj)
        bpy.ops.cubic_craft.restore()
        cubify(together=together)
        np.testing.assert_array_equal(position_of(obj.data), shape)
        assert " of " not in obj.cubic_craft.status
    select(*trio)
    bpy.ops.cubic_craft.restore()
    cubify(together="SELECTION")
    assert np.abs(position_of(trio[1].data) - found[1]).max() > 1e-3


def test_one_alone_is_the_same_with_the_selection_and_wherever_it_is(trio):
    obj = trio[1]
    select(obj)
    cubify(together="PARTS")
    shape = position_of(obj.data)
    obj.location = (700.0, 3.0, -2.0)
    bpy.context.view_layer.update()
    cubify(together="SELECTION")
    np.testing.assert_array_equal(position_of(obj.data), shape)


def test_a_bad_one_among_three_is_named_and_the_others_are_done(trio):
    body, turned, mirrored = trio
    before = [position_of(obj.data) for obj in trio]
    turned.data.vertices[5].co.x = float("nan")
    assert '"Turned"' in reports_of(cubify).replace("'", '"')
    for obj, shape in ((body, before[0]), (mirrored, before[2])):
        assert np.abs(position_of(obj.data) - shape).max() > 1e-3
        assert "of 2 objects" in obj.cubic_craft.status
    assert not turned.cubic_craft.status


def test_a_mesh_of_two_objects_takes_part_once(trio):
    twin = trio[0].copy()
    bpy.context.collection.objects.link(twin)
    select(*trio, twin)
    assert "shares its mesh" not in reports_of(cubify)
    count = sum(len(obj.data.vertices) for obj in trio)
    assert trio[0].cubic_craft.status.startswith(f"{count:,} vertices of 3 objects")


def test_handles_hold_and_pose_in_each_objects_coordinates(trio):
    _, turned, mirrored = trio
    for obj in (turned, mirrored):
        obj.vertex_groups.new(name="Tip").add(range(40), 1.0, "REPLACE")
    pin(mirrored, "Tip")
    empty = follow(turned, "Tip")
    before = {obj: position_of(obj.data) for obj in trio}
    empty.location.x += 0.3
    bpy.context.view_layer.update()
    select(*trio)
    cubify()
    np.testing.assert_array_equal(position_of(mirrored.data)[:40], before[mirrored][:40])
    moved = position_of(turned.data)[:40] - before[turned][:40]
    np.testing.assert_allclose(moved, [[0.3, 0.0, 0.0]] * 40, atol=1e-5)


@pytest.mark.thorough(3)
@pytest.mark.parametrize("change", ["place", "solidity", "map", "together", "gone"])
def test_what_live_leaves_is_what_cubify_gives(live, begin, trio, change):
    session = tick_to_rest(begin(*trio, cubeness=0.5))
    before = [bits(obj) for obj in trio]
    group = trio[1].vertex_groups.new(name="Map")
    group.add(range(100), 1.0, "REPLACE")
    if change == "place":
        trio[1].location.x -= 0.3  # into the body
    elif change == "solidity":
        live.live_properties().solidity = 0.6
    elif change == "together":
        live.live_properties().together = "PARTS"
    elif change == "map":
        trio[1].cubic_craft.map_group = "Map"
    else:
        bpy.data.objects.remove(trio.pop())
        before.pop()
    tick_to_rest(session)
    assert [bits(obj) for obj in trio] != before
    assert len(session.meshes) == len(trio)
    confirm(live, session)
    shapes = [bits(obj) for obj in trio]
    statuses = [obj.cubic_craft.status.split(", ")[0] for obj in trio]
    select(*trio)
    bpy.ops.cubic_craft.restore()
    bpy.ops.cubic_craft.cubify()
    assert [bits(obj) for obj in trio] == shapes
    assert [obj.cubic_craft.status.split(", ")[0] for obj in trio] == statuses


def test_live_does_not_look_for_links_again(live, begin, trio, extension, monkeypatch):
    rest = importlib.import_module(f"{extension.__name__}.solver.surface.preparation")
    looked = []
    rest_mesh = rest.rest_mesh

    def counted(*arguments, **others):
        looked.append(arguments)
        return rest_mesh(*arguments, **others)

    monkeypatch.setattr(rest, "rest_mesh", counted)
    session = begin(*trio)
    for name, value in (("cubeness", 0.7), ("solidity", 0.5), ("orientation", (0.1, 0.0, 0.2))):
        setattr(live.live_properties(), name, value)
        tick_to_rest(session)
    trio[0].vertex_groups.new(name="Map").add([1, 2, 3], 1.0, "REPLACE")
    trio[0].cubic_craft.map_group = "Map"
    tick_to_rest(session)
    assert len(looked) == 1
    trio[1].location.x += 0.1
    tick_to_rest(session)
    assert len(looked) == 2
    confirm(live, session)


def test_live_goes_on_without_the_one_that_cannot_be_used(live, begin, trio):
    session = tick_to_rest(begin(*trio))
    trio[2].cubic_craft.map_group = "Missing"
    tick_to_rest(session)
    (problem,) = session.all_problems
    assert "Missing" in problem and "Mirrored" in problem
    assert session.mesh_of(trio[2]).solution is None
    assert session.mesh_of(trio[0]).solution.objects == 2
    trio[2].cubic_craft.map_group = ""
    tick_to_rest(session)
    assert not session.all_problems and session.mesh_of(trio[2]).solution.objects == 3
    confirm(live, session)

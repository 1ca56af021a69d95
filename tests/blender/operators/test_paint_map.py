# SPDX-License-Identifier: GPL-3.0-or-later
import bpy
import pytest
from scene import add_monkey


@pytest.fixture
def monkey():
    yield add_monkey()
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def test_a_click_makes_the_map_and_the_next_leads_back(monkey):
    assert bpy.ops.cubic_craft.paint_map() == {"FINISHED"}
    assert monkey.mode == "WEIGHT_PAINT"
    (group,) = monkey.vertex_groups
    assert monkey.cubic_craft.map_group == group.name
    assert all(group.weight(vertex.index) == 1.0 for vertex in monkey.data.vertices)
    assert bpy.ops.cubic_craft.paint_map() == {"FINISHED"}
    assert monkey.mode == "OBJECT" and len(monkey.vertex_groups) == 1


def test_a_map_that_is_there_is_painted(monkey):
    for name in ("Map", "Other"):
        monkey.vertex_groups.new(name=name)
    monkey.cubic_craft.map_group = "Map"
    assert bpy.ops.cubic_craft.paint_map() == {"FINISHED"}
    assert monkey.vertex_groups.active.name == "Map" and len(monkey.vertex_groups) == 2


def test_while_live_runs_the_map_is_that_of_live(monkey, live, begin):
    monkey.cubic_craft.refine = "OFF"
    session = begin(monkey)
    assert bpy.ops.cubic_craft.paint_map() == {"FINISHED"}
    session.tick(bpy.context)
    assert not session.is_ended
    assert live.live_properties().map_group == monkey.vertex_groups[0].name
    assert not monkey.cubic_craft.map_group
    session.on(live.Event.CANCEL)


def test_a_mesh_of_another_file_is_refused_and_nothing_made(monkey, tmp_path):
    bpy.data.libraries.write(str(tmp_path / "other.blend"), {monkey.data})
    with bpy.data.libraries.load(str(tmp_path / "other.blend"), link=True) as (there, here):
        here.meshes = there.meshes
    monkey.data = here.meshes[0]
    assert not bpy.ops.cubic_craft.paint_map.poll()
    assert not monkey.vertex_groups and not monkey.cubic_craft.map_group

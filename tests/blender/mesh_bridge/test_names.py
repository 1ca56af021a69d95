# SPDX-License-Identifier: GPL-3.0-or-later
"""Our names that the artist has given to vertex groups, UV maps and other attributes."""

import bpy
import pytest
from rich_mesh import cubic_like, position_of
from snapshot import differences, snapshot_mesh, snapshot_object

NAMES = (
    "cubic_craft_original",
    "cubic_craft_rotation",
    "cubic_craft_original.key1",
    "cubic_craft_original.strokes",
    "cubic_craft_first",
)
NUMBERED = "cubic_craft_original.001"  # what Blender calls an attribute, ours being there already


def add_groups(obj):
    """Add vertex groups of our names, with all vertices in them."""
    for number, name in enumerate(NAMES):
        group = obj.vertex_groups.new(name=name)
        group.add(range(len(obj.data.vertices)), 0.25 * (1 + number), "REPLACE")


def without_group_names(taken):
    """Take the names of the vertex groups out of a snapshot; indices and weights stay."""
    return taken | {"groups": [group[1:] for group in taken["groups"]]}


@pytest.mark.parametrize("when", ["before", "after", "between two"])
@pytest.mark.parametrize("end", ["restore", "discard_original"])
def test_groups_cost_neither_the_original_nor_themselves(bridge, cubify, monkey, when, end):
    original = position_of(monkey.data).tobytes()
    if when != "before":
        cubify(monkey)
    add_groups(monkey)
    if when != "after":
        cubify(monkey)
    assert bridge.has_original(monkey.data)
    groups = without_group_names(snapshot_object(monkey))["groups"]
    weights = [[(e.group, e.weight) for e in v.groups] for v in monkey.data.vertices]
    if end == "restore":
        bridge.restore(monkey)
        assert position_of(monkey.data).tobytes() == original
    else:
        bridge.discard_original(monkey.data)
    assert not bridge.has_traces(monkey.data)
    assert without_group_names(snapshot_object(monkey))["groups"] == groups
    assert [[(e.group, e.weight) for e in v.groups] for v in monkey.data.vertices] == weights


def test_preview_under_groups_of_its_names(bridge, monkey):
    for name in ("cubic_craft_live", "cubic_craft_live.position", "cubic_craft_live.key1"):
        monkey.vertex_groups.new(name=name).add(range(9), 0.5, "REPLACE")
    before = snapshot_mesh(monkey.data)
    preview = bridge.Preview(monkey.data)
    preview.show(monkey.data, *cubic_like(bridge.read_positions(monkey.data)))
    assert bridge.end_preview(monkey.data)
    assert differences(before, snapshot_mesh(monkey.data)) == []


def test_settings_follow_a_group_to_its_other_name(bridge, cubify, plain_monkey):
    cubify(plain_monkey)
    group = plain_monkey.vertex_groups[0]
    plain_monkey.cubic_craft.map_group = group.name
    bpy.context.view_layer.update()
    group.name = "cubic_craft_original"
    bpy.context.view_layer.update()
    assert plain_monkey.cubic_craft.map_group == group.name == NUMBERED


@pytest.mark.parametrize("rename", ["group", "new", "twice"])
def test_group_in_edit_mode(bridge, cubify, plain_monkey, rename):
    """Blender 5.2 drops our attribute there on leaving, if nothing is done."""
    mesh = plain_monkey.data
    original = position_of(mesh).tobytes()
    cubify(plain_monkey)
    bpy.ops.object.mode_set(mode="EDIT")
    for _ in range(2 if rename == "twice" else 1):
        if rename == "new":
            plain_monkey.vertex_groups.new(name="cubic_craft_original")
        else:
            plain_monkey.vertex_groups[0].name = "cubic_craft_original"
        bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert "cubic_craft_original" not in plain_monkey.vertex_groups
    bridge.restore(plain_monkey)
    assert position_of(mesh).tobytes() == original


@pytest.mark.thorough(12)
@pytest.mark.parametrize("kind", ["UV map", "color", "vector of faces", "number"])
@pytest.mark.parametrize("name", NAMES)
def test_attribute_of_the_artist_in_the_way(bridge, error, monkey, kind, name):
    mesh = monkey.data
    if kind == "UV map":
        mesh.uv_layers.new(name=name)
    elif kind == "color":
        mesh.color_attributes.new(name, "BYTE_COLOR", "CORNER")
    elif kind == "number":
        mesh.attributes.new(name, "FLOAT", "POINT")
    else:
        mesh.attributes.new(name, "FLOAT_VECTOR", "FACE")
    before = snapshot_object(monkey)
    positions, rotations = cubic_like(bridge.read_positions(mesh))
    for call in (
        lambda: bridge.check_usable(monkey),
        lambda: bridge.write_mesh(mesh, positions, rotations),
        lambda: bridge.write_new_object(monkey, positions, rotations),
        lambda: bridge.Preview(mesh),
    ):
        with pytest.raises(error, match=f'"Monkey" has an attribute "{name}".*rename or remove'):
            call()
    bridge.discard_original(mesh)
    assert not bridge.has_traces(mesh)
    assert differences(before, snapshot_object(monkey)) == []

# SPDX-License-Identifier: GPL-3.0-or-later
"""The helper that proves that nothing changed must see every change."""

import bpy
import pytest
from rich_mesh import add_rich_monkey, points_of, set_points
from snapshot import differences, snapshot_object


def _move_point(obj):
    points = points_of(obj.data, "Wide")
    points[5, 0] += 1e-6
    set_points(obj.data, "Wide", points)


def _turn_custom_normal(obj):
    normals = [corner.vector[:] for corner in obj.data.corner_normals]
    normals[40] = (0.0, 0.0, 1.0)
    obj.data.normals_split_custom_set(normals)


def _swap_relative(obj):
    keys = obj.data.shape_keys.key_blocks
    keys["Smile"].relative_key = keys["Wide"]


CHANGES = {
    "vertex": lambda o: setattr(o.data.vertices[3].co, "x", 0.5),
    "uv": lambda o: setattr(o.data.uv_layers["UVMap"].data[9], "uv", (0.5, 0.25)),
    "active uv": lambda o: setattr(o.data.uv_layers, "active_index", 0),
    "render uv": lambda o: setattr(o.data.uv_layers["Second"], "active_render", True),
    "color": lambda o: setattr(o.data.color_attributes["Dirt"].data[4], "color", (1, 0, 0, 1)),
    "active color": lambda o: setattr(o.data.color_attributes, "active_color_name", "Dirt"),
    "active attribute": lambda o: setattr(o.data.attributes, "active_index", 0),
    "string": lambda o: setattr(o.data.attributes["word"].data[3], "value", b"fourth"),
    "seam": lambda o: setattr(o.data.edges[2], "use_seam", not o.data.edges[2].use_seam),
    "custom normal": _turn_custom_normal,
    "material index": lambda o: setattr(
        o.data.polygons[2], "material_index", 1 - o.data.polygons[2].material_index
    ),
    "material": lambda o: o.data.materials.append(None),
    "weight": lambda o: o.vertex_groups["Empty"].add([7], 0.5, "REPLACE"),
    "group": lambda o: setattr(o.vertex_groups["Pin"], "name", "Nail"),
    "modifier": lambda o: setattr(o.modifiers["Displace"], "mid_level", 0.25),
    "constraint": lambda o: setattr(o.constraints[0], "use_x", False),
    "object property": lambda o: o.__setitem__("price", 13.0),
    "mesh property": lambda o: o.data.__setitem__("note", "other"),
    "location": lambda o: setattr(o, "location", (0, 0, 0)),
    "key point": _move_point,
    "key mute": lambda o: setattr(o.data.shape_keys.key_blocks["Wide"], "mute", True),
    "key mask": lambda o: setattr(o.data.shape_keys.key_blocks["Wide"], "vertex_group", "Pin"),
    "key range": lambda o: setattr(o.data.shape_keys.key_blocks["Smile"], "slider_max", 2.0),
    "key name": lambda o: setattr(o.data.shape_keys.key_blocks["Smile"], "name", "Grin"),
    "key relative": _swap_relative,
    "active key": lambda o: setattr(o, "active_shape_key_index", 1),
    "driver": lambda o: setattr(
        o.data.shape_keys.animation_data.drivers[0].driver, "expression", "height"
    ),
    "key animation": lambda o: o.data.shape_keys.key_blocks["Smile"].keyframe_insert(
        "value", frame=5
    ),
    "object animation": lambda o: o.keyframe_insert("location", frame=7),
    "face": lambda o: o.data.polygons[0].flip(),
}


@pytest.mark.thorough(10)
@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES.keys())
def test_every_change_is_seen(change):
    obj = add_rich_monkey(keys=True)
    before = snapshot_object(obj)
    assert differences(before, snapshot_object(obj)) == []
    change(obj)
    assert differences(before, snapshot_object(obj)) != []


def test_nothing_is_left_behind():
    obj = add_rich_monkey(keys=True)
    meshes = len(bpy.data.meshes), len(bpy.data.shape_keys)
    snapshot_object(obj)
    assert meshes == (len(bpy.data.meshes), len(bpy.data.shape_keys))

# SPDX-License-Identifier: GPL-3.0-or-later
"""A result that cannot be seen is said to be so, before the click and after it."""

import bpy
import numpy as np
import pytest
from rich_mesh import position_of
from scene import add_monkey, cubify, reports_of, select


def _cached(obj, tmp_path, frames=3):
    """Play the shape of an object from a .pc2 file."""
    points = position_of(obj.data).astype("<f4")
    path = tmp_path / "cache.pc2"
    head = b"POINTCACHE2\0" + np.array([1, len(points)], "<i4").tobytes()
    head += np.array([0, 1], "<f4").tobytes() + np.array([frames], "<i4").tobytes()
    path.write_bytes(head + points.tobytes() * frames)
    modifier = obj.modifiers.new("Cache", "MESH_CACHE")
    modifier.cache_format, modifier.filepath = "PC2", str(path)


def _sequence(obj, tmp_path):
    """Play it from an Alembic file."""
    path = tmp_path / "cache.abc"
    select(obj)
    bpy.ops.wm.alembic_export(filepath=str(path), selected=True, start=1, end=2)
    bpy.ops.cachefile.open(filepath=str(path))
    modifier = obj.modifiers.new("Sequence", "MESH_SEQUENCE_CACHE")
    modifier.cache_file = bpy.data.cache_files[-1]
    modifier.object_path = f"/{obj.name}/{obj.data.name}"


def _laplacian(obj, _):
    z = position_of(obj.data)[:, 2]
    group = obj.vertex_groups.new(name="Anchors")
    group.add(np.flatnonzero(abs(z) > 0.6).tolist(), 1.0, "REPLACE")
    modifier = obj.modifiers.new("Laplacian", "LAPLACIANDEFORM")
    modifier.vertex_group = "Anchors"
    select(obj)
    bpy.ops.object.laplaciandeform_bind(modifier=modifier.name)


def _surface(obj, _):
    bpy.ops.mesh.primitive_cube_add(size=4)
    modifier = obj.modifiers.new("Surface", "SURFACE_DEFORM")
    modifier.target = bpy.context.object
    select(obj)
    bpy.ops.object.surfacedeform_bind(modifier=modifier.name)


def _nodes(obj, _):
    """Let geometry nodes, which no list knows, show what the mesh was."""
    stored = obj.data.attributes.new("was", "FLOAT_VECTOR", "POINT")
    stored.data.foreach_set("vector", position_of(obj.data).ravel())
    tree = bpy.data.node_groups.new("Was", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    begin, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    put, named = (
        tree.nodes.new("GeometryNodeSetPosition"),
        tree.nodes.new("GeometryNodeInputNamedAttribute"),
    )
    named.data_type, named.inputs["Name"].default_value = "FLOAT_VECTOR", "was"
    tree.links.new(begin.outputs[0], put.inputs["Geometry"])
    tree.links.new(named.outputs["Attribute"], put.inputs["Position"])
    tree.links.new(put.outputs[0], end.inputs[0])
    obj.modifiers.new("Was", "NODES").node_group = tree


COVERS = [_cached, _sequence, _laplacian, _surface, _nodes]


@pytest.mark.thorough(3)
@pytest.mark.parametrize("cover", COVERS)
def test_a_covered_result_is_a_warning(cover, tmp_path, part):
    obj = add_monkey()
    cover(obj, tmp_path)
    bridge = part("mesh_bridge")
    assert bridge.covers(obj) == ([] if cover == _nodes else [obj.modifiers[0].name])
    reports = reports_of(lambda: cubify(max_iterations=5)).splitlines()
    said = [text for text in reports if "still shows the old shape" in text]
    assert len(said) == 1 and "Cubify What You See" in said[0]
    assert ("one of its modifiers" in said[0]) == (cover == _nodes)
    assert obj.modifiers[0].name in said[0] or cover == _nodes


def test_a_pinned_shape_key_covers_it():
    obj = add_monkey()
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Pinned")
    obj.active_shape_key_index, obj.show_only_shape_key = 1, True
    said = reports_of(lambda: cubify(max_iterations=5, result="SHAPE_KEY"))
    assert "still shows the old shape, which the pinned shape key brings" in said

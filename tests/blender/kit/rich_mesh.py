# SPDX-License-Identifier: GPL-3.0-or-later
"""A monkey with everything on it that an artist may have, and a stand-in for the solver."""

from typing import Any

import bmesh
import bpy
import numpy as np


def add_rich_monkey(*, keys: bool) -> Any:
    """Add a monkey with n-gons, loose parts and all kinds of data; with shape keys if `keys`."""
    bpy.ops.mesh.primitive_monkey_add(location=(1, 2, 3), rotation=(0.1, 0.2, 0.3))
    obj: Any = bpy.context.object
    mesh = obj.data
    mesh.name = "Monkey"
    _edit_topology(mesh)
    rng = np.random.default_rng(1)
    _add_surface_data(mesh, rng)
    _add_attributes(mesh, rng)
    _add_object_data(obj, rng)
    if keys:
        _add_shape_keys(obj, rng)
    mesh["note"] = "of the artist"
    mesh.attributes.active_index = mesh.attributes.find("heat")
    return obj


def cubic_like(base: np.ndarray, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Deform positions smoothly and make up a rotation for each: what a solver would return."""
    rng = np.random.default_rng(seed)
    strength = 0.5 + 0.1 * seed
    positions = np.tanh(base.astype(np.float64) / strength) * strength + 0.01 * (1 + seed)
    matrices = np.linalg.qr(rng.normal(size=(len(base), 3, 3)))[0]
    matrices *= np.linalg.det(matrices)[:, None, None]
    return positions.astype(np.float32), matrices


def points_of(mesh: Any, name: str) -> np.ndarray:
    """Read the points of a shape key."""
    points = mesh.shape_keys.key_blocks[name].points
    flat = np.empty(3 * len(points), np.float32)
    points.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def set_points(mesh: Any, name: str, values: np.ndarray) -> None:
    """Edit a shape key as an artist would."""
    mesh.shape_keys.key_blocks[name].points.foreach_set("co", np.float32(values).ravel())
    mesh.update()


def position_of(mesh: Any) -> np.ndarray:
    """Read the ``position`` attribute."""
    flat = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.attributes["position"].data.foreach_get("vector", flat)
    return flat.reshape(-1, 3)


def set_position(mesh: Any, values: np.ndarray) -> None:
    """Move vertices as an artist would."""
    mesh.vertices.foreach_set("co", np.float32(values).ravel())
    mesh.update()


def _edit_topology(mesh: Any) -> None:
    """Make n-gons, two loose vertices and a loose edge; zeros of both signs."""
    bm = bmesh.new()
    bm.from_mesh(mesh)
    bm.edges.ensure_lookup_table()
    bmesh.ops.dissolve_edges(bm, edges=[bm.edges[i] for i in (100, 101, 300, 400, 401, 402)])
    for vertex in bm.verts:
        if abs(vertex.co.x) < 1e-6 and vertex.co.z > 0:
            vertex.co.x = -0.0
    bm.verts.new((2.0, -0.5, 1.0))
    bm.verts.new((-0.0, 3.0, -0.0))
    bm.edges.new((bm.verts.new((0.0, 0.0, 5.0)), bm.verts.new((0.1, 1e-30, 6.0))))
    bm.to_mesh(mesh)
    bm.free()


def _add_surface_data(mesh: Any, rng: np.random.Generator) -> None:
    for name in ("Red", "Blue"):
        mesh.materials.append(bpy.data.materials.new(name))
    mesh.polygons.foreach_set("material_index", rng.integers(0, 2, len(mesh.polygons), np.int32))
    layer = mesh.uv_layers.new(name="Second")
    uv = rng.random(2 * len(mesh.loops), np.float32)
    layer.data.foreach_set("uv", uv)
    mesh.uv_layers["UVMap"].active_render = True
    mesh.uv_layers.active = layer
    for name, kind, domain in (("Dirt", "FLOAT_COLOR", "POINT"), ("Paint", "BYTE_COLOR", "CORNER")):
        colors = mesh.color_attributes.new(name, kind, domain)
        colors.data.foreach_set("color", rng.random(4 * len(colors.data), np.float32))
    mesh.color_attributes.active_color_name = "Paint"
    mesh.attributes.default_color_name = "Dirt"
    mesh.edges.foreach_set("use_seam", rng.random(len(mesh.edges)) < 0.1)
    mesh.edges.foreach_set("use_edge_sharp", rng.random(len(mesh.edges)) < 0.1)
    mesh.polygons.foreach_set("use_smooth", rng.random(len(mesh.polygons)) < 0.8)
    normals = rng.normal(size=(len(mesh.loops), 3))
    mesh.normals_split_custom_set((normals / np.linalg.norm(normals, axis=1)[:, None]).tolist())


def _add_attributes(mesh: Any, rng: np.random.Generator) -> None:
    for name, kind, domain in (
        ("crease_edge", "FLOAT", "EDGE"),
        ("bevel_weight_vert", "FLOAT", "POINT"),
        ("heat", "FLOAT", "FACE"),
        ("flow", "FLOAT_VECTOR", "POINT"),
        ("spin", "QUATERNION", "POINT"),
    ):
        attribute = mesh.attributes.new(name, kind, domain)
        rna_name, size = {"FLOAT": ("value", 1), "FLOAT_VECTOR": ("vector", 3)}.get(
            kind, ("value", 4)
        )
        values = rng.random(size * len(attribute.data), np.float32)
        attribute.data.foreach_set(rna_name, values)
    words = mesh.attributes.new("word", "STRING", "POINT")
    words.data[3].value = b"third"


def _add_object_data(obj: Any, rng: np.random.Generator) -> None:
    for name, share in (("Pin", 0.1), ("Map", 0.6), ("Empty", 0.0)):
        group = obj.vertex_groups.new(name=name)
        for index in np.flatnonzero(rng.random(len(obj.data.vertices)) < share):
            group.add([int(index)], float(rng.random()), "REPLACE")
    obj.vertex_groups["Map"].lock_weight = True
    obj.vertex_groups.active_index = 1
    subdivision = obj.modifiers.new("Subdivision", "SUBSURF")
    subdivision.levels = 0
    displace = obj.modifiers.new("Displace", "DISPLACE")
    displace.vertex_group = "Map"
    displace.strength = 0.0
    target = bpy.data.objects.new("Target", None)
    bpy.context.collection.objects.link(target)
    obj.constraints.new("COPY_SCALE").target = target
    obj["price"] = 12.5
    obj.keyframe_insert("location", frame=1)


def _add_shape_keys(obj: Any, rng: np.random.Generator) -> None:
    mesh = obj.data
    base = position_of(mesh)
    obj.shape_key_add(name="Basis", from_mix=False)
    for name in ("Smile", "Frown", "Wide", "A name of sixty bytes, longer than attributes can be"):
        key = obj.shape_key_add(name=name, from_mix=False)
        some = rng.random((len(base), 1)) < 0.3
        set_points(mesh, name, np.where(some, base + rng.normal(0, 0.05, base.shape), base))
        key.value = float(rng.random())
    keys = mesh.shape_keys.key_blocks
    # Before the key that it is relative to, and with an offset from that.
    keys["Smile"].relative_key = keys["Frown"]
    keys["Smile"].interpolation = "KEY_CARDINAL"
    keys["Frown"].vertex_group = "Map"
    keys["Frown"].mute = True
    keys["Wide"].slider_min, keys["Wide"].slider_max = -2.0, 3.0
    driver = keys["Wide"].driver_add("value").driver
    variable = driver.variables.new()
    variable.name = "height"
    variable.targets[0].id = obj
    variable.targets[0].data_path = "location.z"
    driver.expression = "height * 0.25"
    keys["Smile"].keyframe_insert("value", frame=1)
    mesh.shape_keys.name = "Faces"
    obj.active_shape_key_index = 2

# SPDX-License-Identifier: GPL-3.0-or-later
"""A complete copy of a mesh and an object in plain values, to prove that nothing changed.

`snapshot_mesh` and `snapshot_object` return flat dictionaries from a path, such as
``attributes/UVMap/values``, to plain values; arrays as raw bytes. They know no list of what to look
at: all attributes and all simple RNA properties of the version of Blender at hand are taken.
`differences` names the paths that are not the same.
"""

import contextlib
import fnmatch
import re
from collections.abc import Iterable, Iterator
from typing import Any

import bpy
import numpy as np

# In our note: how long a run took is another number each time.
_SECONDS = re.compile(r'"seconds": [-+.e0-9]+')

# Of an ID itself or of this session, not of its content.
_NOT_CONTENT = {"rna_type", "session_uid", "name_full", "tag", "is_evaluated", "is_updated"}
_NOT_CONTENT |= {"original", "is_updated_data", "bound_box", "execution_time", "users"}

# Type of attribute -> (RNA name of the value, floats or integers of one value, their type).
_ATTRIBUTES = {
    "FLOAT": ("value", 1, np.float32),
    "INT": ("value", 1, np.int32),
    "INT8": ("value", 1, np.int8),
    "BOOLEAN": ("value", 1, np.bool_),
    "FLOAT_VECTOR": ("vector", 3, np.float32),
    "FLOAT2": ("vector", 2, np.float32),
    "FLOAT_COLOR": ("color", 4, np.float32),
    "BYTE_COLOR": ("color", 4, np.float32),
    "QUATERNION": ("value", 4, np.float32),
    "FLOAT4X4": ("value", 16, np.float32),
    "INT32_2D": ("value", 2, np.int32),
    "INT16_2D": ("value", 2, np.int32),
}

# Patterns for `differences`: what is, or follows from, where the vertices are.
POSITIONS = ("*attributes/position/values", "*rna/texspace*", "*rna/dimensions", "*normals/now")
SHAPE_KEY_POINTS = ("*shape_keys/blocks/*/points",)
# What CubicCraft keeps on a mesh beside the positions, and the places of other attributes, which
# shift when one is added.
STORED = (
    "*attributes/cubic_craft_*/values",
    "*attributes/order",
    "*attributes/active index",
    "*custom/custom cubic_craft_note",
)


def differences(
    before: dict[str, Any], after: dict[str, Any], ignore: Iterable[str] = ()
) -> list[str]:
    """Name the paths whose values differ, save those that match a pattern of `ignore`."""
    paths = [p for p in before | after if before.get(p, "absent") != after.get(p, "absent")]
    return [p for p in paths if not any(fnmatch.fnmatch(p, pattern) for pattern in ignore)]


@contextlib.contextmanager
def unchanged(obj: Any, ignore: Iterable[str] = ()) -> Iterator[None]:
    """Check that an object is in the end as it was, save for what `ignore` says."""
    before = snapshot_object(obj)
    yield
    assert differences(before, snapshot_object(obj), ignore) == []


def snapshot_object(obj: Any) -> dict[str, Any]:
    """Take everything of an object and of its mesh, which lies under ``mesh/``."""
    mesh = _prefixed("mesh", snapshot_mesh(obj.data))
    taken = _prefixed("rna", plain_properties(obj))
    taken["selected"] = obj.select_get()
    taken["collections"] = [collection.name for collection in obj.users_collection]
    taken["slots"] = [
        (slot.link, slot.material and slot.material.name) for slot in obj.material_slots
    ]
    taken["groups"] = [(g.name, g.index, g.lock_weight) for g in obj.vertex_groups]
    for kind, items in (("modifiers", obj.modifiers), ("constraints", obj.constraints)):
        taken[kind] = [item.name for item in items]
        for item in items:
            taken |= _prefixed(f"{kind}/{item.name}", plain_properties(item) | _custom(item))
    taken |= _prefixed("animation", _animation(obj)) | _prefixed("custom", _custom(obj))
    return taken | mesh


def snapshot_mesh(mesh: Any) -> dict[str, Any]:
    """Take everything of a mesh."""
    bpy.context.view_layer.update()  # drivers, dimensions and texture space as they will be
    taken = _prefixed("rna", plain_properties(mesh)) | _prefixed("custom", _custom(mesh))
    taken |= _prefixed("animation", _animation(mesh))
    taken |= _prefixed("attributes", _attributes(mesh))
    taken |= _prefixed("topology", _topology(mesh))
    taken |= _prefixed("normals", _normals(mesh))
    taken["materials"] = [material and material.name for material in mesh.materials]
    taken["uv"] = [(u.name, u.active, u.active_render, u.active_clone) for u in mesh.uv_layers]
    taken["weights"] = [[(g.group, g.weight) for g in v.groups] for v in mesh.vertices]
    if mesh.shape_keys is not None:
        taken |= _prefixed("shape_keys", _shape_keys(mesh.shape_keys))
    return taken


def _attributes(mesh: Any) -> dict[str, Any]:
    taken: dict[str, Any] = {
        "order": [(a.name, a.domain, a.data_type, len(a.data)) for a in mesh.attributes],
        "active": mesh.attributes.active and mesh.attributes.active.name,
        "active index": mesh.attributes.active_index,
        "active color": mesh.attributes.active_color_name,
        "default color": mesh.attributes.default_color_name,
        "color indices": (
            mesh.attributes.active_color_index,
            mesh.attributes.render_color_index,
            mesh.color_attributes.active_color_index,
            mesh.color_attributes.render_color_index,
        ),
    }
    for attribute in mesh.attributes:
        if attribute.data_type == "STRING":
            values = [item.value for item in attribute.data]
        else:
            name, size, kind = _ATTRIBUTES[attribute.data_type]
            values = _read(attribute.data, name, size, kind)
        taken[f"{attribute.name}/values"] = values
    return taken


def _topology(mesh: Any) -> dict[str, Any]:
    return {
        "vertices": len(mesh.vertices),
        "edges": _read(mesh.edges, "vertices", 2, np.int32),
        "faces": _read(mesh.polygons, "loop_start", 1, np.int32),
        "sizes": _read(mesh.polygons, "loop_total", 1, np.int32),
        "smooth": _read(mesh.polygons, "use_smooth", 1, np.bool_),
        "material": _read(mesh.polygons, "material_index", 1, np.int32),
        "corner vertices": _read(mesh.loops, "vertex_index", 1, np.int32),
        "corner edges": _read(mesh.loops, "edge_index", 1, np.int32),
        "seams": _read(mesh.edges, "use_seam", 1, np.bool_),
        "sharp": _read(mesh.edges, "use_edge_sharp", 1, np.bool_),
    }


def _normals(mesh: Any) -> dict[str, Any]:
    """Take the custom normals' data by the normals that they make on a shape that never changes.

    Blender stores them relative to the surface, and before 4.5 gives no access to the data.
    """
    fixed: Any = mesh.copy()
    try:
        places = np.random.default_rng(7).normal(size=3 * len(mesh.vertices)).astype(np.float32)
        fixed.vertices.foreach_set("co", places)
        for first in fixed.vertices[:1]:  # makes Blender compute the normals anew
            first.co = first.co
        fixed.update()
        data = _read(fixed.corner_normals, "vector", 3, np.float32)
    finally:
        bpy.data.meshes.remove(fixed)
    return {
        "custom": mesh.has_custom_normals,
        "data": data,
        "now": _read(mesh.corner_normals, "vector", 3, np.float32),
    }


def _shape_keys(keys: Any) -> dict[str, Any]:
    taken = _prefixed("rna", plain_properties(keys)) | _prefixed("animation", _animation(keys))
    taken |= _prefixed("custom", _custom(keys))
    taken["order"] = [key.name for key in keys.key_blocks]
    taken["reference"] = keys.reference_key.name
    for key in keys.key_blocks:
        path = f"blocks/{key.name}"
        taken |= _prefixed(path, plain_properties(key))
        taken[f"{path}/points"] = _read(key.points, "co", 3, np.float32)
        taken[f"{path}/relative to"] = key.relative_key.name
    return taken


def _animation(block: Any) -> dict[str, Any]:
    data = block.animation_data
    if data is None:
        return {}
    taken = {"action": data.action and data.action.name}
    for curve in data.drivers:
        path = f"{curve.data_path}[{curve.array_index}]"
        taken |= _prefixed(path, plain_properties(curve) | plain_properties(curve.driver))
        for variable in curve.driver.variables:
            taken |= _prefixed(f"{path}/{variable.name}", plain_properties(variable))
            for number, target in enumerate(variable.targets):
                taken |= _prefixed(f"{path}/{variable.name}/{number}", plain_properties(target))
    if data.action:
        for curve in action_curves(data):
            taken[f"curve {curve.data_path}[{curve.array_index}]"] = [
                (tuple(point.co), point.interpolation) for point in curve.keyframe_points
            ]
    return taken


def action_curves(data: Any) -> Iterable[Any]:
    """List the curves of an action; from Blender 4.4 on they lie in layers."""
    if hasattr(data.action, "layers"):
        return [
            curve
            for layer in data.action.layers
            for strip in layer.strips
            for bag in strip.channelbags
            for curve in bag.fcurves
        ]
    return data.action.fcurves


def plain_properties(struct: Any) -> dict[str, Any]:
    """Take all simple properties, and the names of the data-blocks that pointers lead to."""
    taken = {}
    for prop in struct.bl_rna.properties:
        if prop.identifier in _NOT_CONTENT or prop.type == "COLLECTION":
            continue
        value = getattr(struct, prop.identifier)
        if prop.type == "POINTER":
            value = repr(value) if isinstance(value, bpy.types.ID) else value is None
        elif getattr(prop, "is_array", False):
            value = np.array(value).tolist()
        taken[prop.identifier] = value
    return taken


def _custom(struct: Any) -> dict[str, Any]:
    if not hasattr(struct, "items"):
        return {}
    try:
        return {f"custom {name}": _plain(value) for name, value in struct.items()}
    except TypeError:  # a kind of struct without custom properties
        return {}


def _plain(value: Any) -> Any:
    if hasattr(value, "to_dict"):
        return value.to_dict()
    if isinstance(value, str):
        return _SECONDS.sub("", value)
    return value.to_list() if hasattr(value, "to_list") else value


def _read(items: Any, name: str, size: int, kind: Any) -> bytes:
    values = np.empty(size * len(items), kind)
    items.foreach_get(name, values)
    return values.tobytes()


def _prefixed(prefix: str, taken: dict[str, Any]) -> dict[str, Any]:
    return {f"{prefix}/{path}": value for path, value in taken.items()}

# SPDX-License-Identifier: GPL-3.0-or-later
"""Sharp edges that follow the shape: smooth shading would make the edges of a crisp one look round.

Only on a mesh that is mostly smooth. Whenever a shape is written, edges that turn by more than
`ANGLE` are marked; *Restore* takes the marks back.
"""

import math
from collections.abc import Mapping
from typing import Any

import bpy
import numpy as np

from .values import read_values

ANGLE = math.radians(30.0)
"""as Blender's *Shade Smooth by Angle*"""
_FOLLOWING = "cubic_craft_sharp_edges"  # a custom property of the mesh
_MARKS = "sharp_edge"
_NORMALS = "custom_normal"
_ASIDE = "cubic_craft_normals"  # in that place, sharp edges would not be seen
_NEAR = math.cos(math.radians(20.0))  # exporters weigh faces in other ways, and files round
_MOST = 0.99  # of the corners that have to be near
_FLAT = 0.5  # of the faces: importers of glTF set those flat whose corners happen to be so
_OF_NODES = ("Smooth by Angle", "Auto Smooth")  # node groups included with Blender


def are_wanted(obj: bpy.types.Object, settings: Mapping[str, Any]) -> bool:
    """Return whether a result on an object is to have sharp edges.

    Not if it is soft, if only a shape key has it, or if a modifier shades or rounds it. `settings`:
    by name.
    """
    if not settings.get("sharp_edges", True) or not settings.get("crispness"):
        return False
    if settings.get("result") == "SHAPE_KEY":
        return False  # edges of the basis are others
    shown = [each for each in obj.modifiers if each.show_viewport]
    return not any(only_shades(each) or rounds(each) for each in shown)


def only_shades(modifier: bpy.types.Modifier) -> bool:
    """Return whether a modifier is one of Blender's node groups that mark sharp edges."""
    if not isinstance(modifier, bpy.types.NodesModifier):
        return False
    group = modifier.node_group
    return group is None or group.name.startswith(_OF_NODES)


def rounds(modifier: bpy.types.Modifier) -> bool:
    """Return whether what is seen of a coarse mesh is much rounder; a bevel leaves sides flat."""
    if not isinstance(modifier, bpy.types.SubsurfModifier):
        return False
    return modifier.levels > 0 and modifier.subdivision_type != "SIMPLE"


def has_following_edges(mesh: bpy.types.Mesh) -> bool:
    """Return whether sharp edges of a mesh follow its shape."""
    return _FOLLOWING in mesh


def let_edges_follow(mesh: bpy.types.Mesh, is_on: bool) -> None:
    """Let the sharp edges of a mesh follow its shape from its next one on, or remove those.

    A mesh that is mostly flat, or has sharp edges of its own, stays as it is.
    """
    if not is_on:
        forget_edges(mesh)
    elif not has_following_edges(mesh) and is_smooth(mesh):
        mesh[_FOLLOWING] = _MARKS in mesh.attributes
        _rename(mesh, _NORMALS, _ASIDE)


def follow_shape(mesh: bpy.types.Mesh) -> None:
    """Mark the sharp edges of the shape as it is, if they follow it."""
    if has_following_edges(mesh):
        are_smooth = read_values(mesh.polygons, "use_smooth", bool)
        mesh.set_sharp_from_angle(angle=ANGLE)
        if not are_smooth.all():  # which Blender has made all faces
            mesh.polygons.foreach_set("use_smooth", are_smooth)


def leave_edges(mesh: bpy.types.Mesh) -> None:
    """Let the marks stay as they are from now on."""
    if has_following_edges(mesh):
        del mesh[_FOLLOWING]
        if kept := mesh.attributes.get(_ASIDE):
            mesh.attributes.remove(kept)


def forget_edges(mesh: bpy.types.Mesh) -> None:
    """Remove the marks that follow the shape."""
    if not has_following_edges(mesh):
        return
    had_attribute = mesh[_FOLLOWING]
    del mesh[_FOLLOWING]
    _rename(mesh, _ASIDE, _NORMALS)
    marks = mesh.attributes.get(_MARKS)
    if marks is None:  # the artist may have removed them
        return
    if had_attribute:
        marks.data.foreach_set("value", np.zeros(len(marks.data), bool))
    else:
        mesh.attributes.remove(marks)


def is_smooth(mesh: bpy.types.Mesh) -> bool:
    """Return whether a mesh is mostly smooth, without sharp edges other than those of ours."""
    if _share(mesh, "sharp_face") > _FLAT:
        return False
    if _share(mesh, _MARKS) and not has_following_edges(mesh):
        return False
    return not mesh.has_custom_normals or _are_those_of_blender(mesh)


def _are_those_of_blender(mesh):
    """Return whether custom normals are nearly what Blender would have without them.

    They are in most files: importers set them whatever they are. At open borders, where files for
    engines cut a mesh along the seams of its UVs, they may be what they like.
    """
    normals = mesh.attributes.get(_NORMALS)
    if normals is not None and normals.data_type == "FLOAT_VECTOR":
        return False  # in object space, where the original is kept in another way
    vertex, edge = (
        read_values(mesh.loops, f"{kind}_index", np.int32) for kind in ("vertex", "edge")
    )
    ends = read_values(mesh.edges, "vertices", np.int32, 2)
    is_inside = np.ones(len(mesh.vertices), bool)
    is_inside[ends[np.bincount(edge, minlength=len(ends)) != 2]] = False
    if normals is None:  # before Blender 5, those of vertices are without them
        plain = read_values(mesh.vertex_normals, "vector", width=3)[vertex]
    else:
        copy = mesh.copy()
        copy.attributes.remove(copy.attributes[_NORMALS])
        plain = read_values(copy.corner_normals, "vector", width=3)
        bpy.data.meshes.remove(copy)
    shown = read_values(mesh.corner_normals, "vector", width=3)
    is_near = np.einsum("ij,ij->i", shown, plain)[is_inside[vertex]] > _NEAR
    return bool(is_near.size and is_near.mean() > _MOST)


def _rename(mesh, name, to):
    if found := mesh.attributes.get(name):
        found.name = to


def _share(mesh: bpy.types.Mesh, name: str) -> float:
    """Return how many of the flags of that name are set, from 0 to 1."""
    flags = mesh.attributes.get(name)
    if not isinstance(flags, bpy.types.BoolAttribute) or not len(flags.data):
        return 0.0
    return float(read_values(flags.data, "value", bool).mean())

# SPDX-License-Identifier: GPL-3.0-or-later
"""Sharp edges that follow the shape: smooth shading would make the edges of a crisp one look round.

Only if the artist asks for it, and of a mesh that has no sharp edges of its own. Whenever a shape
is written, edges that turn by more than `ANGLE` are marked; *Restore* takes the marks back.
"""

import math

import bpy

ANGLE = math.radians(30.0)
"""as Blender's *Shade Smooth by Angle*"""
_FOLLOWING = "cubic_craft_sharp_edges"  # a custom property of the mesh
_MARKS = "sharp_edge"


def has_following_edges(mesh: bpy.types.Mesh) -> bool:
    """Return whether sharp edges of a mesh follow its shape."""
    return _FOLLOWING in mesh


def may_have_following_edges(mesh: bpy.types.Mesh) -> bool:
    """Return whether a mesh is smooth all over, and sharp edges, if any, are ours."""
    if mesh.has_custom_normals or "sharp_face" in mesh.attributes:
        return False
    return _MARKS not in mesh.attributes or has_following_edges(mesh)


def let_edges_follow(mesh: bpy.types.Mesh) -> None:
    """Mark the sharp edges of a mesh, now and whenever its shape is written."""
    mesh[_FOLLOWING] = True
    follow_shape(mesh)


def follow_shape(mesh: bpy.types.Mesh) -> None:
    """Mark the sharp edges of the shape as it is, if they follow it."""
    if has_following_edges(mesh):
        mesh.set_sharp_from_angle(angle=ANGLE)


def leave_edges(mesh: bpy.types.Mesh) -> None:
    """Let the marks stay as they are from now on."""
    if has_following_edges(mesh):
        del mesh[_FOLLOWING]


def forget_edges(mesh: bpy.types.Mesh) -> None:
    """Remove the marks that follow the shape."""
    if has_following_edges(mesh):
        leave_edges(mesh)
        if marks := mesh.attributes.get(_MARKS):  # the artist may have removed them
            mesh.attributes.remove(marks)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The handles as Blender properties: in the list of an object, and as an option of Cubify."""

from typing import Any

import bpy
import numpy as np
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from . import pose
from .handle import THRESHOLD

_MODES = (
    ("PINNED", "Pinned", "The vertices stay exactly in place", "PINNED", 0),
    ("FOLLOW", "Follow", "The vertices follow an object", "EMPTY_AXIS", 1),
)
_IDENTITY = tuple(tuple(row) for row in np.eye(4).tolist())
_MATRIX: Any = {"size": (4, 4), "subtype": "MATRIX", "default": _IDENTITY}


def _bind_target(handle, _context):
    """Make the current transform of the target the one in which nothing moves."""
    if handle.target is not None:
        handle.mode = "FOLLOW"
        pose.bind(handle.id_data, handle)


class _MemberProperties:
    """Mixin of the properties that an object's and an operator's handles share."""

    threshold: FloatProperty(
        name="Threshold",
        description="Minimum weight in the vertex group that makes a vertex part of the handle",
        default=THRESHOLD,
        min=0.0,
        max=1.0,
    )


class CubicCraftHandle(_MemberProperties, bpy.types.PropertyGroup):
    """A handle of an object: a vertex group that is held or follows another object."""

    group: StringProperty(name="Vertex Group", description="Vertex group to hold")
    mode: EnumProperty(
        name="Mode",
        description="Whether the vertices stay in place or follow an object",
        items=_MODES,
        default="PINNED",
    )
    is_cubic: BoolProperty(
        name="Becomes Cubic",
        description="Hold or move only the position and rotation of the part as a whole, while its"
        " surface becomes cubic. When off, its vertices are held exactly",
    )
    target: PointerProperty(
        name="Target",
        description="Object that the vertices follow when you move, rotate or scale it, starting"
        " from its transform when you pick it",
        type=bpy.types.Object,
        poll=lambda handle, obj: obj != handle.id_data,
        update=_bind_target,
    )
    rest: FloatVectorProperty(
        name="Rest",
        description="Matrix of the target, relative to the object, at which the vertices do not"
        " move",
        **_MATRIX,
    )
    pose: FloatVectorProperty(
        name="Pose",
        description="Matrix in object space that moves the vertices, before the target moves them"
        " further (a mathutils.Matrix)",
        **_MATRIX,
    )
    baked: FloatVectorProperty(
        name="Baked",
        description="Matrix of the target, relative to the object, when the mesh was written",
        **_MATRIX,
    )
    baked_pose: FloatVectorProperty(
        name="Baked Pose", description="The pose when the mesh was written", **_MATRIX
    )
    is_baked: BoolProperty(
        name="Is Baked", description="The mesh has been written with this handle's pose"
    )
    is_foreign: BoolProperty(
        name="Foreign Target", description="The target belonged to another mesh when it was picked"
    )
    uid: IntProperty(
        name="Number",
        description="Unique number of the handle on its object, or 0 if not assigned yet",
    )


class CubicCraftGivenHandle(_MemberProperties, bpy.types.PropertyGroup):
    """A handle that is given to Cubify by a script; its name is that of the vertex group.

    Blender requires all three in each dictionary: "name", "threshold" and "matrix".
    """

    matrix: FloatVectorProperty(
        name="Matrix",
        description="Affine map of the original positions, in object space (a mathutils.Matrix)",
        **_MATRIX,
    )


register, unregister = bpy.utils.register_classes_factory((CubicCraftHandle, CubicCraftGivenHandle))

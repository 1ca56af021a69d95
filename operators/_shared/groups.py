# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that add a vertex group to a list of an object: to the handles, or to the regions."""

from collections.abc import Collection
from typing import Any

import bpy
import numpy as np
from bpy.props import StringProperty

from ...cubic_craft_addon import live, mesh_bridge
from ...cubic_craft_addon.handles.owner import panel_object
from ...solver import CubicCraftError
from .selection import poll_mesh, refuse, report_all
from .unexpected_errors import reporting


class AddsGroup:
    """Mix in before `bpy.types.Operator`; it adds a group that is there."""

    bl_options = {"REGISTER", "UNDO"}
    other: str
    """the button to use where there is none"""
    already: str
    """what is true of a group in the list, for the message"""

    group: StringProperty(
        name="Vertex Group",
        description="Vertex group to add; empty for the active one",
        options={"SKIP_SAVE"},
    )

    def taken(self, obj: Any) -> Collection[str]:
        """Return the names of the groups in the list."""
        raise NotImplementedError

    def add(self, obj: Any) -> str:
        """Add `group` to the list; return what has become of it."""
        raise NotImplementedError

    @classmethod
    def poll(cls, context):
        if not poll_mesh(cls, context, ("OBJECT", "PAINT_WEIGHT")):
            return False
        if not panel_object(context).vertex_groups:
            return refuse(cls, f"The mesh has no vertex group; add one, or use {cls.other}")
        return True

    @reporting
    def execute(self, context):
        obj = panel_object(context)
        taken = self.taken(obj)
        if not self.group:
            candidates = [obj.vertex_groups.active.name, *obj.vertex_groups.keys()]
            own = live.own_properties(obj)  # painted maps are active, and cover all
            others = {*taken, own.map_group, own.detail_group}
            self.group = next((name for name in candidates if name not in others), "")
            if not self.group:
                raise CubicCraftError(f"Every vertex group already {self.already}, or is a map")
        mesh_bridge.vertex_group(obj, self.group)
        if self.group in taken:
            raise CubicCraftError(f'"{self.group}" already {self.already}')
        return report_all(self, self.add(obj), [])


class AddsSelection:
    """Mix in before `bpy.types.Operator`; it makes a group of what is selected in Edit Mode.

    This leaves Edit Mode, because the undo steps of Edit Mode hold only the mesh: what refers to
    the group would remain without it. A single undo then reverts everything, back into Edit Mode.
    """

    bl_options = {"REGISTER", "UNDO"}
    new: str
    """name of the group"""

    def add(self, obj: Any, group: str, count: int, values: Any) -> str:
        """Add a group of some vertices to the list, with `values`; return what has become of it."""
        raise NotImplementedError

    def values(self, obj: Any) -> Any:
        """Return what is to be read before anything is changed."""

    @classmethod
    def poll(cls, context):
        return poll_mesh(cls, context, ("EDIT_MESH",))

    @reporting
    def execute(self, context):
        obj: Any = panel_object(context)
        values = self.values(obj)
        obj.update_from_editmode()
        is_selected = mesh_bridge.read_values(obj.data.vertices, "select", bool)
        if not is_selected.any():
            raise CubicCraftError("No vertex is selected; select some in Edit Mode first")
        if is_selected.all():
            raise CubicCraftError("All vertices are selected; select fewer in Edit Mode first")
        if obj.mode == "EDIT":
            bpy.ops.object.mode_set(mode="OBJECT")
        group = obj.vertex_groups.new(name=self.new)
        group.add(np.flatnonzero(is_selected).tolist(), 1.0, "REPLACE")
        return report_all(self, self.add(obj, group.name, int(is_selected.sum()), values), [])

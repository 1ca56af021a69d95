# SPDX-License-Identifier: GPL-3.0-or-later
"""Sharp edges of a result that has been written."""

from collections.abc import Mapping
from typing import Any

import bpy

from ..access.checks import is_linked, mesh_of
from ..access.note import last_run
from ..access.sharp_edges import are_wanted, follow_shape, let_edges_follow
from ..memory.cubic_key import find_cubic_key


def shade_edges(obj: bpy.types.Object, is_on: bool) -> None:
    """Show the straight edges of a crisp result on an object as what they are, or no longer.

    Nothing changes without a result, in Edit Mode, and on a mesh that is mostly flat.
    """
    run, mesh = last_run(obj), obj.data
    if run is None or not isinstance(mesh, bpy.types.Mesh) or mesh.is_editmode or is_linked(mesh):
        return
    is_on &= find_cubic_key(mesh) is None
    shade_shape(obj, {**run.settings, "sharp_edges": is_on})


def shade_shape(obj: bpy.types.Object, settings: Mapping[str, Any]) -> None:
    """Shade the shape of an object in Object Mode as these settings, by name, have it."""
    mesh = mesh_of(obj)
    let_edges_follow(mesh, are_wanted(obj, settings))
    follow_shape(mesh)

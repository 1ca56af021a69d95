# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of one run as plain values, wherever they come from.

Those of the method are declared in `solver/method.py`, those that only Blender has here.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from dataclasses import dataclass, replace
from typing import Any

import bpy

from ... import solver
from ...solver.method import Method
from ...solver.setting import declared, setting
from ..form.settings import FormSettings
from ..handles import Handle
from ..mesh_bridge import Start
from ..regions.region import Region


@dataclass(frozen=True, kw_only=True)
class Parts:
    """Whether what an object lists is used; a run has the lists instead."""

    use_handles: bool = setting(True, is_of_mesh=True)(
        "Handles", "Hold and pose the vertices of the object's handles"
    )
    use_regions: bool = setting(True, is_of_mesh=True)(
        "Regions", "Use the object's regions: vertex groups with a form of their own"
    )


@dataclass(frozen=True, kw_only=True)
class Output:
    """What it starts from in Blender, and where the shape is written."""

    result: str = setting("MESH", in_animation="MESH")(
        "Write To",
        "Where to write the cubic shape",
        choices={
            "MESH": "Mesh: Move the vertices of the mesh; Restore brings back the original",
            "SHAPE_KEY": 'Shape Key: Write a shape key "Cubic" that can be adjusted and animated',
            "NEW_OBJECT": "New Object: Make a cubic copy and leave the object unchanged",
        },
    )
    with_modifiers: bool = setting(False, in_animation=False, keeps_result=True)(
        "With Modifiers",
        "Apply the modifiers to the new object, including the pose of an Armature. When off, the"
        " mesh without its modifiers becomes cubic",
    )
    sharp_edges: bool = setting(True, in_animation=False, keeps_result=True)(
        "Sharp Edges",
        "Mark edges of crisp shapes that turn by more than 30 degrees as sharp, as smooth shading"
        " makes them look round. Only on meshes that are mostly smooth; Restore takes it back",
    )
    # Who sculpts on a result and then moves a slider wants to keep both.
    start: Start = setting(  # noqa: RUF009
        "EDITS", numbers=(2, 0, 1), in_animation="HERE", keeps_result=True
    )(
        "Start",
        "What Cubify and Live start from if the mesh was edited by hand since it was cubified",
        choices={
            "EDITS": "Original and Edits: Start from the original, and put what you moved by hand"
            " back onto the result",
            "HERE": "From Here: Start from the mesh as it is now, which replaces the original;"
            " Restore First brings the first one back until Apply",
            "ORIGINAL": "From the Original: Start from the original; edits by hand are lost",
        },
    )


@dataclass(frozen=True, kw_only=True)
class Settings(Output, FormSettings):
    """The settings of one object. The defaults are those of the panel."""

    frame: bpy.types.Object | None = None
    """the object that the orientation is relative to, in the space FRAME"""
    handles: tuple[Handle, ...] = ()
    """where they overlap, the first takes precedence"""
    regions: tuple[Region, ...] = ()
    """vertex groups with settings of their own"""

    @property
    def proxy(self) -> solver.ProxyOptions:
        """The options of the proxy that is solved instead of the mesh."""
        from ...solver.proxy.options import proxy_of  # late: it needs SciPy

        return proxy_of(self)

    def of_region(self, region: Region) -> Settings:
        """Return the settings of a region of the object."""
        return replace(self, **region.own)


SETTINGS = declared(Method, Parts, Output)
"""all that the panel and the operator have, by their names"""
IN_ANIMATION: dict[str, Any] = {
    name: each.in_animation for name, each in SETTINGS.items() if each.in_animation is not None
}
"""values in all frames of an animation"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of one run as plain values, wherever they come from."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from dataclasses import dataclass, replace

import bpy

from ... import solver
from ..form.settings import FormSettings
from ..handles import Handle
from ..mesh_bridge import Start
from ..regions.region import Region


@dataclass(frozen=True, kw_only=True)
class Settings(FormSettings):
    """The settings of one object. The defaults are those of the panel."""

    space: str = "WORLD"
    """what the angles of the orientation are relative to: OBJECT, WORLD or FRAME"""
    frame: bpy.types.Object | None = None
    """the object that is the FRAME"""
    handles: tuple[Handle, ...] = ()
    """where they overlap, the first takes precedence"""
    regions: tuple[Region, ...] = ()
    """vertex groups with settings of their own"""
    map_group: str = ""
    """name of the vertex group that scales the cubeness, or empty"""
    map_invert: bool = False
    start: Start = "EDITS"
    """what a mesh starts from if it was edited by hand since its last result, see `Start`"""
    result: str = "MESH"
    """MESH, SHAPE_KEY or NEW_OBJECT"""
    with_modifiers: bool = False
    """whether the NEW_OBJECT is made with the modifiers applied"""
    crispness: float = 0.9
    """how far sides are made flat and edges straight, from 0 to 1"""
    solidity: float = 0.3
    """how firmly limbs, walls and volume keep their thickness; 0 is a hollow surface"""
    keep_pose: bool = True
    """whether limbs become boxes along themselves"""
    detail: float = 0.05
    """size of the features that ride along instead of being flattened, as a share of the largest
    extent; 0 flattens all"""
    detail_strength: float = 1.0
    """how high these features stand out, relative to the original"""
    detail_group: str = ""
    """name of the vertex group that scales their strength, or empty"""
    keep_apart: bool = True
    """whether surfaces that do not cross are kept from crossing"""
    together: str = "SELECTION"
    """what follows its neighbours: OFF nothing, PARTS those of a mesh, SELECTION those of all"""
    refine: str = "AUTO"
    """AUTO solves coarse meshes on a finer copy, OFF as they are"""
    rotation: str = "KEEP"
    """KEEP holds each free part in its orientation, FREE lets it turn as a whole"""
    symmetry: tuple[bool, bool, bool] = (False, False, False)
    """axes of the object about which halves stay mirror images"""
    keep_symmetric: bool = True
    """whether it stays symmetric about axes about which it is"""
    hold_rest: bool = True
    """whether regions far from moved handles stay in place"""
    floor: str = "AUTO"
    """whether parts that stand on the ground keep their height"""
    device: str = "AUTO"
    """AUTO, CPU, GPU or NUMPY"""
    max_iterations: int = 1000
    tolerance: float = 1e-3

    @property
    def proxy(self) -> solver.ProxyOptions:
        """The options of the proxy that is solved instead of the mesh."""
        return solver.ProxyOptions(
            solidity=self.solidity,
            together=self.together != "OFF",
            refine=self.refine == "AUTO",
            keep_pose=self.keep_pose,
            detail=self.detail,
            keep_apart=self.keep_apart,
        )

    def of_region(self, region: Region) -> Settings:
        """Return the settings of a region of the object."""
        return replace(self, **region.own)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions: vertex groups with a form, an orientation and a cubeness of their own."""

from dataclasses import dataclass, fields

import bpy

from ...solver.errors import CubicCraftError
from ...solver.method import Method
from ...solver.styles.form_names import OF_OBJECT
from ..form.settings import check_form_object
from ..mesh_bridge import vertex_group
from ..object_properties import object_properties


@dataclass(frozen=True, kw_only=True)
class Region:
    """A part of a mesh that has settings of its own; those not named here are the object's."""

    group: str
    """name of the vertex group; where its weights are less than 1, the region blends into others"""
    cubeness: float = Method.cubeness
    form: str = Method.form
    form_sides: int = Method.form_sides
    form_weights: tuple[float, float, float] = Method.form_weights
    form_object: bpy.types.Object | None = None
    orientation: tuple[float, float, float] = Method.orientation

    @property
    def own(self):
        """The settings that it has instead of the object's."""
        return {name: getattr(self, name) for name in OWN}


OWN = tuple(field.name for field in fields(Region) if field.name != "group")
"""names of the settings that a region has of its own"""


def object_regions(obj: bpy.types.Object) -> tuple[Region, ...]:
    """Return the regions of the object, even while they are disabled.

    Raises CubicCraftError: a vertex group or the object of a form is missing; the message names the
    remedy.
    """
    items = object_properties(obj).regions
    return tuple(_region(obj, number, item) for number, item in enumerate(items, start=1))


def _region(obj, number, item):
    if not item.group:
        raise CubicCraftError(
            f'region {number} of "{obj.name}" has no vertex group; pick one or remove the region'
        )
    vertex_group(obj, item.group)
    check_form_object(item.form, item.form_object, f'the form of the region "{item.group}"')
    return Region(
        group=item.group,
        cubeness=item.cubeness,
        form=item.form or Method.form,  # of a newer version
        form_sides=item.form_sides,
        form_weights=tuple(item.form_weights),
        form_object=item.form_object if item.form in OF_OBJECT else None,
        orientation=tuple(item.orientation),
    )

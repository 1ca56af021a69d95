# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions: vertex groups with a form, an orientation and a cubeness of their own."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields

import bpy
import numpy as np
from bpy.props import StringProperty

from ...solver.errors import CubicCraftError
from ...solver.method import Method
from ...solver.styles.form_names import OF_OBJECT
from .. import mesh_bridge
from ..form.settings import FormSettings, check_form_object, form_property
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


def region_shares(obj: bpy.types.Object, regions: Sequence[Region]) -> np.ndarray | None:
    """Return the shares (n,1+k) of the object's own settings and of each of its k regions.

    They add up to 1: what the weights of the regions leave is the object's, and where they are more
    than 1 together, they are scaled. None for an object without regions.

    Raises CubicCraftError: a vertex group does not exist.
    """
    groups = [region.group for region in regions]
    return shares_of(regions, mesh_bridge.weights_of_groups(obj, groups))


def shares_of(regions: Sequence[Region], known: Mapping[str, np.ndarray]) -> np.ndarray | None:
    """Return the same where the weights (n,) of the groups are known by their names."""
    if not regions:
        return None
    weights = np.stack([known[region.group] for region in regions], axis=1)
    total = weights.sum(axis=1, keepdims=True)
    rest = np.maximum(1.0 - total, 0.0)
    return np.concatenate([rest, weights / np.maximum(total, 1.0)], axis=1)


def add_region(obj: bpy.types.Object, group: str, settings: FormSettings) -> None:
    """Add a region with these settings to the end of the object's list, and make it active."""
    properties = object_properties(obj)
    region = properties.regions.add()
    region.group = group
    for name in OWN:
        setattr(region, name, getattr(settings, name))
    properties.active_region = len(properties.regions) - 1


class CubicCraftRegion(bpy.types.PropertyGroup):
    """A region of an object: a vertex group with a form and a cubeness of its own."""

    __annotations__ = {
        "group": StringProperty(
            name="Vertex Group",
            description="Vertex group that the region covers. Where its weights are less than 1,"
            " the region blends into what is around it",
        )
    } | {name: form_property(name) for name in OWN}


register, unregister = bpy.utils.register_classes_factory((CubicCraftRegion,))

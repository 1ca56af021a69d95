# SPDX-License-Identifier: GPL-3.0-or-later
"""The curves that animate something; Blender 5 has them in layers of an action."""

from collections.abc import Iterator
from typing import Any

import bpy


def curves_of(action: Any, slot: Any = None) -> list[Any]:
    """Return the curves of an action, of one slot of it if that is given."""
    curves = getattr(action, "fcurves", None)
    if curves is not None:
        return list(curves)
    strips = (strip for layer in action.layers for strip in layer.strips)
    bags = (bag for strip in strips for bag in strip.channelbags)
    return [curve for bag in bags if slot is None or bag.slot == slot for curve in bag.fcurves]


def animated_paths(block: bpy.types.ID) -> Iterator[str]:
    """Yield the paths of the properties that keyframes or drivers of a data-block set."""
    data: Any = getattr(block, "animation_data", None)
    if data is None:
        return
    strips = (strip for track in data.nla_tracks for strip in track.strips)
    for holder in (data, *strips):
        if holder.action is not None:
            for curve in curves_of(holder.action, getattr(holder, "action_slot", None)):
                yield curve.data_path
    for driver in data.drivers:
        yield driver.data_path

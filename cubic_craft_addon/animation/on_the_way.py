# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings on the way from others."""

from dataclasses import replace

from mathutils import Euler

from ...solver.method import SETTINGS
from ..settings.values import Settings

_STRENGTHS = [name for name, each in SETTINGS.items() if each.is_strength]


def on_the_way(start: Settings | None, end: Settings, share: float) -> Settings:
    """Return settings between two, which are those of the end at a share of 1.

    `start`: Settings or None, none is the original. `end`: whatever is not a strength or an angle
    is always as in these. `share`: from 0 to 1.
    """
    if share >= 1.0:
        return end

    def mixed(before, after):
        return (1.0 - share) * before + share * after

    before = {region.group: region.cubeness for region in start.regions} if start else {}
    base = start.cubeness if start else 0.0
    strengths = {name: getattr(start, name) if start else 0.0 for name in _STRENGTHS}
    if start is not None and start.capture_object is None:
        strengths["capture_strength"] = 0.0
    regions = tuple(
        replace(region, cubeness=mixed(before.get(region.group, base), region.cubeness))
        for region in end.regions
    )
    turned = end.orientation
    if start is not None and start.space == end.space:
        way = Euler(start.orientation).to_quaternion()
        found = way.slerp(Euler(end.orientation).to_quaternion(), share).to_euler()
        turned = (found.x, found.y, found.z)
    return replace(
        end,
        regions=regions,
        orientation=turned,
        **{name: mixed(value, getattr(end, name)) for name, value in strengths.items()},
    )

# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep on Floor: what stands on the ground before Cubify also does so afterwards, on all feet.

The feet of a figure, or the legs of a table, rise by different heights as it becomes cubic. Each
gets its height back, and the heights between follow the surface as smoothly as can be: they
minimize the Dirichlet energy, with the Laplacian of the global step.
"""

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..aliases import BoolArray, FloatArray, IntArray
from ..mesh.components import components

if TYPE_CHECKING:  # SciPy is loaded when it is needed, not for its names
    from ..iteration.setup import Setup

_STANDING = 0.01
"""share of the total height that a standing part may begin above the lowest point"""
_FOOT = 0.03
"""the same for a foot, or the seat of what sits: less is not seen as a gap below it"""
_ZONE = 0.05
"""the same for what may come to be the lowest of a foot"""
_BASE = 0.25
"""of the extent of a component along a horizontal axis: what all its feet span if it stands"""
_WIDE = 0.5
"""of the same: what is wider is no foot, but may have some, as the roots of a tree are"""
_EVEN = 0.002
"""of the height: feet that rise as evenly are moved as one"""
_FIRM = 1e3
"""how firmly feet are put on the ground, relative to the diagonal of L"""
_LEAST = 1e-9
"""the same of all others, so that what has no foot has a solution, too"""
_CYCLES = 12
"""of multigrid, in place of the solution"""


class Floor:
    """The feet of what stands on the ground, below along the unit vector `up` (3,)."""

    def __init__(self, setup: "Setup", up: FloatArray):
        self._setup, self._up = setup, up
        rest = setup.rest
        self._used, self._place = rest.place
        self._component = rest.topology.component[self._place]
        self._before = rest.input_positions[self._used] @ up
        lowest = self._lowest_of_components(self._before)
        is_part = self._lowest_of_components(rest.is_sheet[self._place]) == 0.0  # and no ground
        self._height = float(np.ptp(self._before[is_part[self._component]]))
        self._ground = lowest[is_part].min()
        is_low = lowest <= self._ground + _STANDING * self._height
        self._is_moved = is_low & is_part & ~setup.global_step.is_anchored

    def kept(self, positions: FloatArray, *, only_standing: bool = False) -> FloatArray:
        """Return positions (N,3) of a run, with each foot moved back to its height.

        Components that begin higher than the others do not move, and neither do those with held
        vertices.

        `positions`: (N,3), where the run has taken the vertices of the input. `only_standing`:
        leave alone what has no feet or base, such as a ball, but touches the ground.
        """
        is_moved = self._is_moved
        if only_standing and is_moved.any():
            is_moved = is_moved & self._is_standing
        if not is_moved.any():
            return positions
        rises = self._rises(positions[self._used] @ self._up) * is_moved[self._component]
        if not rises.any():
            return positions
        kept = positions.copy()
        kept[self._used] -= rises[:, None] * self._up
        return kept

    @cached_property
    def _is_standing(self) -> BoolArray:
        """(c,) bool, the components with several feet, or whose base is wide."""
        is_low = self._is_near(_STANDING)
        feet = np.unique(np.stack([self._component, self._zone])[:, is_low], axis=1)[0]
        base = np.where(is_low, self._component, -1)
        is_wide = self._is_wide(base, len(self._is_moved), _BASE)
        return (np.bincount(feet, minlength=len(is_wide)) > 1) | is_wide

    @cached_property
    def _zone(self) -> IntArray:
        """(k,) the foot that each vertex is of, or near, or -1."""
        zone, low = self._pieces(_ZONE), self._pieces(_STANDING)
        count = zone.max() + 1
        pairs = np.unique(np.stack([zone, low])[:, low >= 0], axis=1)
        has_feet = np.bincount(pairs[0], minlength=count) > 1
        has_feet &= self._is_wide(zone, count, _WIDE)
        is_foot = np.zeros(count, dtype=bool)
        is_foot[zone[self._is_near(_FOOT)]] = True
        zone = np.where((zone >= 0) & is_foot[zone], zone, -1)
        zone = np.where((zone >= 0) & has_feet[zone], np.where(low >= 0, count + low, -1), zone)
        return np.unique(zone, return_inverse=True)[1].ravel() - (zone < 0).any()

    def _pieces(self, share):
        """Return the number (k,) of the connected piece near the ground, or -1."""
        rest, is_near = self._setup.rest, self._is_near(share)
        is_solved = np.zeros(len(rest.V), dtype=bool)
        is_solved[self._place[is_near]] = True
        F = rest.shown
        edges = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
        edges = edges[is_solved[edges].all(axis=1)]
        _, piece = components(edges, len(rest.V))
        _, piece = np.unique(piece[self._place], return_inverse=True)
        return np.where(is_near, piece.ravel(), -1)

    def _is_wide(self, group, count, least):
        """Return which groups (k,) int have so much of the width of their components."""
        points, found = self._setup.rest.input_positions[self._used], np.zeros(count, dtype=bool)
        rows = np.flatnonzero(group >= 0)
        group, component = group[rows], self._component[rows]
        for axis in _across(self._up):
            along = points @ axis
            whole = -self._lowest_of_components(-along) - self._lowest_of_components(along)
            most = np.full(count, np.inf)
            most[group] = whole[component]
            found |= -_lowest(-along[rows], group, count) - _lowest(along[rows], group, count) >= (
                least * most
            )
        return found

    def _is_near(self, share):
        """Return which vertices (k,) are within a share of the height above the ground."""
        return self._is_moved[self._component] & (
            self._before <= self._ground + share * self._height
        )

    def _rises(self, after):
        at = np.flatnonzero(self._zone >= 0)
        zone, feet = self._zone[at], self._zone.max() + 1
        rise = _lowest(after[at], zone, feet) - _lowest(self._before[at], zone, feet)
        if len(at) and np.ptp(rise[zone]) > _EVEN * self._height:
            return self._spread(at, rise[zone])
        whole = self._lowest_of_components(after) - self._lowest_of_components(self._before)
        return whole[self._component]

    def _spread(self, at, rise):
        """Return the rises (k,) that are as smooth as can be, with those at some vertices given."""
        values = np.zeros((len(self._setup.rest.V), 3))
        values[self._place[at], 0] = rise
        step, firm = self._step
        right, found = firm[:, None] * values, values.copy()
        for _ in range(1 if step.is_factorized else _CYCLES):
            found = step.solve(right, found)
        return found[self._place, 0]

    @cached_property
    def _step(self):
        from ..global_step.step import GlobalStep

        rest = self._setup.rest
        diagonal = rest.matrices.matrix(rest.matrices.laplacian).diagonal()
        firm = np.full(len(rest.V), _LEAST * np.abs(diagonal).mean() + _LEAST)
        on_feet = self._place[self._zone >= 0]
        firm[on_feet] += _FIRM * np.abs(diagonal[on_feet])
        return GlobalStep(rest, np.empty(0, np.intp), firm), firm

    def _lowest_of_components(self, values):
        return _lowest(values, self._component, self._setup.rest.topology.component_count)


def _lowest(values, group, count):
    lowest = np.full(count, np.inf)
    np.minimum.at(lowest, group, values)
    return lowest


def _across(up):
    """Return two unit vectors at right angles to one."""
    first = np.cross(up, np.eye(3)[np.abs(up).argmin()])
    first /= np.linalg.norm(first)
    return first, np.cross(up, first)

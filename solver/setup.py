# SPDX-License-Identifier: GPL-3.0-or-later
"""What is done once per mesh and set of pins."""

from copy import copy
from functools import cached_property

import numpy as np

from .errors import CubicCraftError
from .global_step import GlobalStep
from .holds import HoldFields
from .symmetry import MATCHING, NO_PARTNER, Mirror, commuting, partners

NARROW = 0.01
"""Longest side of the triangles, in the unit box, of a ring that is left free beside what is still:
it moves by less than that is long."""


class Setup:
    """The rest mesh, its pinned vertices and the factorisation that belongs to both.

    Parameters
    ----------
    rest : RestMesh
    pinned : (k,) array_like of int, optional
        Vertices of the input that are held exactly.
    still : (N,) array_like of bool, optional
        Vertices of the input that are asked to stay where they are. They are held, but for one ring
        next to what moves if that is narrow: so the surface bends there without a crease.
    mirrors : sequence of Mirror, optional
        Of the input, in its unit: halves that stay mirror images of each other. What is held is
        left out.

    Raises
    ------
    CubicCraftError
        An index that is no integer or out of range, or no vertex left free.

    Attributes
    ----------
    pinned_input : (k,) int array
        The pinned vertices, loose ones included.
    pinned : (j,) int array
        Those that are not loose, as indices into ``rest.V``.
    has_pin : (component_count,) bool array
        Components with a pinned vertex.
    mirrors : tuple of Mirror
        Of the solved vertices, in the unit box.
    hold_fields : HoldFields or None
    """

    def __init__(self, rest, pinned=(), still=None, mirrors=()):
        pinned = np.asarray(pinned)
        if pinned.size and not np.issubdtype(pinned.dtype, np.integer):
            raise CubicCraftError(f"pinned must list vertices by number, not be {pinned.dtype}")
        pinned = np.unique(pinned.astype(np.int64))
        count = len(rest.input_positions)
        if len(pinned) and (pinned[0] < 0 or pinned[-1] >= count):
            raise CubicCraftError(f"pinned vertices must lie between 0 and {count - 1}")
        self.rest = rest
        self.pinned_input = pinned
        is_pinned = np.zeros(count, dtype=bool)
        is_pinned[pinned] = True
        if is_pinned[rest.place[0]].all():
            raise CubicCraftError("all vertices are pinned; leave some of them free")
        if still is not None:
            self.pinned_input = np.union1d(pinned, _held_by(rest, np.asarray(still)))
            is_pinned[self.pinned_input] = True
        self.pinned = np.flatnonzero(rest.input_map.spread_mask(is_pinned))
        self.has_pin = np.zeros(rest.topology.component_count, dtype=bool)
        self.has_pin[rest.topology.component[self.pinned]] = True
        self.mirrors = self._solved(mirrors)
        self.global_step = GlobalStep(rest, self.pinned)
        self.hold_fields: HoldFields | None = None

    @property
    def is_anchored(self):
        """(component_count,) bool array, components with a pinned vertex or a group that is held.

        The others float, and stay where they are as a whole.
        """
        return self.global_step.is_anchored

    def with_holds(self, weights) -> "Setup":
        """Return the same with groups of vertices that keep their place, see `holds.py`.

        Nothing is factorised anew. What a group asks for, a Stylization is told.

        Parameters
        ----------
        weights : sequence of (N,) arrays
            Of the vertices of the input.
        """
        other = copy(self)
        other.__dict__.pop("coarse", None)
        other.hold_fields = HoldFields(self, weights)
        other.global_step = self.global_step.anchored(other.hold_fields.components)
        return other

    def _solved(self, mirrors):
        """Return mirrors of the input as those of the solved vertices."""
        is_pinned = np.zeros(len(self.rest.V), dtype=bool)
        is_pinned[self.pinned] = True
        found = [_solved(self.rest, mirror).without(is_pinned) for mirror in mirrors]
        return commuting(found)

    @cached_property
    def coarse(self):
        """The Setup of the coarser mesh, with the pins merged, or None where there is none."""
        coarsening = self.rest.coarse
        if coarsening is None:
            return None
        pinned = np.unique(coarsening.cluster[self.pinned])
        if len(pinned) == len(coarsening.rest.V):
            return None
        setup = Setup(coarsening.rest, pinned)
        if self.hold_fields is None:
            return setup
        count = np.bincount(coarsening.cluster)
        return setup.with_holds(
            [
                np.bincount(coarsening.cluster, self.rest.input_map.spread(weights)) / count
                for weights in self.hold_fields.weights
            ]
        )


def _held_by(rest, still):
    """Return the vertices of the input that are still (N,), less those in a narrow ring."""
    is_still = rest.input_map.spread_mask(still)
    F = rest.F
    sides = np.linalg.norm(rest.V[F] - rest.V[np.roll(F, 1, axis=1)], axis=2)
    is_left = ~is_still[F].all(axis=1) & (sides.max(axis=1) < NARROW)
    is_still[F[is_left].ravel()] = False
    used, place = rest.place
    return used[still[used] & is_still[place]]


def _solved(rest, mirror):
    """Return a Mirror of the input as one of the solved vertices, in the unit box."""
    offset = rest.box.to_unit(mirror.image(rest.box.origin[None]))[0]
    solved = np.full(len(rest.input_positions) + 1, NO_PARTNER)
    used, place = rest.place
    solved[used] = place
    partner = np.full(len(rest.V), NO_PARTNER)
    partner[place] = solved[mirror.partner[used]]
    # Midpoints are found where they are: the diagonals that they lie on need not have images.
    is_added = np.ones(len(rest.V), dtype=bool)
    is_added[place] = False
    added = np.flatnonzero(is_added)
    if len(added):
        V = rest.V[added]
        other = partners(V, V @ mirror.linear.T + offset, MATCHING)
        partner[added] = np.where(other == NO_PARTNER, NO_PARTNER, added[other])
    is_mutual = partner[partner] == np.arange(len(partner))
    partner[~is_mutual] = NO_PARTNER
    return Mirror(partner, mirror.linear, offset)

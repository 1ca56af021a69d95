# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that is computed once per mesh and set of pins."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import FloatArray
from ..errors import CubicCraftError
from ..global_step.holds import HoldFields
from ..global_step.step import GlobalStep
from ..inputs import instance, vertex_mask, vertex_numbers
from ..proxy import Links
from ..surface.rest import RestMesh
from ..surface.symmetry import MATCHING, NO_PARTNER, Mirror, commuting, partners
from ..values import Stored, described

NARROW = 0.01
"""Longest side of the triangles, in the unit box, in a ring beside held vertices that is left free:
it moves by less than this length."""
MOST_STRETCH = 4.0
"""How often larger or smaller the area around a vertex may be in a pose that the weights suit."""


class Setup(Stored):
    """A rest mesh, its pinned vertices and the factorization for both.

    It can be pickled, and is factorized anew when it is unpickled.

    Parameters
    ----------
    rest : RestMesh
    pinned : (k,) numpy int array or (N,) numpy bool array, optional
        Vertices of the input that are held exactly: their numbers, or a mask.
    still : (N,) numpy bool array, optional
        Vertices of the input that should stay in place. They are held, except for one narrow ring
        next to the moving vertices, so that the surface bends there without a crease.
    mirrors : sequence of Mirror, optional
        Of the input, in its units: halves that stay mirror images of each other. Held vertices are
        excluded.

    Attributes
    ----------
    pinned_input, pinned : (k,) and (j,) numpy int arrays
        The pinned vertices, and those that are not loose, as indices into ``rest.V``.
    has_pin : (component_count,) numpy bool array
        Components with a pinned vertex.

    Raises
    ------
    CubicCraftError
        An argument has another type or shape, an index is out of range, or no vertex is left free.

    Examples
    --------
    The lower half of a ball is pinned, and the upper half becomes cubic:

    >>> import numpy as np
    >>> from solver import Setup, SolverOptions, Stylization, ball, rest_mesh, run
    >>> V, F = ball()
    >>> is_lower = V[:, 2] < 0
    >>> setup = Setup(rest_mesh(V, F), pinned=is_lower)
    >>> options = SolverOptions(device="numpy")
    >>> result = run(Stylization(setup, 0.6, options=options))
    >>> moved = np.linalg.norm(result.positions - V, axis=1)
    >>> f"{moved[is_lower].max():.2f} below, {moved[~is_lower].max():.2f} above"
    '0.00 below, 0.43 above'
    """

    _made_anew = ("global_step", "coarse")  # factorizations, which cannot be stored

    def __init__(
        self,
        rest: RestMesh,
        pinned: ArrayLike = (),
        still: ArrayLike | None = None,
        mirrors: Sequence[Mirror] = (),
    ):
        self.rest = instance(rest, "rest", RestMesh)
        count = len(rest.input_positions)
        pinned = vertex_numbers(pinned, "pinned", count)
        self.pinned_input = pinned
        is_pinned = np.zeros(count, dtype=bool)
        is_pinned[pinned] = True
        if is_pinned[rest.place[0]].all():
            raise CubicCraftError("all vertices are pinned; leave some of them free")
        if still is not None:
            self.pinned_input = np.union1d(
                pinned, _held_by(rest, vertex_mask(still, "still", count))
            )
            is_pinned[self.pinned_input] = True
        self.pinned = np.flatnonzero(rest.input_map.spread_mask(is_pinned))
        self.mirrors = self._solved(mirrors)
        self.global_step = GlobalStep(rest, self.pinned)
        self.has_pin = self.global_step.is_anchored
        self.hold_fields: HoldFields | None = None

    def __getstate__(self) -> dict[str, Any]:
        state = {**super().__getstate__(), "hold": self.global_step.hold}
        state["hold_fields"] = None if self.hold_fields is None else self.hold_fields.weights
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        hold = state.pop("hold")
        self.__dict__.update(state, hold_fields=None)
        self.global_step = GlobalStep(self.rest, self.pinned, hold)
        if state["hold_fields"] is not None:
            self.__dict__.update(self.with_holds(state["hold_fields"]).__dict__)

    def __repr__(self) -> str:
        pins, holds = len(self.pinned_input), self.hold_fields
        values = [("vertices", len(self.rest.input_positions)), ("pinned", pins)]
        values.append(("held_groups", 0 if holds is None else len(holds.weights)))
        return described(Setup, values)

    def posed(self, input_positions: ArrayLike) -> Setup:
        """Return the same setup in another pose (N,3) of the mesh.

        The factorization is reused, see `RestMesh.posed`. Pinned vertices and groups keep the place
        that they have in that pose.
        """
        other = self._without_coarse()
        other.rest = self.rest.posed(input_positions)
        other.global_step = self.global_step.posed(other.rest)
        if self.hold_fields is not None:
            other.hold_fields = HoldFields(other, self.hold_fields.weights)
        return other

    def serves(self, posed: Setup) -> bool:
        """Return whether the weights of this setup still suit a pose of it.

        They do not where the surface was stretched far: see `MOST_STRETCH`.
        """
        areas, others = self.rest.areas, posed.rest.areas
        is_near = (others <= MOST_STRETCH * areas) & (areas <= MOST_STRETCH * others)
        return bool(is_near.all())

    def with_holds(self, weights: Sequence[ArrayLike]) -> Setup:
        """Return the same setup with groups of vertices that keep their place, see `holds.py`.

        The factorization is reused. A Stylization is given the goal of each group.

        `weights`: sequence of (N,), of the vertices of the input.
        """
        other = self._without_coarse()
        other.hold_fields = HoldFields(self, weights)
        other.global_step = self.global_step.anchored(other.hold_fields.components)
        return other

    def linked(self, rest: RestMesh, links: Links) -> Setup:
        """Return the setup of a RestMesh of the same vertices with further Links, factorized anew.

        Pins, held groups and mirrors stay in force.
        """
        other = self._without_coarse()
        other.rest = rest.held_apart(links)
        other.global_step = GlobalStep(other.rest, self.pinned)
        other.has_pin = other.global_step.is_anchored
        if self.hold_fields is None:
            return other
        weights, other.hold_fields = self.hold_fields.weights, None
        return other.with_holds(weights)

    def held(self, hold: FloatArray) -> Setup:
        """Return the setup whose global step draws vertices to given places, factorized anew.

        `hold`: (n,), how firmly, see `GlobalStep`.
        """
        other = self._without_coarse()
        other.global_step = GlobalStep(self.rest, self.pinned, hold)
        other.has_pin = other.global_step.is_anchored  # no component floats
        if self.hold_fields is not None:
            other.hold_fields = HoldFields(other, self.hold_fields.weights)
        return other

    def _without_coarse(self):
        other = copy(self)
        other.__dict__.pop("coarse", None)
        return other

    def _solved(self, mirrors):
        """Return mirrors of the input as those of the solved vertices."""
        is_pinned = np.zeros(len(self.rest.V), dtype=bool)
        is_pinned[self.pinned] = True
        found = [_solved(self.rest, mirror).without(is_pinned) for mirror in mirrors]
        return commuting(found)

    @cached_property
    def coarse(self) -> Setup | None:
        """The Setup of the coarser mesh, with merged pins, or None if there is no such mesh."""
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
    """Return the vertices of the input that are still (N,), without those in a narrow ring."""
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
    # Midpoints are matched by position: the diagonals that they lie on need not have images.
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

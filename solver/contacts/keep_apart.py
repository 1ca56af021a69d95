# SPDX-License-Identifier: GPL-3.0-or-later
"""Rounds in which surfaces that have come to cross are drawn apart again.

At the end of a run, triangles that cross and did not cross at rest are found. Without any, that is
all. A few are pushed apart. Otherwise links are made across the gaps that are closed, the global
step is factorized anew, and the iteration goes on from where it is; up to four times, but not for
the few that a round has left and pushing does not part: another round hardly does. The links only
add a term to the energy, so it falls in every step of a round. A round costs much more than to
push, so what a round has left is pushed first if it is not much, and often nearly all parts. Where
two rounds have not helped, the run goes on from before the first, without their links.

A round that takes back more of the style than the crossings are worth, between parts, is taken back
itself: links between all the parts of a figure can leave it nearly as round as it was.

Cards, such as hair, give way: links would hold what they are on, and a head of a thousand cards
would stay round. At the end, they ride on it if some cross it (`riding.py`). That they cross each
other does not count.
"""

from copy import copy
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..aliases import FloatArray, IntArray
from ..proxy.links import no_links
from ..proxy.samples import extents
from ..proxy.sheets import is_ground
from .crossings import crossings
from .gaps import Gaps
from .pairs import links_against, merged, mirrored
from .push import heights, pushed
from .riding import riding
from .shown import shown
from .where_crossed import TOUCHING, are_where_parts_crossed, are_where_parts_touched

ROUNDS = 4
TRIES = 2
"""rounds after which no more follow if none has left less than before the first"""
FEW = 1.0 / 2000.0
"""of the triangles: so few are pushed apart first, and only if that fails there is a first round"""
FEWEST = 40
"""triangles that are few on any mesh, however coarse: to push them apart takes less than a round"""
LEFT = 1.0 / 200.0
"""of the triangles: so few of those that a round has left are pushed apart before another round"""
HELPED = 0.5
"""share of the pairs that cross between which there must be links, or a round would be in vain"""
WORTH = 0.05, 1.0
"""how much of the fall of the cubic energy a round may take back, and how much more by the share of
the triangles that cross before it"""
BETWEEN = 0.8
"""share of the pairs that have to be of two parts, or each round is worth it"""
SAMPLE = 500
"""pairs of many that are looked at first: of bricks that touch, no more have to be"""

FIRST = 20
"""share of the cards that are looked at first: of those of one figure, it takes one to have all
ride"""


@dataclass(frozen=True)
class _State:
    """A state of the run, and what crosses in it, but for cards."""

    count: int
    """of triangles that cross and did not at rest"""
    pairs: IntArray
    """(k,2) int of triangles"""
    U: FloatArray
    R: FloatArray
    is_pushed: bool = False


class _Before(NamedTuple):
    """What the first round begins from, until it has been judged."""

    state: _State
    fall: float
    """of the cubic energy, from rest"""


class KeepApart:
    """The rounds of one run.

    Call `check` when the iteration has ended, then `renewed` if it asks for another round, else
    `finish`. All of them take the Stylization.

    `crossings`: number of triangles of the input that can be seen to cross and did not cross at
    rest. `pressed`: how many of them only cross other parts, which a round was too dear for.
    `vertices`: (k,) int, their vertices in the input.
    """

    def __init__(self, rest):
        self._rest, self._shown = rest, rest.shown
        self._is_card = rest.is_card[rest.shown[:, 0]]
        self._firm = np.flatnonzero(~self._is_card)
        self._links, self._gaps, self._rounds = no_links(), None, 0
        self._now: _State | None = None
        self._best: _State | None = None
        self._progress, self._has_helped = (0, 0), False
        self._before: _Before | None = None
        self._may_press = False
        self._first: Any = None
        self._at_end = np.empty(0, np.intp)
        self._crossing = self._found = np.empty((0, 2), np.intp)
        self._looked_at: FloatArray | None = None
        self.crossings, self.pressed, self.vertices = 0, 0, np.empty(0, np.intp)

    def look(self, stylization):
        """Find what crosses in a shape near the one at the end; return its solved vertices (k,).

        What has crossed there does not count. Another look is for what has moved since the last.
        """
        U = stylization.positions
        before, self._looked_at = self._looked_at, U
        if before is None:
            self._crossing = self._new(U)
        else:
            self._crossing = self._pairs_after(self._crossing, before, U)
        pairs = self._crossing
        pairs = pairs[~np.isin(pairs, self._at_end).all(axis=1)]
        pairs = self._amiss(pairs, U)
        if self._may_press:
            pairs = pairs[~self._are_of_two_parts(pairs)]
        self._found = pairs
        return np.unique(self._shown[pairs])

    @property
    def is_between_parts(self):
        """Whether nearly all that `look` has found is of two parts."""
        return bool(len(self._found) and self._are_of_two_parts(self._found).mean() > BETWEEN)

    @property
    def parts_found(self):
        """(k,2) int the pairs of parts that `look` has found to cross, the lower number first."""
        parts = self._rest.topology.part[self._shown[self._found, 0]]
        return np.unique(np.sort(parts[parts[:, 0] != parts[:, 1]], axis=1), axis=0)

    def pressing(self):
        """Return the same for parts that may press into each other.

        To leave them soft would not be worth it.
        """
        other = copy(self)
        other._may_press = True
        return other

    def parted(self, stylization):
        """Return the positions (n,3) pushed so that less of what `look` has found crosses."""
        return self._pushed(stylization.positions, self._found, stylization)

    def check(self, stylization):
        """Find what crosses now; return whether another round is needed."""
        U, R = stylization.positions, stylization.rotations
        pairs = self._new(U)
        now = self._now = _State(self._count(pairs), pairs, U.copy(), R.copy())
        self._keep(now)
        if self._before is not None:
            if self._is_too_dear(stylization, self._before):
                self._best, self._has_helped = self._before.state, False
                self._may_press = True
                return False
            self._before = None
        progress = len(self._links), -now.count
        is_stuck = self._rounds > 0 and progress <= self._progress
        is_stuck |= self._rounds >= TRIES and not self._has_helped
        self._progress = progress
        if not now.count or self._rounds == ROUNDS or is_stuck:
            return False
        few = max(FEW * len(self._shown), FEWEST)
        if now.count > (max(LEFT * len(self._shown), few) if self._rounds else few):
            return True
        self._push(now, stylization)
        return self._best_so_far().count > (few if self._rounds else 0)

    def renewed(self, stylization):
        """Return a Stylization with links against what crosses, from the same state.

        Or None, if hardly any of it could be linked, as where parts cross at rest: they have no gap
        beside that line, and the links would only make the shape stiffer.
        """
        if self._gaps is None:
            self._gaps = Gaps(self._rest.V, self._rest.normals, self._rest.F)
        U, R = stylization.positions, stylization.rotations
        is_wide = self._rounds > 0  # fewer links have not been enough
        assert self._now is not None, "there has been no check"
        pairs = self._now.pairs
        step = len(pairs) // SAMPLE
        looks = [(pairs[::step], 0.5 * HELPED)] if step > 1 and not is_wide else []
        found = no_links()
        for some, least in [*looks, (pairs, HELPED)]:
            found = links_against(self._rest, self._gaps, self._shown, some, U, R, is_wide)
            if self._share_linked(some, found) < least:
                return None
        found = mirrored(found, stylization.setup.mirrors)
        if not self._rounds and self._are_of_two_parts(pairs).mean() > BETWEEN:
            fall = _energy_at_rest(stylization).cubic - stylization.energy.cubic
            self._before = _Before(self._now, fall)
        self._first = self._first or stylization
        self._links = merged(self._links, found)
        self._rounds += 1
        return stylization.continued(stylization.setup.linked(self._rest, self._links))

    def finish(self, stylization):
        """Return the Stylization in the best state, with what still crosses there pushed apart."""
        if self._first is not None and not self._has_helped:
            self._first.iterations = stylization.iterations
            stylization = self._first
        best = self._best_so_far()
        if best.count and not best.is_pushed:
            self._push(best, stylization)
            best = self._best_so_far()
        if self._rounds or best.is_pushed:
            stylization.go_to(best.R, best.U)
        self._at_end, self._crossing = np.unique(best.pairs), best.pairs
        # no more rounds: what they are found from takes as much memory as the run itself
        self._now = self._best = self._before = self._first = self._gaps = None
        return stylization

    def conclude(self, stylization):
        """Return the Stylization at the end, in which cards ride where some cross what is none.

        And count what then can be seen to cross.
        """
        U = stylization.positions
        may_ride = self._rest.is_card & ~self._rest.is_sheet
        may_ride[stylization.setup.pinned] = False
        cards = np.flatnonzero(self._is_card)
        # where all ride anyway, the others are only looked at afterwards
        with_cards = self._with_cards(U, cards[: len(cards) // FIRST])
        is_carried = may_ride & self._are_beside(with_cards)
        if not (is_carried.any() and is_carried[may_ride].all()):
            with_cards = self._with_cards(U, cards)
            is_carried = may_ride & self._are_beside(with_cards)
        if is_carried.any():
            stylization = stylization.with_riding(riding(self._rest, is_carried))
            U = stylization.positions
            with_cards = self._with_cards(U, cards)
        pairs = self._amiss(np.concatenate([self._crossing, with_cards]), U)
        pairs = pairs[shown(U, self._shown, pairs)]
        crossing = self._triangles(pairs)
        self.crossings = len(np.unique(crossing))
        if self._may_press:
            failed = self._triangles(pairs[~self._are_of_two_parts(pairs)])
            self.pressed = self.crossings - len(np.unique(failed))
        self.vertices = np.unique(self._rest.triangles[crossing])
        return stylization

    def _amiss(self, pairs, U):
        """Return those of pairs (k,2) that are not where parts crossed or touch, nor of a fold."""
        pairs = pairs[~are_where_parts_crossed(self._rest, pairs)]
        pairs = pairs[~are_where_parts_touched(self._rest, U, pairs)]
        apart = self._rest.polygons_apart if len(pairs) else None
        return pairs if apart is None else pairs[apart(pairs)]

    def _are_of_two_parts(self, pairs):
        """Return which pairs (k,2) are of two parts, neither of which is worn by others.

        Fingers that cross, or a skin that comes through a shirt, are worse than a wing in a body.
        """
        one, other = self._rest.topology.part[self._shown[pairs, 0]].T
        is_worn = self._rest.is_worn
        return (one != other) & ~is_worn[one] & ~is_worn[other]

    def _is_too_dear(self, stylization, before):
        least, by_share = WORTH
        worth = least + by_share * before.state.count / len(self._shown)
        return stylization.energy.cubic - self._first.energy.cubic > worth * before.fall

    def _push(self, state, stylization):
        """Push apart what crosses in a state; the result counts if less crosses."""
        U = self._pushed(state.U, state.pairs, stylization)
        pairs = self._pairs_after(state.pairs, state.U, U)
        self._keep(_State(self._count(pairs), pairs, U, state.R, is_pushed=True))

    def _pushed(self, U, pairs, stylization):
        is_free = np.ones(len(U), dtype=bool)
        is_free[stylization.setup.pinned] = False
        V, F, firm = self._rest.V, self._shown[self._firm], self._firm
        pairs = np.searchsorted(firm, pairs)
        return pushed(V, U, F, pairs, lambda x: self._counts(firm[x]), is_free, stylization.impose)

    def _pairs_after(self, pairs, before, U):
        """Return the pairs that cross after some vertices have been moved, of those before."""
        is_moved = (before != U).any(axis=1)[self._shown].any(axis=1)
        pairs = pairs[~is_moved[pairs].any(axis=1)]
        return np.concatenate([pairs, self._new(U, is_moved)])

    def _best_so_far(self) -> "_State":
        assert self._best is not None, "there has been no check"
        return self._best

    def _count(self, pairs):
        return len(np.unique(self._triangles(pairs)))

    def _keep(self, state):
        if self._best is None or state.count < self._best.count:
            self._has_helped, self._best = self._best is not None, state

    def _share_linked(self, pairs, links):
        is_linked = np.zeros(len(self._rest.V), dtype=bool)
        is_linked[links.vertices[links.coefficients != 0.0]] = True
        return np.any(is_linked[self._shown], axis=1)[pairs].all(axis=1).mean()

    def _new(self, U, is_asked=None):
        """Return pairs (k,2) of triangles that cross, of no cards, and did not at rest."""
        is_asked = None if is_asked is None else is_asked[self._firm]
        pairs = self._firm[crossings(U, self._shown[self._firm], is_asked)]
        return pairs[self._counts(pairs)]

    def _with_cards(self, U, cards):
        """Return pairs (k,2) of triangles, of cards (c,) and of none, that newly cross."""
        is_asked = np.zeros(len(self._shown), dtype=bool)
        is_asked[cards] = True
        pairs = crossings(U, self._shown, is_asked, with_others=True)
        pairs = pairs[~self._is_card[pairs].all(axis=1)]
        pairs = pairs[~self._are_touching(pairs)]
        return pairs[self._counts(pairs)]

    def _are_beside(self, pairs):
        """Return the vertices (n,) of components with cards that newly cross in pairs (k,2)."""
        crossing, component = self._triangles(pairs), self._rest.topology.component
        of_cards = self._shown[crossing[self._is_card[crossing]], 0]
        return np.isin(component, component[of_cards])

    def _counts(self, pairs):
        """Return which pairs (k,2) did not both cross something at rest, and are of no ground.

        What stands on one would move it: a plane gives way to everything.
        """
        counts, corners = ~self._rest.crosses_at_rest(pairs).all(axis=1), self._shown[pairs, 0]
        is_sheet = self._rest.is_sheet
        if is_sheet[corners].any():
            V, part = self._rest.V, self._rest.topology.part
            counts &= ~is_ground(extents(V, part)[part], is_sheet, *corners.T)
        return counts

    def _are_touching(self, pairs):
        """Return which pairs (k,2) are of a card and what it stands on at rest.

        There is no gap that could be kept: its border dips below, or stands out.
        """
        V, (A, B) = self._rest.V, self._shown[pairs].swapaxes(0, 1)
        a, b = V[A], V[B]
        is_touching = np.all(a.min(axis=1) < b.max(axis=1) + TOUCHING, axis=1)
        is_touching &= np.all(b.min(axis=1) < a.max(axis=1) + TOUCHING, axis=1)
        away = [np.abs(heights(V, *ends)[1]).min(axis=1) for ends in ((A, B), (B, A))]
        return is_touching & (np.minimum(*away) < TOUCHING)

    def _triangles(self, pairs):
        """Return the triangles of pairs that crossed nothing at rest."""
        triangles = pairs.ravel()
        return triangles[~self._rest.crosses_at_rest(triangles)]


def _energy_at_rest(stylization):
    """Return the Energy of the rest shape; the state stays as it is, but for its momentum."""
    energy, R, U = stylization.energy, stylization.rotations.copy(), stylization.positions.copy()
    stylization.go_to(np.tile(np.eye(3), (len(U), 1, 1)), stylization.rest.V)
    at_rest, _ = stylization.finish(), stylization.go_to(R, U)
    stylization.energy = energy
    return at_rest

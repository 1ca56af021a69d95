# SPDX-License-Identifier: GPL-3.0-or-later
"""The iteration in which the sides of a soft shape become flat."""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import FloatArray, IntArray
from ..global_step.motion import Motion
from ..iteration.setup import Setup
from ..iteration.stylization import Stylization
from .face_step import FaceStep
from .hardening import Hardening, hardening_after, hardening_of

_SEEN = 0.5  # crispness at which borders are straight; what is softer has hardly any
_LEAST = 0.05  # crispness that can be moved: a move grows by its inverse


class HardStylization(Stylization):
    """A Stylization that goes on from a soft one with flat sides.

    Its positions are between the soft shape and the hard one, as far as the crispness says; its
    energy is that of `FaceStep`.

    `soft`: at its end. It stays as it is. `before`: (m,3), what triangles faced in the frame of an
    animation before, `hardening.facing`.

    Attributes
    ----------
    hardening : Hardening
    """

    _made_anew = (*Stylization._made_anew, "_rotations", "_rotations_of", "_planes")

    def __init__(self, soft: Stylization, before: FloatArray | None = None):
        self.__dict__.update(soft.__dict__)
        self.hardening = hardening_of(soft, before)
        held = soft.setup.held(self.hardening.target.hold)
        self._begin(held, self.hardening.soft.copy(), self.hardening.rotations)

    def _local_step_of(self, rest, most_cubeness):
        return FaceStep(rest, self.hardening.target)

    def give_back_volume(self) -> None:
        """Go on with the volume of the soft shape, see `FaceStep`."""
        self._local.give_back_volume(self._motion.positions)

    def straighten_borders(self, *, may_cross: bool = False, apart: ArrayLike = ()) -> None:
        """Make sides that are nearly flat flat, and the borders of all sides straight.

        The borders where they are now, between soft and hard. Not those of a cage, which follow its
        edges: it could not follow them elsewhere. Where they `may_cross` others, that is not looked
        for. Of parts that cross already, `apart`, (k,2) int, are the pairs that are to cross no
        more than they do.
        """
        if self.rest.is_cage:
            return
        fixed, hard = self.setup.pinned, self._motion.positions
        self.hardening = self.hardening.flattened(
            hard, self._to_planes(), fixed, may_cross=may_cross, apart=apart
        )
        U = self.hardening.positions(hard)
        share = self.hardening.crispness[:, None]
        straight = U + self.hardening.straightening(U, fixed, may_cross=may_cross)
        self.impose(straight)
        moves = self.hardening.moves + (straight - U) / np.maximum(share, _SEEN)
        self.hardening = replace(self.hardening, moves=moves)

    def _to_planes(self):
        """Return `to_planes` of the hardening, found once for all crispnesses of a shape."""
        of, hard = (self.hardening.target, self.hardening.rotations), self._motion.positions
        known, U, found = self.__dict__.get("_planes", ((None, None), None, None))
        if known[0] is not of[0] or known[1] is not of[1] or not np.array_equal(U, hard):
            found = self.hardening.to_planes(hard)
            self._planes = of, hard.copy(), found
        return found

    def with_crispness(self, crispness: ArrayLike) -> HardStylization | None:
        """Return one at the same point with another crispness, as of a `Style`.

        None if other triangles would then belong to sides.
        """
        style = self._style.with_crispness(crispness, self.setup)
        if style is None:
            return None
        other = copy(self)
        other._style = style
        other.hardening = self.hardening.with_crispness(style)
        other.straighten_borders()
        return other

    def beside(self, soft: Stylization) -> HardStylization:
        """Return one at the same point, with the same sides, which can `follow` another soft one.

        It has the crispness of that, and the places of what is pinned, held or loose.
        """
        other = copy(self)
        other.rest, other._style, other._targets = soft.rest, soft._style, soft._targets
        if len(soft._hold_matrices) == len(self._hold_matrices):
            other._hold_matrices = soft._hold_matrices
        other._constraints = other._constraints_of(self.setup)
        other._motion = Motion(self.setup, self._local, self._motion.positions, other._constraints)
        other.hardening = self.hardening.with_crispness(soft._style)
        return other

    def follow(self, soft: Stylization) -> None:
        """Go along with the soft shape, with the same sides."""
        before = self.hardening.soft
        self.hardening = self.hardening.followed(soft.positions.copy(), soft.rotations.copy())
        moves = self.hardening.soft - before
        self._local.hold_beside(moves)
        self._motion.put(self._motion.positions + moves)

    def found_anew(self, soft: Stylization) -> Hardening:
        """Return the Hardening of another soft one of the same vertices, with sides found anew."""
        return hardening_after(self.hardening, soft)

    def go_on_with(self, soft: Stylization, found: Hardening, held: Setup) -> HardStylization:
        """Return one that goes on from here with what was `found_anew`.

        `held`: the setup of the soft one, drawn to its shape by the hold of `found`.
        """
        other, U = copy(self), self._motion.positions + found.soft - self.hardening.soft
        other.__dict__.update(soft.__dict__)
        other.iterations, other.hardening, other.setup = self.iterations, found, held
        other._local = self._local.go_on_with(other.rest, found.target)
        other._constraints = other._constraints_of(held)
        other._motion = other._local.motion(held, U, other._constraints)
        return other

    def softened(self, vertices: IntArray) -> HardStylization:
        """Return one at the same point that is soft at vertices (k,) and around them."""
        other = copy(self)
        other.hardening = self.hardening.softened(self.rest, vertices)
        return other

    def moved_to(self, places: FloatArray) -> HardStylization:
        """Return one whose shape is at places (n,3) near it, but for what is nearly soft."""
        other, share = copy(self), self.hardening.crispness[:, None]
        moves = np.where(share > _LEAST, (places - self.positions) / np.maximum(share, _LEAST), 0.0)
        other.hardening = replace(self.hardening, moves=self.hardening.moves + moves)
        return other

    @property
    def crisp_area(self) -> float:
        """The area at rest that is crisp."""
        return float(self.rest.areas @ self.hardening.crispness)

    @property
    def rotations(self) -> FloatArray:
        """(n,3,3) rotations as of a Stylization; once they are found, until something changes."""
        state = self._local.R, self.hardening, self._riding
        known = self.__dict__.get("_rotations_of", (None,))
        if any(now is not before for now, before in zip(state, known, strict=False)):
            self._rotations, self._rotations_of = super().rotations, state
        return self._rotations

    def _shape(self) -> FloatArray:
        U = self.hardening.positions(self._motion.positions)
        for mirror in self.setup.mirrors:  # the crispness is of samples that are not symmetric
            mirror.impose(U)
        return U

    def _turns(self) -> FloatArray:
        return self.hardening.between(self._local.R)

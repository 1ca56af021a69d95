# SPDX-License-Identifier: GPL-3.0-or-later
"""The iteration in which the sides of a soft shape become flat."""

from __future__ import annotations

from copy import copy
from dataclasses import replace

from numpy.typing import ArrayLike

from ..aliases import FloatArray, IntArray
from ..styles.style import Style
from ..stylization import Stylization
from .face_step import FaceStep
from .hardening import hardening_of


class HardStylization(Stylization):
    """A Stylization that goes on from a soft one with flat sides.

    Its positions are between the soft shape and the hard one, as far as the crispness says; its
    energy is that of `FaceStep`.

    Parameters
    ----------
    soft : Stylization
        At its end. It stays as it is.
    before : (m,3) array, optional
        What triangles faced in the frame of an animation before, `hardening.facing`.

    Attributes
    ----------
    hardening : Hardening
    """

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

    def straighten_borders(self) -> None:
        """Make the borders of the sides straight where they are now.

        Not those of a cage, which follow its edges: it could not follow them elsewhere.
        """
        if self.rest.is_cage:
            return
        U = self._motion.positions
        straight = U + self.hardening.straightening(U, self.rest.F, self.setup.pinned)
        self.impose(straight)
        self.hardening = replace(self.hardening, moves=straight - U)

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
        return other

    def restyled(self, style: Style) -> HardStylization:
        """Return one at the same point with the cubeness and the crispness of another style.

        Its sides stay as they are; see `follow`.
        """
        other = copy(self)
        other._style = self._style.with_strengths(style, self.setup)
        other.hardening = self.hardening.restyled(self._style, other._style)
        return other

    def follow(self, soft: Stylization) -> None:
        """Go along with the soft shape, with the same sides."""
        before = self.hardening.soft
        self.hardening = self.hardening.followed(soft.positions.copy(), soft.rotations.copy())
        moves = self.hardening.soft - before
        self._local.hold_beside(moves)
        self._motion.put(self._motion.positions + moves)

    def softened(self, vertices: IntArray) -> HardStylization:
        """Return one at the same point that is soft at vertices (k,) and around them."""
        other = copy(self)
        other.hardening = self.hardening.softened(self.rest, vertices)
        return other

    def _shape(self) -> FloatArray:
        U = self.hardening.positions(self._motion.positions)
        for mirror in self.setup.mirrors:  # the crispness is of samples that are not symmetric
            mirror.impose(U)
        return U

    def _turns(self) -> FloatArray:
        return self.hardening.between(self._local.R)

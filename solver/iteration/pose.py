# SPDX-License-Identifier: GPL-3.0-or-later
"""The pose in which a mesh is solved: where its handles go, and which way its limbs lie."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import FloatArray
from ..errors import CubicCraftError
from ..inputs import instance, real_numbers
from ..limbs import KnownLimbs
from ..values import Value
from .setup import Setup


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Pose(Value):
    """Where the handles of a `Setup` go, and how the limbs lie that are known.

    A `Stylization` is begun in a pose, and refuses one that does not fit its setup.

    Raises
    ------
    CubicCraftError
        The limbs are of another type.

    Examples
    --------
    The lower half of a ball is pinned, and a tenth of it moves down:

    >>> import numpy as np
    >>> from solver import Pose, Setup, SolverOptions, Stylization, ball, rest_mesh, run
    >>> V, F = ball()
    >>> setup = Setup(rest_mesh(V, F), pinned=V[:, 2] < 0)
    >>> lower = np.where(V[:, 2:] < -0.8, V - [0, 0, 0.5], V)
    >>> options = SolverOptions(device="numpy")
    >>> result = run(Stylization(setup, 0.4, Pose(targets=lower), options))
    >>> np.array_equal(result.positions[setup.pinned_input], lower[setup.pinned_input])
    True
    """

    targets: ArrayLike | None = None
    """(N,3) positions of the pinned vertices in the units of the input, by default those at rest.
    The rows of all other vertices are ignored"""
    hold_matrices: Sequence[FloatArray] = ()
    """(4,4) map of each of the groups of `Setup.with_holds`, in the units of the input"""
    limbs: KnownLimbs | None = None
    """limbs that are known for some vertices of the input, as from bones. Those of the others are
    found from the shape. Only with `ProxyOptions.keep_pose`"""

    def __post_init__(self):
        if self.limbs is not None:
            instance(self.limbs, "limbs", KnownLimbs)

    def targets_of(self, setup: Setup) -> FloatArray:
        """Return the targets (N,3) of the vertices of a setup; only those of pins matter.

        Raises CubicCraftError: they have another shape, or one of a pinned vertex is not finite.
        """
        at_rest = setup.rest.input_positions
        if self.targets is None:
            return at_rest
        targets = real_numbers(self.targets, "targets")
        if targets.shape != at_rest.shape:
            raise CubicCraftError(
                f"targets must have the shape {at_rest.shape}, not {targets.shape}"
            )
        if not np.isfinite(targets[setup.pinned_input]).all():
            raise CubicCraftError("the targets of pinned vertices must be finite")
        return targets


def pins_moved(setup: Setup, targets: FloatArray) -> FloatArray:
    """Return how far targets (N,3) are from rest for the pinned solved vertices (k,3)."""
    rest = setup.rest
    moved = np.zeros_like(rest.input_positions)
    share = np.zeros(len(moved))
    share[setup.pinned_input] = 1.0
    moved[setup.pinned_input] = (targets - rest.input_positions)[setup.pinned_input]
    # of welded vertices, only the pinned ones count
    moved, share = (rest.input_map.spread(x)[setup.pinned] for x in (moved, share))
    return moved / share[:, None]

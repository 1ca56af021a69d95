# SPDX-License-Identifier: GPL-3.0-or-later
"""What the settings ask for at each vertex of all that is solved at once.

Arrays are indexed by the `N` vertices that the solver is given: those of the members, one after
the other, each with what its Mirror modifier adds.
"""

from __future__ import annotations

import numpy as np

from .. import handles
from .assembly import Prepared
from .mirrored_cubes import orientations


def cubeness(prepared: Prepared) -> float | np.ndarray:
    """Return the cubeness, a number or (N,) of them."""
    factors = [member.map_weights for member in prepared.members]
    values = [member.settings.cubeness for member in prepared.members]
    if len(set(values)) == 1 and all(isinstance(factor, float) for factor in factors):
        return values[0] * factors[0]
    return np.concatenate(
        [
            member.of_whole(value * factor)
            for member, value, factor in zip(prepared.members, values, factors, strict=True)
        ]
    )


def orientation(prepared: Prepared) -> np.ndarray:
    """Return the orientation, (3,3), or (N,3,3) where the objects' axes differ.

    Beyond a plane of symmetry the cube is mirrored as well.
    """
    found = [orientations(member.whole, placement) for member, placement, _ in prepared.parts()]
    first = found[0][0]
    # The rounding of world matrices is no difference.
    if all(np.allclose(other, first, rtol=0.0, atol=1e-6) for other in found):
        return first
    counts = [len(member.whole.source) for member in prepared.members]
    return np.concatenate(
        [np.broadcast_to(Q, (count, 3, 3)) for Q, count in zip(found, counts, strict=True)]
    )


def targets(prepared: Prepared) -> np.ndarray:
    """Return where the handles want the vertices, (N,3)."""
    return np.concatenate(
        [
            placement.place(
                member.whole.images(
                    handles.targets(
                        member.shape.original, member.handle_of, member.settings.handles
                    )
                )
            )
            for member, placement, _ in prepared.parts()
        ]
    )

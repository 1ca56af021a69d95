# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of each vertex that is solved.

Arrays are indexed by the `N` vertices of the solver's input: those of the members, in order, each
with those that its Mirror modifier adds.
"""

from __future__ import annotations

import numpy as np

from ...solver.styles.forms import cube
from ...solver.styles.polytope import Polytope
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
    """Return the orientation, (3,3), or (N,3,3) if the objects' axes differ.

    Beyond a plane of symmetry, the cube is also mirrored.
    """
    found = [orientations(member.whole, placement) for member, placement, _ in prepared.parts()]
    first = found[0][0]
    # Ignore rounding errors of world matrices.
    if all(np.allclose(other, first, rtol=0.0, atol=1e-6) for other in found):
        return first
    counts = [len(member.whole.source) for member in prepared.members]
    return np.concatenate(
        [np.broadcast_to(Q, (count, 3, 3)) for Q, count in zip(found, counts, strict=True)]
    )


def forms(prepared: Prepared) -> tuple[list[Polytope] | None, np.ndarray | None]:
    """Return the forms and the number of the form of each vertex (N,); None if all are cubes."""
    found = [placement.form for placement in prepared.placements]
    if not any(found):
        return None, None
    distinct = list(dict.fromkeys(found))
    counts = [len(member.whole.source) for member in prepared.members]
    numbers = np.repeat([distinct.index(form) for form in found], counts)
    return [form or cube() for form in distinct], numbers


def targets(prepared: Prepared) -> np.ndarray:
    """Return the targets (N,3) of the vertices by the handles."""
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

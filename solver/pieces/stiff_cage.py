# SPDX-License-Identifier: GPL-3.0-or-later
"""Cages of so few vertices that their smooth surface cannot become what was solved.

However the 8 corners of a cube are moved, the ball that is seen of it stays round.
"""

import numpy as np

from ..aliases import FloatArray
from ..mesh.rest_measures import triangle_areas_and_normals
from .piece import Piece
from .subdivided import Subdivided

LEFT = 0.9
"""of the change of the normals: with more left to do, the cage has not followed"""
LEAST = np.radians(5.0)
"""root mean square of that change; less is hardly seen"""


def is_stiff(piece: Piece, positions: FloatArray, own: FloatArray) -> bool:
    """Return whether a piece is a cage that does not follow its result.

    `positions`: (N,3), the result, where it was solved. `own`: (n,3), the mesh that was read back
    from it.
    """
    whole = piece.whole
    if not isinstance(whole, Subdivided):
        return False
    rest, now = (whole.images(mesh.astype(np.float64)) for mesh in (piece.shape.original, own))
    shapes = rest, piece.placement.read_back(positions), now
    found = (triangle_areas_and_normals(U, whole.triangles) for U in shapes)
    (area, before), (_, wanted), (_, after) = found
    change, left = (area @ ((n - wanted) ** 2).sum(axis=1) for n in (before, after))
    return bool(change > LEAST**2 * area.sum() and left > LEFT * change)

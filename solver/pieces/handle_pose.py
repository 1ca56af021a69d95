# SPDX-License-Identifier: GPL-3.0-or-later
"""Where handles take their vertices."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import FloatArray, IntArray
from ..inputs import matrix_of, switch

IDENTITY = tuple(np.eye(4).ravel().tolist())


@dataclass(frozen=True, kw_only=True)
class HandlePose:
    """How a handle of `piece_of` keeps or moves its vertices.

    Raises
    ------
    CubicCraftError
        The matrix is not one of finite numbers.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import HandlePose
    >>> raised = np.eye(4)
    >>> raised[2, 3] = 0.5
    >>> HandlePose().is_moved, HandlePose(matrix=raised).is_moved
    (False, True)
    """

    matrix: ArrayLike = IDENTITY
    """(4,4), or its 16 numbers row by row, as which it is kept: affine map of positions at rest, in
    the coordinates of the object"""
    is_cubic: bool = False
    """whether only its position and rotation are kept, and its surface becomes cubic"""

    def __post_init__(self):
        if not isinstance(self.matrix, tuple) or len(self.matrix) != 16:
            numbers = matrix_of(self.matrix, "the matrix of a handle").ravel()
            object.__setattr__(self, "matrix", tuple(numbers.tolist()))  # frozen
        switch(self.is_cubic, "is_cubic")

    @property
    def is_moved(self) -> bool:
        """Whether it moves its vertices."""
        return self.matrix != IDENTITY


def targets(original: FloatArray, handle_of: IntArray, handles: Sequence[HandlePose]) -> FloatArray:
    """Return the targets of the vertices by the handles.

    `original`: (n,3). `handle_of`: (n,) int, number of the handle of each vertex, or -1. Returns
    (n,3); free vertices and those of handles that do not move keep their bits.
    """
    result = original.astype(np.float64)
    for number, handle in enumerate(handles):
        if handle.is_moved:
            matrix = np.reshape(handle.matrix, (4, 4))
            held = handle_of == number
            result[held] = result[held] @ matrix[:3, :3].T + matrix[:3, 3]
    return result

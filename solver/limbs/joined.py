# SPDX-License-Identifier: GPL-3.0-or-later
"""KnownLimbs of several bodies, and in other coordinates."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from ..aliases import FloatArray
from .limbs import KnownLimbs, no_limbs


def joined_limbs(parts: Sequence[KnownLimbs | None], counts: Sequence[int]) -> KnownLimbs | None:
    """Return the KnownLimbs of bodies that are solved together, None if none is known.

    `parts`: sequence of KnownLimbs, or None where nothing is known. `counts`: numbers of vertices
    of the bodies.

    Examples
    --------
    >>> from solver.limbs import joined_limbs
    >>> joined_limbs([None, None], [8, 6])
    """
    if all(part is None for part in parts):
        return None
    pairs = zip(parts, counts, strict=True)
    found = [_unknown(count) if part is None else _used(part) for part, count in pairs]
    return KnownLimbs(
        np.concatenate([part.directions for part in found]),
        sp.csr_matrix(sp.block_diag([part.shares for part in found])),
        np.concatenate([part.known for part in found]),
        carried=np.concatenate([part.all_carried for part in found]),
    )


def placed_limbs(limbs: KnownLimbs, rotation: FloatArray) -> KnownLimbs:
    """Return KnownLimbs in other coordinates, by a rotation or reflection (3,3).

    Examples
    --------
    >>> import numpy as np
    >>> from scipy.sparse import csr_matrix
    >>> from solver import KnownLimbs, placed_limbs
    >>> along_x = np.array([[1.0, 0, 0]])
    >>> arm = KnownLimbs(along_x, csr_matrix([[1.0], [0.0]]), np.array([True, False]))
    >>> placed_limbs(arm, np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])).present.tolist()
    [[0.0, 1.0, 0.0]]
    """
    carried = rotation @ limbs.all_carried @ rotation.T
    return replace(limbs, directions=limbs.directions @ rotation.T, carried=carried)


def _used(limbs):
    used = np.flatnonzero(np.asarray(limbs.shares.sum(axis=0)).ravel() > 0.0)
    carried = limbs.all_carried[used]
    shares = limbs.shares[:, used]
    return replace(limbs, directions=limbs.directions[used], shares=shares, carried=carried)


def _unknown(count):
    nothing = no_limbs(count)
    return KnownLimbs(nothing.directions, nothing.shares, np.zeros(count, dtype=bool))

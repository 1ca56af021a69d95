# SPDX-License-Identifier: GPL-3.0-or-later
"""The rotation that fits a 3 x 3 matrix best (orthogonal Procrustes), for many at once.

R = argmax tr(R M) over SO(3), by Newton's method on SO(3) from a good guess: with G = R M,

    tr(exp([w]) G) ~ tr G + g.w - w'Hw/2,   g = axl(G - G'),   H = tr(G) I - (G + G')/2.

Where g vanishes and H is positive definite, R is the global maximum: H has the pairwise sums of the
signed singular values as eigenvalues. So the result is certified, and what Newton's method cannot
certify (reflections, rank 1, far-off guesses) gets a singular value decomposition.
"""

from typing import Any

import numpy as np

from .algebra import (
    adjugate,
    axial,
    blocks,
    columns,
    determinant,
    from_columns,
    nearer_to_orthogonal,
    times,
    trace,
    turn,
)
from .aliases import FloatArray

NEWTON_STEPS = 8
ANGLE_TOLERANCE = 1e-6
"""radians; the step that is smaller is still applied and leaves an error of its square or less"""
MIN_CURVATURE = 1e-4
"""of det H over (tr G)^3, below which the maximum is not certified"""


def fit_rotations(M, guess):
    """Return R (n,3,3), each maximizing tr(R M) over SO(3), for M (n,3,3) and rotations near R."""
    R = guess.copy()
    todo = np.arange(len(M))
    uncertified = []
    for _ in range(NEWTON_STEPS):
        if not len(todo):
            break
        step, is_safe = _newton_step(R[todo] @ M[todo])
        uncertified.append(todo[~is_safe])
        todo, step = todo[is_safe], step[is_safe]
        x, y, z = 0.5 * step.T  # the quaternions (1, step/2), normalized
        turns = from_columns(turn(2.0 / (1.0 + x * x + y * y + z * z), 1.0, x, y, z))
        R[todo] = turns @ R[todo]
        todo = todo[(step * step).sum(1) > ANGLE_TOLERANCE**2]
    others = np.concatenate([*uncertified, todo])
    R[others] = svd_rotations(M[others])
    return R


def svd_rotations(M: FloatArray) -> FloatArray:
    """Return argmax tr(R M) over SO(3), (n,3,3), of M (n,3,3) by singular value decompositions.

    Notes
    -----
    Kabsch, "A solution for the best rotation to relate two sets of vectors", Acta Crystallographica
    A32, 1976.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import svd_rotations
    >>> np.allclose(svd_rotations(np.diag([3.0, 2.0, 1.0])[None]), np.eye(3))
    True
    """
    U, _, Vt = np.linalg.svd(M)
    product: Any = U @ Vt
    R = product.swapaxes(1, 2)
    mirrored = np.linalg.det(R) < 0.0
    U[mirrored, :, 2] *= -1.0
    R[mirrored] = (U[mirrored] @ Vt[mirrored]).swapaxes(1, 2)
    return R


def orthonormalize(R, steps=1):
    """Return R (n,3,3), almost rotations, without the rounding errors of many products.

    Of a part at a time that stays in the cache: a fifth of the time that products of small matrices
    take NumPy.
    """
    result = np.empty_like(R)
    for part in blocks(len(R)):
        entries = R[part].T.reshape(9, -1)  # of the transposes, which are turned back below
        for _ in range(steps):
            entries = nearer_to_orthogonal(*entries)
        result[part] = np.reshape(entries, (3, 3, -1)).T
    return result


def curvature(*G):
    """Return H as above, in the entries of `algebra.py`."""
    a, b, c, d, e, f, g, h, i = G
    whole = trace(*G)
    x, y, z = -(b + d) / 2, -(c + g) / 2, -(f + h) / 2
    return [whole - a, x, y, x, whole - e, z, y, z, whole - i]


def is_definite(least, *entries):
    """Return whether a symmetric matrix is positive definite, and not by rounding alone.

    `least`: float, `MIN_CURVATURE`, in the precision of the entries. `*entries`: scalars, the
    entries of the matrix and of its adjugate, as in `algebra.py`.
    """
    half_trace = trace(*entries[:9]) / 2
    is_positive = (half_trace > 0) & (entries[0] > 0) & (entries[17] > 0)
    return is_positive & (determinant(*entries) > least * (half_trace * half_trace * half_trace))


def _newton_step(M):
    """Return the rotation vectors (n,3) of the Newton steps and which of them are safe (n,)."""
    G = columns(M)
    H = curvature(*G)
    H_adjugate = adjugate(*H)
    is_safe = is_definite(MIN_CURVATURE, *H, *H_adjugate)
    step = from_columns(times(*H_adjugate, *axial(*G)))
    return step * (1.0 / np.where(is_safe, determinant(*H, *H_adjugate), 1.0))[:, None], is_safe

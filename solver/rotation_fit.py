# SPDX-License-Identifier: GPL-3.0-or-later
"""The rotation that fits a 3 x 3 matrix best (orthogonal Procrustes), for many at once.

R = argmax tr(R M) over SO(3), by Newton's method on SO(3) from a good guess: with G = R M,

    tr(exp([w]) G) ~ tr G + g.w - w'Hw/2,   g = axl(G - G'),   H = tr(G) I - (G + G')/2.

Where g vanishes and H is positive definite, R is the global maximum: H has the pairwise sums of the
signed singular values as eigenvalues. So the result is certified, and what Newton's method cannot
certify (reflections, rank 1, far-off guesses) gets a singular value decomposition.
"""

import numpy as np

NEWTON_STEPS = 8
ANGLE_TOLERANCE = 1e-6
"""radians; the step that is smaller is still applied and leaves an error of its square or less"""
MIN_CURVATURE = 1e-4
"""of det H over (tr G)^3, below which the maximum is not certified"""
_BLOCK = 4096  # matrices; a few times as many stay in the cache of a core


def fit_rotations(M, guess):
    """Return the best rotations of the matrices M.

    Parameters
    ----------
    M : (n,3,3) numpy array
    guess : (n,3,3) numpy array
        Rotations to start from.

    Returns
    -------
    R : (n,3,3) numpy array
        In SO(3), each maximising tr(R M).

    See Also
    --------
    svd_rotations : The same without a guess.
    """
    R = guess.copy()
    todo = np.arange(len(M))
    uncertified = []
    for _ in range(NEWTON_STEPS):
        if not len(todo):
            break
        step, is_safe = _newton_step(R[todo] @ M[todo])
        uncertified.append(todo[~is_safe])
        todo, step = todo[is_safe], step[is_safe]
        R[todo] = _cayley(step) @ R[todo]
        todo = todo[(step * step).sum(1) > ANGLE_TOLERANCE**2]
    others = np.concatenate([*uncertified, todo])
    R[others] = svd_rotations(M[others])
    return R


def svd_rotations(M):
    """Return argmax tr(R M) over SO(3) for each M, by singular value decompositions.

    Parameters
    ----------
    M : (n,3,3) numpy array

    Returns
    -------
    R : (n,3,3) numpy array

    See Also
    --------
    fit_rotations : Faster with a good guess.

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
    R = (U @ Vt).swapaxes(1, 2)
    mirrored = np.linalg.det(R) < 0.0
    U[mirrored, :, 2] *= -1.0
    R[mirrored] = (U[mirrored] @ Vt[mirrored]).swapaxes(1, 2)
    return R


def orthonormalize(R, steps=1):
    """Return R (n,3,3), almost rotations, without the rounding errors of many products.

    By steps of Newton and Schulz, R <- 1.5 R - 0.5 R R'R, on rows of a part that stays in the
    cache: a fifth of the time that products of small matrices take NumPy.
    """
    result = np.empty_like(R)
    for begin in range(0, len(R), _BLOCK):
        part = slice(begin, begin + _BLOCK)
        rows = np.ascontiguousarray(np.moveaxis(R[part], 0, 2))
        for _ in range(steps):
            rows = _newton_schulz(*rows)
        result[part] = np.moveaxis(rows, 2, 0)
    return result


def _newton_schulz(a, b, c):
    """Return the rows (3,3,n) after a step, from the rows (3,n) of n matrices."""
    aa, bb, cc = ((x * x).sum(axis=0) for x in (a, b, c))
    ab, ac, bc = ((x * y).sum(axis=0) for x, y in ((a, b), (a, c), (b, c)))
    products = aa * a + ab * b + ac * c, ab * a + bb * b + bc * c, ac * a + bc * b + cc * c
    return np.stack([1.5 * x - 0.5 * y for x, y in zip((a, b, c), products, strict=True)])


def _newton_step(G):
    """Return the rotation vectors (n,3) of the Newton steps and which of them are safe (n,)."""
    trace = G[:, 0, 0] + G[:, 1, 1] + G[:, 2, 2]
    a, b, c = trace - G[:, 0, 0], trace - G[:, 1, 1], trace - G[:, 2, 2]
    d = -0.5 * (G[:, 0, 1] + G[:, 1, 0])
    e = -0.5 * (G[:, 0, 2] + G[:, 2, 0])
    f = -0.5 * (G[:, 1, 2] + G[:, 2, 1])
    x, y, z = G[:, 1, 2] - G[:, 2, 1], G[:, 2, 0] - G[:, 0, 2], G[:, 0, 1] - G[:, 1, 0]
    # H = [[a d e] [d b f] [e f c]]; its adjugate
    A, B, C = b * c - f * f, a * c - e * e, a * b - d * d
    D, E, K = e * f - d * c, d * f - b * e, d * e - a * f
    determinant = a * A + d * D + e * E
    is_safe = (trace > 0.0) & (a > 0.0) & (C > 0.0) & (determinant > MIN_CURVATURE * trace**3)
    inverse = 1.0 / np.where(is_safe, determinant, 1.0)
    step = np.stack([A * x + D * y + E * z, D * x + B * y + K * z, E * x + K * y + C * z], axis=1)
    return step * inverse[:, None], is_safe


def _cayley(step):
    """Return the rotations (n,3,3) of the quaternions (1, step/2), normalised."""
    x, y, z = 0.5 * step.T
    s = 2.0 / (1.0 + x * x + y * y + z * z)
    R = np.empty((len(step), 3, 3))
    R[:, 0, 0] = 1.0 - s * (y * y + z * z)
    R[:, 1, 1] = 1.0 - s * (x * x + z * z)
    R[:, 2, 2] = 1.0 - s * (x * x + y * y)
    R[:, 0, 1], R[:, 1, 0] = s * (x * y - z), s * (x * y + z)
    R[:, 0, 2], R[:, 2, 0] = s * (x * z + y), s * (x * z - y)
    R[:, 1, 2], R[:, 2, 1] = s * (y * z - x), s * (y * z + x)
    return R

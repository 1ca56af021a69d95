# SPDX-License-Identifier: GPL-3.0-or-later
"""The turn of the form's frame at each vertex, so that it lies along its limb."""

import numpy as np
from scipy.spatial.transform import Rotation

from ..styles.cube import CUBE, Cube
from ..styles.forms import cube
from ..styles.symmetries import symmetries
from .swing import swung

_PIECES = 4  # that count at a vertex, those with the largest shares
_NONE = 1e-3  # share of limbs at a vertex that is none


def turns(limbs, Q, forms=(), form_of=None):
    """Return the rotations G (n,3,3): the frame of a vertex is Q G in place of Q.

    For a piece of a limb, G is the smallest rotation that takes it to where it would swing
    (`swing`); of one that was carried since, by C, it is G C'. Between pieces, and toward what is
    no limb, it is blended; of all turns that are equivalent for the form, those nearest to each
    other are.

    `limbs`: Limbs. `Q`: (n,3,3) or (1,3,3), the orientation of the form. `forms`: sequence of
    Polytope, empty for the cube. `form_of`: (n,) int, which of the forms each vertex has.
    """
    n = limbs.shares.shape[0]
    G = np.tile(np.eye(3), (n, 1, 1))
    rows = np.flatnonzero(np.asarray(limbs.shares.sum(axis=1)).ravel() > _NONE)
    if not len(rows):
        return G
    shares, at = _largest(limbs.shares[rows].toarray())
    for group, orientation, form in _groups(rows, Q, forms, form_of):
        G[rows[group]] = _blended(limbs, shares[group], at[group], orientation, form)
    return G


def _largest(shares):
    """Return the largest of shares (n,s), (n,1+k), and the pieces (n,1+k) that they are of.

    The first is what belongs to no limb, and its piece has the number s.
    """
    k = min(_PIECES, shares.shape[1])
    at = np.argsort(-shares, axis=1, kind="stable")[:, :k]
    top = np.take_along_axis(shares, at, axis=1)
    rest = np.maximum(1.0 - top.sum(axis=1, keepdims=True), 0.0)
    top = np.concatenate([rest, top], axis=1)
    top /= top.sum(axis=1, keepdims=True)
    return top, np.concatenate([np.full((len(at), 1), shares.shape[1]), at], axis=1)


def _groups(rows, Q, forms, form_of):
    """Yield which of the rows have one orientation and one form, with both."""
    numbers = np.zeros(len(rows), np.int64) if form_of is None else form_of[rows]
    orientation = np.zeros(len(rows), np.int64)
    distinct = Q
    if len(Q) > 1:
        flat = Q[rows].reshape(-1, 9)
        _, first, orientation = np.unique(flat, axis=0, return_index=True, return_inverse=True)
        distinct = Q[rows][first]
    keys, group = np.unique(
        np.column_stack([orientation.ravel(), numbers]), axis=0, return_inverse=True
    )
    for number, (which, form) in enumerate(keys):
        yield (
            np.flatnonzero(group.ravel() == number),
            distinct[which],
            forms[form] if forms else CUBE,
        )


def _blended(limbs, shares, at, Q, form):
    """Return the turns (k,3,3) of vertices with one orientation Q (3,3) and form."""
    own = limbs.all_carried.swapaxes(1, 2).copy()
    is_turned = limbs.directions.any(axis=1)
    directions = limbs.directions[is_turned]
    own[is_turned] = smallest_turns(directions, swung(directions @ Q.T, form) @ Q) @ own[is_turned]
    own = np.concatenate([own, np.eye(3)[None]])
    between = _between(own, Q, form)
    main = at[np.arange(len(at)), shares.argmax(axis=1)]
    step = np.einsum("kp,kpx->kx", shares, between[main[:, None], at])
    return Rotation.from_rotvec(step).as_matrix() @ own[main]


def _between(own, Q, form):
    """Return the rotation vectors (s,s,3) from each of the turns (s,3,3) to each other.

    Those to the nearest of the turns that are equivalent to the other.
    """
    body = cube() if isinstance(form, Cube) else form
    same = Q.T @ symmetries(body) @ Q
    images = np.einsum("gij,sjk->sgik", same, own)
    traces = np.einsum("sgij,tij->tsg", images, own)
    nearest = traces.argmax(axis=2)
    chosen = images[np.arange(len(own))[None, :], nearest]
    relative = np.einsum("tsij,tkj->tsik", chosen, own)
    vectors = Rotation.from_matrix(relative.reshape(-1, 3, 3)).as_rotvec()
    return vectors.reshape(len(own), len(own), 3)


def smallest_turns(a, b):
    """Return the smallest rotations (s,3,3) that take unit vectors a (s,3) to b (s,3)."""
    if not len(a):  # of which older SciPy makes no rotations
        return np.empty((0, 3, 3))
    axis, cosine = np.cross(a, b), (a * b).sum(axis=1)
    sine = np.linalg.norm(axis, axis=1)
    angle = np.arctan2(sine, cosine)
    return Rotation.from_rotvec(
        axis * (angle / np.where(sine > 1e-12, sine, 1.0))[:, None]
    ).as_matrix()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Which triangles are pieces of polygons that share no corner: how those are split is not seen."""

from functools import partial

import numpy as np
import scipy.sparse as sp


def are_apart(faces, F):
    """Return what maps pairs of triangles (k,2) to whether (k,) their polygons are apart, or None.

    `faces`: (m,) int the polygon that each of the triangles F (m,3) is a piece of; None if they are
    whole: triangles that share a corner are not looked at anyway.
    """
    if faces is None:
        return None
    corners = sp.csr_matrix((np.ones(F.size, bool), (np.repeat(faces, 3), F.ravel())))
    return partial(_share_none, corners, faces)


def _share_none(corners, faces, pairs):
    one, other = (corners[faces[each]] for each in pairs.T)
    return one.multiply(other).getnnz(axis=1) == 0

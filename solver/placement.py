# SPDX-License-Identifier: GPL-3.0-or-later
"""The rotation of a part as a whole, and how to take it back."""

import numpy as np

from .rotation_fit import svd_rotations


def turn_back(rest, U, has_pin):
    """Turn each free component back by its best-fit rotation about its centroid.

    Parameters
    ----------
    rest : RestMesh
    U : (n,3) float array
        Positions in the unit box.
    has_pin : (component_count,) bool array
        Components with a pinned vertex stay as they are.

    Returns
    -------
    (n,3) float array
        The positions after it.
    """
    weight = rest.placing
    if rest.component_count == 1:
        return U.copy() if has_pin[0] else _turned_back(rest.V, U, weight / weight.sum())
    label, count = rest.component, rest.component_count

    def sums(values):
        flat = values.reshape(len(values), -1)
        columns = [np.bincount(label, weight * flat[:, c], count) for c in range(flat.shape[1])]
        return np.stack(columns, axis=1)

    total = np.bincount(label, weight, count)[:, None]
    now, before = sums(U) / total, sums(rest.V) / total
    centred, target = U - now[label], rest.V - before[label]
    covariance = sums(centred[:, :, None] * target[:, None, :]).reshape(-1, 3, 3)
    back = svd_rotations(covariance)  # maximises tr(B sum (u - c) (v - c)')
    turned = np.einsum("nij,nj->ni", back[label], centred) + now[label]
    return np.where(has_pin[label][:, None], U, turned)


def _turned_back(V, U, share):
    """Do it for a single component, with the share (n,) of each vertex in its area."""
    centre = share @ U
    centred = U - centre
    covariance = (centred * share[:, None]).T @ (V - share @ V)
    return centred @ svd_rotations(covariance[None])[0].T + centre

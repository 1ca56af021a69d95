# SPDX-License-Identifier: GPL-3.0-or-later
"""The rotation of a part as a whole, and how to take it back."""

import numpy as np

from .rotation_fit import svd_rotations


def keep_rotation(rest, U, has_pin):
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
    U : (n,3) float array
    back : (component_count,3,3) float array
        The rotation of each component.
    """
    weight = rest.areas + 1e-300
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
    back[has_pin] = np.eye(3)
    turned = np.einsum("nij,nj->ni", back[label], centred) + now[label]
    turned[has_pin[label]] = U[has_pin[label]]
    return turned, back

# SPDX-License-Identifier: GPL-3.0-or-later
"""The orientation of the cube, or of another form, that best fits a shape."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from ..aliases import FloatArray
from ..errors import CubicCraftError
from ..inputs import instance, real_numbers, vectors
from ..styles.cube import cost, nearest_to_identity
from ..styles.polytope import Polytope
from .form_orientation import form_orientation
from .orientation_search import binned, super_fibonacci

SAMPLES = 100_000
"""rotations over SO(3), a 24th of which are distinct for a cube: about 5 degrees apart"""
CANDIDATES = 12
"""samples that are refined"""
BINS = 14
"""per unit; the search groups normals into cells of the sphere"""
SMOOTHING = 1e-4
"""of the absolute value, in radians; only the refinement needs a derivative"""


def auto_orient(normals: ArrayLike, areas: ArrayLike, form: Polytope | None = None) -> FloatArray:
    """Return the orientation whose axes best fit the normals.

    It minimizes ``sum_i a_i |Q n_i|_1`` over all rotations, by a search over evenly spread samples
    and descent from the best of them. Of the 24 equivalent rotations of a cube, it returns the
    one nearest to the identity. Another form has its own cost, ``sum_i a_i h(Q n_i)``, and its own
    symmetries.

    Parameters
    ----------
    normals : (n,3) numpy array
        Unit normals of the triangles, or zero. Vertex normals would not fit: those of a coarse
        mesh, such as a box with eight vertices, do not face the same way as its surface.
    areas : (n,) numpy array
        Their weights, not negative.
    form : Polytope, optional
        By default the cube.

    Returns
    -------
    Q : (3,3) numpy array
        Rotation that maps a vector into the frame of the cube; its rows are the cube's axes. Or
        into that of the form.

    Raises
    ------
    CubicCraftError
        An argument has another type or shape.

    See Also
    --------
    triangle_areas_and_normals : Computes both inputs.
    nearest_to_identity : Chooses among equivalent rotations.

    Notes
    -----
    The samples are super-Fibonacci spirals (Alexa, "Super-Fibonacci Spirals: Fast, Low-Discrepancy
    Sampling of SO(3)", CVPR 2022).

    Examples
    --------
    >>> import numpy as np
    >>> from solver import auto_orient
    >>> c, s = np.cos(0.3), np.sin(0.3)
    >>> axes = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])  # of a rotated box
    >>> Q = auto_orient(np.concatenate([axes, -axes]), np.ones(6))
    >>> np.allclose(Q, axes, atol=1e-3)
    True
    """
    normals, areas = vectors(normals, "the normals"), real_numbers(areas, "the areas")
    if areas.shape != (len(normals),):
        raise CubicCraftError(f"the areas must have the shape ({len(normals)},), not {areas.shape}")
    if form is not None:
        return form_orientation(normals, areas, instance(form, "form", Polytope))
    directions, weights = binned(normals, areas, BINS)
    if not len(directions):
        return np.eye(3)
    samples = _distinct(super_fibonacci(SAMPLES))
    costs = np.concatenate(
        [_costs(part, directions, weights) for part in np.array_split(samples, 32)]
    )
    starts = samples[np.argsort(costs, kind="stable")[:CANDIDATES]]
    refined = [_refined(Q, directions, weights) for Q in starts]
    refined.sort(key=lambda Q: _cost(Q, directions, weights))
    best = min(
        (_refined(Q, normals, areas) for Q in (*refined[:2], np.eye(3))),
        key=lambda Q: _cost(Q, normals, areas),
    )
    return nearest_to_identity(best)


def _cost(Q, normals, areas):
    return float(areas @ cost(normals @ Q.T))


def _costs(Qs, normals, areas):
    return np.abs(np.einsum("kij,nj->kin", Qs, normals)).sum(axis=1) @ areas


def _refined(Q, normals, areas):
    """Descend from Q; the absolute value is smoothed so that there is a gradient."""
    scale = areas.sum()

    def objective(w):
        R = Rotation.from_rotvec(w).as_matrix() @ Q
        x = normals @ R.T
        smooth = np.sqrt(x * x + SMOOTHING**2)
        # d/dw at w of sum smooth(x): x turns by dw x x, so the gradient is sum x x (x / smooth)
        torque = np.cross(x, x / smooth)
        return areas @ smooth.sum(axis=1) / scale, areas @ torque / scale

    for _ in range(4):  # the gradient is exact at w = 0 only, so start again from the result
        result = minimize(objective, np.zeros(3), jac=True, method="L-BFGS-B")
        Q = Rotation.from_rotvec(result.x).as_matrix() @ Q
    return Q


def _distinct(quaternions):
    """Return the matrices (k,3,3) of those nearest to the identity among their 24."""
    size = np.abs(quaternions)
    imaginary, real = size[:, :3], size[:, 3]
    others = np.maximum(
        np.maximum(imaginary.max(axis=1), size.sum(axis=1) / 2),
        np.maximum(real + imaginary.max(axis=1), np.sort(imaginary, axis=1)[:, 1:].sum(axis=1))
        / np.sqrt(2),
    )
    return Rotation.from_quat(quaternions[real >= others]).as_matrix()

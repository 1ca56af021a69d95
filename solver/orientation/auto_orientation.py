# SPDX-License-Identifier: GPL-3.0-or-later
"""The orientation of the cube, or of another form, that best fits a shape.

If the shape is the form itself, turned, no other orientation costs as little: with the areas of its
facets as weights, the cost is a mixed volume, which is least for equal bodies (Minkowski's first
inequality; Schneider, "Convex Bodies: The Brunn-Minkowski Theory", 2014, section 7.2).
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from ..aliases import FloatArray
from ..errors import CubicCraftError
from ..inputs import instance, real_numbers, vectors
from ..styles.clusters import binned
from ..styles.forms import cube
from ..styles.polytope import Polytope
from ..styles.symmetries import nearest_to_identity, symmetries

WORK, FINE_WORK = 1_000_000_000, 500_000
"""largest number of products of a vertex and a normal in the search, and in a step of a descent"""
SAMPLES = 30_000
"""rotations over SO(3): about 8 degrees apart; fewer if they would be too much work"""
FEWEST = 500
"""rotations, even if they are more work"""
PART = 200_000
"""products or traces at a time, so that they stay in the cache"""
CONSIDERED = 400
"""best samples; of those that are almost equivalent, only the first is refined"""
APART = 0.2, 0.02
"""radians between those that are refined, and between those that are refined again"""
CANDIDATES, FINALISTS = 16, 4
"""samples that are refined, and those of them that are refined again with more directions"""
OTHER_WORK = 20
"""products that take as long as the rest of the step with a normal"""
COARSE = 6
"""cells of the sphere per unit in the search"""
FINE = 1000, 30, 20, 14, 10
"""the same for the finalists: as many as are not too much work; with the first, only flat sides
become one direction"""
TEMPERATURES = 1e-2, 1e-3, 1e-4, 1e-5
"""of the smoothed maximum over the vertices, relative to the size of the form, one after the other;
with the last, the result is off by about 0.001 degrees"""
ASIDE = np.array([4e-3, -7e-3, 5e-3])
"""turn before each descent, in radians: between two equally good orientations there is no slope"""


def auto_orient(normals: ArrayLike, areas: ArrayLike, form: Polytope | None = None) -> FloatArray:
    """Return the orientation whose axes best fit the normals.

    It minimizes ``sum_i a_i h(Q n_i)`` over all rotations, where the cost h of the cube is |x|_1,
    by a search over evenly spread samples and descent from the best of them. Of the rotations that
    are equivalent for the form, it returns the one nearest to the identity.

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
        Rotation that maps a vector into the frame of the form; its rows are the form's axes.

    Raises
    ------
    CubicCraftError
        An argument has another type or shape.

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
    form = cube() if form is None else instance(form, "form", Polytope)
    coarse = binned(normals, areas, COARSE)
    if not len(coarse[0]):
        return np.eye(3)
    samples = _samples(len(coarse[0]), form)
    costs = _costs(samples, *coarse, form)
    starts = samples[np.argsort(costs, kind="stable")[:CONSIDERED]]
    starts = _apart(starts, form, APART[0])[:CANDIDATES]
    refined = [_refined(Q, *coarse, form, TEMPERATURES[:2]) for Q in starts]
    refined.sort(key=lambda Q: _cost(Q, *coarse, form))
    refined = _apart(np.array(refined), form, APART[1])[:FINALISTS]
    fine = _fine(normals, areas, form)
    finer = [_refined(Q, *fine, form, TEMPERATURES) for Q in (*refined, np.eye(3))]
    best = min((np.eye(3), *finer), key=lambda Q: _cost(Q, normals, areas, form))
    return nearest_to_identity(best, form)


def _samples(directions, form):
    """Return rotations (k,3,3), of all equivalent ones only those nearest to the identity."""
    same = symmetries(form)
    affordable = WORK * len(same) // (directions * len(form.vertices))
    count = max(min(SAMPLES, affordable), FEWEST)
    samples = Rotation.from_quat(_super_fibonacci(count)).as_matrix()
    parts = np.array_split(samples, count * len(same) // PART + 1)
    return np.concatenate([part[_is_nearest(part, same)] for part in parts])


def _is_nearest(Qs, same):
    """Return which rotations (k,3,3) are nearest to the identity of those that are equivalent."""
    traces = Qs.reshape(-1, 9) @ same.swapaxes(1, 2).reshape(-1, 9).T  # of S Q
    return traces[:, 0] >= traces.max(axis=1) - 1e-12


def _apart(Qs, form, angle):
    """Return those of the rotations (k,3,3) that are not almost equivalent to earlier ones."""
    same, kept = symmetries(form), []
    is_left = np.ones(len(Qs), bool)
    while is_left.any():
        Q = Qs[is_left.argmax()]
        kept.append(Q)
        traces = Qs.reshape(-1, 9) @ (same @ Q).reshape(-1, 9).T
        is_left &= traces.max(axis=1) < 1.0 + 2.0 * np.cos(angle)
    return kept


def _fine(normals, areas, form):
    *more, least = FINE
    for bins in more:
        found = binned(normals, areas, bins)
        if len(found[0]) * (len(form.vertices) + OTHER_WORK) <= FINE_WORK:
            return found
    return binned(normals, areas, least)


def _costs(Qs, normals, areas, form):
    vertices = (form.vertices @ Qs).astype(np.float32)
    directions, weights = normals.T.astype(np.float32), areas.astype(np.float32)
    parts = np.array_split(vertices, vertices[..., 0].size * len(normals) // PART + 1)
    return np.concatenate([(part @ directions).max(axis=1) @ weights for part in parts])


def _cost(Q, normals, areas, form):
    parts = len(normals) * len(form.vertices) // PART + 1
    pairs = zip(np.array_split(normals, parts), np.array_split(areas, parts), strict=True)
    return sum(float(a @ form.cost(n @ Q.T)) for n, a in pairs)


def _refined(Q, normals, areas, form, temperatures):
    vertices, weights = form.vertices / form.radius, areas / areas.sum()
    for temperature in temperatures:
        Q = _descended(Q, normals, weights, vertices, temperature)
    return Q


def _descended(Q, normals, weights, vertices, temperature):
    def objective(w):
        x = normals @ (Rotation.from_rotvec(w).as_matrix() @ Q).T
        heights = x @ vertices.T
        largest = heights.max(axis=1)
        shares = np.exp((heights - largest[:, None]) / temperature)
        sums = shares.sum(axis=1)
        smooth = largest + temperature * np.log(sums)
        # x turns by dw x x, and its cost changes as that of s.x, with s the mean of the vertices
        torque = np.cross(x, shares @ vertices / sums[:, None])
        return weights @ smooth, weights @ torque @ _left_jacobian(w)

    result = minimize(objective, ASIDE, jac=True, method="L-BFGS-B")
    return Rotation.from_rotvec(result.x).as_matrix() @ Q


def _left_jacobian(w):
    """Return J (3,3): if the rotation vector w changes by dw, it turns further by J dw."""
    angle = np.linalg.norm(w)
    if angle < 1e-6:
        return np.eye(3)
    W = np.cross(np.eye(3), w)
    return (
        np.eye(3)
        + (1.0 - np.cos(angle)) / angle**2 * W
        + (angle - np.sin(angle)) / angle**3 * W @ W
    )


def _super_fibonacci(count):
    """Return evenly spread unit quaternions (count,4), scalar last."""
    s = np.arange(count) + 0.5
    a, b = 2 * np.pi * s / np.sqrt(2), 2 * np.pi * s / 1.533751168755204288
    r, t = np.sqrt(s / count), np.sqrt(1 - s / count)
    return np.stack([r * np.sin(a), r * np.cos(a), t * np.sin(b), t * np.cos(b)], axis=1)

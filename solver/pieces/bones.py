# SPDX-License-Identifier: GPL-3.0-or-later
"""The bones that move a mesh, which say what its limbs are."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..aliases import FloatArray, IntArray
from ..rotation_fit import svd_rotations
from ..values import is_same
from .placement import Placement
from .whole import Whole

if TYPE_CHECKING:  # SciPy is loaded when it is needed, not for its names
    from ..limbs import KnownLimbs

SAME = 1e-4
"""of the rig: bones nearer to each other than that are one"""


class BonePlaces(NamedTuple):
    """The deform bones of a mesh in the rest pose, as plain values that can be compared."""

    groups: tuple[str, ...]
    """names of the bones and of their vertex groups"""
    ends: tuple[float, ...]
    """x, y, z of the head and of the tail of each, in the coordinates of the mesh"""
    parents: tuple[int, ...]
    """-1 for none"""

    @property
    def arrays(self) -> tuple[FloatArray, FloatArray, IntArray]:
        """Heads (b,3), tails (b,3) and parents (b,)."""
        ends = np.reshape(self.ends, (-1, 2, 3))
        return ends[:, 0], ends[:, 1], np.array(self.parents, dtype=int)

    @property
    def tolerance(self) -> float:
        """Distance of bones that are one."""
        return SAME * float(np.ptp(np.reshape(self.ends, (-1, 3)), axis=0).max())


class Weights(NamedTuple):
    """Those of the vertex groups of bones, k of them that are not 0."""

    vertex: IntArray
    """(k,) int"""
    bone: IntArray
    """(k,) int"""
    weight: FloatArray
    """(k,)"""


@dataclass(frozen=True, eq=False)
class Bones:
    """The bones of a mesh with their weights, as plain values."""

    places: BonePlaces
    weights: Weights
    whole: Whole
    placed: FloatArray
    """(N,3) the shape in the rest pose with its images, where the object is solved alone"""
    alone: Placement
    pose: tuple[float, ...] | None = None
    """for each bone, the 16 numbers of the map of the object's coordinates from the rest pose"""

    def is_like(self, other: "Bones | None") -> bool:
        """Return whether both have the same bones and weights."""
        if other is None:
            return False
        return is_same((self.places, self.weights), (other.places, other.weights))

    @cached_property
    def limbs(self) -> "KnownLimbs":
        """The limbs in the rest pose, of all vertices (N,), where the object is solved alone."""
        from ..limbs import limbs_of_bones

        heads, tails, parents = self._all.ends_and_parents
        heads, tails = self.alone.place(heads), self.alone.place(tails)
        return limbs_of_bones(self.placed, self._all.weights, heads, tails, parents)

    @cached_property
    def _all(self):
        return _Images(self.places, self.weights, self.whole)

    def limbs_at(self, placement: Placement) -> "KnownLimbs":
        """Return the limbs in the present pose, in the coordinates of a placement."""
        limbs, A = self.limbs, self.alone.linear
        if self.pose is not None:
            maps = self._all.of_pose(np.reshape(self.pose, (-1, 4, 4)))[:, :3, :3]
            maps = A @ maps @ np.linalg.inv(A)
            limbs = limbs.turned(svd_rotations(maps.swapaxes(1, 2)))
        if placement.shape_key != self.alone.shape_key:
            from ..limbs import placed_limbs

            U, _, Vt = np.linalg.svd(placement.linear @ np.linalg.inv(A))
            limbs = placed_limbs(limbs, np.asarray(U @ Vt, dtype=np.float64))
        return limbs

    def in_pose(self, pose: tuple[float, ...] | None) -> "Bones":
        """Return the same, with the limbs that were found, in another pose."""
        other = replace(self, pose=pose)
        other.__dict__.update({name: getattr(self, name) for name in ("_all", "limbs")})
        return other


class _Images:
    """Bones with those of the images that a Mirror modifier adds, s of them.

    `ends_and_parents`: heads (s,3), tails (s,3) and parents (s,). `weights`: (N,s) csr_matrix.
    """

    def __init__(self, places: BonePlaces, weights: Weights, whole: Whole):
        from scipy.sparse import csr_matrix

        heads, tails, parents = places.arrays
        count = total = len(heads)
        n = int(whole.source.max(initial=-1)) + 1
        own = csr_matrix((weights.weight, (weights.vertex, weights.bone)), shape=(n, count))
        every = whole.everywhere(own)
        found, blocks = [(heads, tails, parents)], []
        self._maps, self._bone = [np.eye(4)] * count, list(range(count))
        for is_image, matrix in whole.elements():
            images = moved(heads, matrix), moved(tails, matrix)
            place = _places_among(heads, tails, images, places.tolerance)
            new = np.flatnonzero(place < 0)
            place[new] = total + np.arange(len(new))
            total += len(new)
            linked = np.where(parents >= 0, place[parents], -1)
            found.append((images[0][new], images[1][new], linked[new]))
            self._maps += [matrix] * len(new)
            self._bone += new.tolist()
            rows = np.flatnonzero(is_image)
            block = every[rows].tocoo()
            blocks.append((block.data, rows[block.row], place[block.col]))
        data, rows, columns = (np.concatenate(part) for part in zip(*blocks, strict=True))
        self.weights = csr_matrix((data, (rows, columns)), shape=(len(whole.source), total))
        self.ends_and_parents = tuple(np.concatenate(part) for part in zip(*found, strict=True))

    def of_pose(self, pose):
        """Return the maps (s,4,4) of a pose of the bones (b,4,4)."""
        return np.array(
            [
                M @ pose[bone] @ np.linalg.inv(M)
                for M, bone in zip(self._maps, self._bone, strict=True)
            ]
        )


def _places_among(heads, tails, images, tolerance):
    """Return the number (b,) of the bone that lies where each image does, or -1."""
    apart = np.abs(images[0][:, None] - heads) + np.abs(images[1][:, None] - tails)
    is_same = apart.max(axis=2) <= tolerance
    own = np.arange(len(heads))
    nearest = np.where(is_same[own, own], own, is_same.argmax(axis=1))
    return np.where(is_same.any(axis=1), nearest, -1)


def moved(points: FloatArray, matrix: FloatArray) -> FloatArray:
    """Return points (...,3) where a matrix (4,4) takes them."""
    return points @ matrix[:3, :3].T + matrix[:3, 3]

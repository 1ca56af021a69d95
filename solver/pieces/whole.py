# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole of a half-modeled mesh: the part that the Mirror modifier adds is solved with it.

The other half then exists when links are searched, and the seam lies in the middle of a surface,
not at its border.
"""

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from ..aliases import BoolArray, FloatArray, IntArray, RealArray
from ..surface.symmetry import MATCHING, NO_PARTNER, Mirror, commuting, partners
from .reflection import Reflection, flip

_LEAST_TOLERANCE = 1e-6  # of the largest extent: vertices closer to the plane than this lie in it


class Whole:
    """A mesh with its reflections, and the vertices that are images of each other.

    `original`: (n,3), object coordinates. `triangles`: (m,3) int. `reflections`: reflections to
    add: the first of the mesh, the second of both, and so on. `symmetry`: about which axes of the
    object the mesh itself is to be symmetric. `face_of`: (m,) int, the face of the mesh that each
    triangle is a piece of. `added`: tuple of Reflection, those that commute with each other, by
    which it grows. `mirrored`: tuple of Reflection, all about which it is to stay symmetric.
    """

    def __init__(
        self,
        original: RealArray,
        triangles: IntArray,
        reflections: Sequence[Reflection] = (),
        symmetry: Sequence[bool] = (False, False, False),
        face_of: IntArray | None = None,
    ):
        self._original, self._triangles, self._face_of = original, triangles, face_of
        self.reflections = reflections
        points = original.astype(np.float64)
        self._size = float(np.ptp(points, axis=0).max()) if len(points) else 1.0
        self.added = tuple(
            one
            for number, one in enumerate(reflections)
            if all(one.commutes_with(other) for other in reflections[:number])
        )
        flips = [flip(axis) for axis in range(3) if symmetry[axis]]
        self._asked = tuple(
            one
            for one in flips
            if not any(one.is_like(other) for other in self.added)
            and all(one.commutes_with(other) for other in self.added)
        )
        self.mirrored = self.added + self._asked
        least = _LEAST_TOLERANCE * self._size
        self._is_inside = [one.is_in_plane(points, least) for one in self.added]
        self._number(len(points))

    def _number(self, count):
        """Assign a number to each image; those that coincide get the same number."""
        own = np.arange(count)
        self._numbers = np.empty((2 ** len(self.added), count), dtype=np.intp)
        self._numbers[0] = own
        sources, elements, total = [own], [np.zeros(count, dtype=np.intp)], count
        for element in range(1, len(self._numbers)):
            same = np.full(count, element)
            for bit, is_inside in enumerate(self._is_inside):
                same[is_inside] &= ~(1 << bit)
            is_new = same == element
            fresh = np.flatnonzero(is_new)
            self._numbers[element] = self._numbers[same, own]
            self._numbers[element, fresh] = total + np.arange(len(fresh))
            total += len(fresh)
            sources.append(fresh)
            elements.append(np.full(len(fresh), element))
        self._source, self._element = np.concatenate(sources), np.concatenate(elements)

    @property
    def source(self) -> IntArray:
        """(N,) int vertex of the mesh that each is an image of; the first n are themselves."""
        return self._source

    @property
    def faces(self) -> IntArray | None:
        """(M,) int the face that each triangle is a piece of, or its image, or None."""
        return self._triangles_and_faces[1]

    def everywhere(self, values: Any) -> Any:
        """Return values (n,...) of the mesh, an array or csr_matrix, at all vertices (N,...)."""
        return values[self._source]

    def beyond_handles(self, handle_of: IntArray) -> IntArray:
        """Return which handle (n,) takes each vertex along, those around held vertices included."""
        return handle_of

    @cached_property
    def triangles(self) -> IntArray:
        """(M,3) int triangles of the whole."""
        return self._triangles_and_faces[0]

    @cached_property
    def _triangles_and_faces(self):
        F, count = self._triangles, len(self._triangles)
        face_of = np.arange(count) if self._face_of is None else self._face_of
        found, faces = [F], [face_of]
        for element in range(1, len(self._numbers)):
            images = self._numbers[element][F]
            if bin(element).count("1") % 2:
                images = images[:, ::-1]
            is_new = (images >= len(self._original)).any(axis=1)  # one in the plane is its own
            found.append(images[is_new])
            faces.append(count * element + face_of[is_new])
        are_whole = self._face_of is None
        return np.concatenate(found), None if are_whole else np.concatenate(faces)

    def images(self, points: FloatArray) -> FloatArray:
        """Return points (n,3) of the mesh, float64, with their images (N,3)."""
        result = points[self._source].astype(np.float64)
        for bit, reflection in enumerate(self.added):
            is_reflected = (self._element >> bit & 1).astype(bool)
            result[is_reflected] = reflection.image(result[is_reflected])
        return result

    def elements(self) -> Iterator[tuple[BoolArray, FloatArray]]:
        """Yield the vertices (N,) and the map (4,4) of each image of the mesh."""
        for element in range(len(self._numbers)):
            matrix = np.eye(4)
            for bit, reflection in enumerate(self.added):
                if element >> bit & 1:
                    matrix = reflection.matrix @ matrix
            yield self._element == element, matrix

    @cached_property
    def own_partners(self) -> tuple[Mirror, ...]:
        """For each requested axis, the partner (n,) of each vertex of the mesh."""
        points = self._original.astype(np.float64)
        tolerance = MATCHING * self._size
        found = [one.mirror(partners(points, one.image(points), tolerance)) for one in self._asked]
        return commuting(found)

    @cached_property
    def partners(self) -> list[IntArray]:
        """For each of `mirrored`, the partner (N,) of each vertex of the whole."""
        found = []
        for bit in range(len(self.added)):
            found.append(self._numbers[self._element ^ 1 << bit, self._source])
        for mirror in self.own_partners:
            partner = np.append(mirror.partner, NO_PARTNER)[self._source]
            there = self._numbers[self._element, np.maximum(partner, 0)]
            found.append(np.where(partner >= 0, there, NO_PARTNER))
        return found

    def sides(self) -> IntArray:
        """Return on which side of each of `mirrored` each vertex (N,) is, as bits of a number."""
        sides = self._element.copy()
        points = self._original[self._source]
        for number, reflection in enumerate(self._asked, start=len(self.added)):
            axis = reflection.linear[::4].index(-1.0)
            sides |= (points[:, axis] < 0.0).astype(np.intp) << number
        return sides

    def symmetrize(self, positions: FloatArray, is_held: BoolArray) -> None:
        """Make new positions (n,3) of the mesh exactly symmetric, in place.

        Vertices in the plane of a modifier keep their distance from it, which merges the
        halves. Held vertices (n,) do not move.
        """
        for reflection, is_inside in zip(self.added, self._is_inside, strict=True):
            inside = np.flatnonzero(is_inside & ~is_held)
            normal = reflection.normal
            if np.abs(normal).max() == 1.0:
                axis = int(np.abs(normal).argmax())
                positions[inside, axis] = self._original[inside, axis]
            else:
                off = (self._original[inside] - positions[inside].astype(np.float64)) @ normal
                positions[inside] += off[:, None] * normal
        for mirror in self.own_partners:
            mirror.without(is_held).impose(positions)

    def settle_rotations(self, rotations: FloatArray, is_held: BoolArray) -> None:
        """Make rotations (n,3,3) of the vertices of the mesh symmetric, in place."""
        for mirror in self.own_partners:
            mirror.without(is_held).impose_rotations(rotations)

    def suits(self, points: RealArray) -> bool:
        """Return whether partners are images of each other at other positions (n,3), too."""
        reach = 2.0 * MATCHING * self._size
        return all(mirror.suits(points, reach) for mirror in self.own_partners)

    @property
    def matching(self) -> int | None:
        """Number of vertices that have a partner about every requested axis, or None."""
        if not self._asked:
            return None
        have = np.all([mirror.partner >= 0 for mirror in self.own_partners], axis=0)
        return int(np.count_nonzero(have))

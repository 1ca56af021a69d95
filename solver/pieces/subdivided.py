# SPDX-License-Identifier: GPL-3.0-or-later
"""A cage whose smooth surface is solved in its place, and which is fitted to the result."""

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from ..aliases import BoolArray, FloatArray, IntArray, RealArray
from ..mesh.catmull_clark import Cage, catmull_clark
from ..surface.symmetry import NO_PARTNER, partners
from .cage_fit import CageFit
from .reflection import Reflection
from .whole import Whole

LEVELS = 2
"""of subdivision, whatever the modifier shows: more hardly change where the surface faces,..."""
MOST = 16_000
"""...or one, if they would make more vertices"""
_SAME = 1e-9  # of random numbers


class Subdivided(Whole):
    """The smooth surface of a mesh with its reflections.

    The mesh is the cage, of n vertices; `source` and all that is indexed by N are of the surface,
    which begins with the vertices of the cage and their images.

    `original`, `triangles`, `reflections`, `symmetry`: as for `Whole`. `cage`: the faces of the
    mesh.
    """

    def __init__(
        self,
        original: RealArray,
        triangles: IntArray,
        reflections: Sequence[Reflection],
        symmetry: Sequence[bool],
        cage: Cage,
    ):
        super().__init__(original, triangles, reflections, symmetry)
        self._cage = cage
        whole = self._with_images(cage)
        self._edges, self._faces = whole.edges, whole.faces
        self._smooth, self._flat, self._surface = _subdivided(whole)
        self._nearest = np.asarray(self._flat.argmax(axis=1)).ravel()
        self._fit: CageFit | None = None

    def _with_images(self, cage):
        """Return the cage of the mesh with its images; a face in the plane is its own."""
        place, faces = np.arange(len(cage.corners)), cage.faces
        end = np.cumsum(cage.sizes)
        backward = (end + end - cage.sizes - 1)[faces] - place
        sizes, corners = [cage.sizes], [cage.corners]
        for element in range(1, len(self._numbers)):
            images = self._numbers[element][cage.corners]
            if bin(element).count("1") % 2:
                images = images[backward]
            is_new = np.bincount(faces, images >= len(cage.stiffness), len(cage.sizes)) > 0.0
            sizes.append(cage.sizes[is_new])
            corners.append(images[is_new[faces]])
        return Cage(
            np.concatenate(sizes),
            np.concatenate(corners),
            np.concatenate([numbers[cage.creases] for numbers in self._numbers]),
            np.tile(cage.sharpness, len(self._numbers)),
            cage.stiffness[self._source],
            cage.keeps_corners,
        )

    @property
    def source(self) -> IntArray:
        """(N,) int vertex of the mesh nearest to each."""
        return self._source[self._nearest]

    @cached_property
    def triangles(self) -> IntArray:
        """(M,3) int triangles of the whole.

        Quads are cut from their old vertex, so that those of mirrored faces are mirrored.
        """
        return self._surface.corners.reshape(-1, 4)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)

    @property
    def faces(self) -> IntArray:
        """(M,) int the face of the cage, or of its images, that each triangle is a piece of."""
        return np.repeat(self._faces, len(self.triangles) // len(self._faces))

    def everywhere(self, values: Any) -> Any:
        """Return values (n,...) of the mesh at all vertices (N,...).

        Numbers are interpolated. A truth holds, and a whole number counts, where it does at all
        that a vertex lies between; else it is -1.
        """
        own = values[self._source]
        if own.dtype.kind == "f":
            return self._flat @ own
        corners = own[self._flat.indices], self._flat.indptr[:-1]
        if own.dtype.kind == "b":
            return np.logical_and.reduceat(*corners)
        least = np.minimum.reduceat(*corners)
        return np.where(least == np.maximum.reduceat(*corners), least, -1)

    def images(self, points: RealArray) -> FloatArray:
        """Return the surface (N,3) of points (n,3) of the mesh."""
        return self._smooth @ self.cage(points)

    def elements(self) -> Iterator[tuple[BoolArray, FloatArray]]:
        """Yield the vertices (N,) and the map (4,4) of each image of the mesh."""
        for is_image, matrix in super().elements():
            yield is_image[self._nearest], matrix

    @cached_property
    def partners(self) -> list[IntArray]:
        """For each of `mirrored`, the partner (N,) of each vertex of the whole.

        Which vertices lie between partners of the same is told by random numbers at these.
        """
        random = np.random.default_rng(0)
        codes, others = random.random((2, len(self._source), 3))
        own, found = self._flat @ codes, []
        for partner in super().partners:
            there = np.where((partner == NO_PARTNER)[:, None], others, codes[partner])
            found.append(partners(own, self._flat @ there, _SAME))
        return found

    def sides(self) -> IntArray:
        """Return on which side of each of `mirrored` each vertex (N,) is, as bits of a number."""
        return super().sides()[self._nearest]

    def beyond_handles(self, handle_of: IntArray) -> IntArray:
        """Return which handle (n,) takes each vertex along, those around held vertices included.

        The surface between held vertices depends on those around them, too.
        """
        faces, corners = self._cage.faces, self._cage.corners
        of_face = np.full(len(self._cage.sizes), -1)
        np.maximum.at(of_face, faces, handle_of[corners])
        around = np.full(len(handle_of), -1)
        np.maximum.at(around, corners, of_face[faces])
        return np.where(handle_of < 0, around, handle_of)

    def cage(self, points: RealArray) -> FloatArray:
        """Return points (n,3) of the mesh, float64, with their images (k,3)."""
        return super().images(points)  # pyright: ignore[reportArgumentType]

    def fitted(
        self, surface: FloatArray, at_rest: FloatArray, goal: FloatArray, is_held: BoolArray
    ) -> FloatArray:
        """Return the mesh (n,3) whose surface is nearest to a given one (N,3).

        `at_rest`, `goal`: (k,3), the `cage` at rest, and where held vertices go. `is_held`: (n,)
        bool.
        """
        fit, held = self._fit, is_held[self._source]
        if fit is None or not fit.serves(at_rest, held):
            fit = self._fit = CageFit(self._smooth, self._edges, self._surface.edges, at_rest, held)
        return fit(surface, goal)[: len(is_held)]


def _subdivided(cage):
    """Return the maps of `catmull_clark` for all levels together, and the finer cage."""
    levels = LEVELS if cage.count(LEVELS) <= MOST else 1
    smooth, flat, cage = catmull_clark(cage)
    for _ in range(1, levels):
        S, T, cage = catmull_clark(cage)
        smooth, flat = S @ smooth, T @ flat
    return smooth, flat.tocsr(), cage

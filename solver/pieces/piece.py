# SPDX-License-Identifier: GPL-3.0-or-later
"""One object, placed where it is solved."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..aliases import BoolArray, FloatArray, IntArray
from ..mesh.rest_measures import triangle_areas_and_normals
from ..values import described
from .bones import Bones
from .handle_pose import HandlePose, targets
from .placement import Placement
from .shape import Shape
from .subdivided import Subdivided
from .whole import Whole

LEFT = 0.9
"""of the change of the normals: with more left to do, the cage has not followed"""
LEAST = np.radians(5.0)
"""root mean square of that change; less is hardly seen"""


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Piece:
    """An object with its handles, regions and symmetry, as plain values.

    `piece_of` makes one. It has n vertices. With those that its mirrors add, which follow them, N
    are solved.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import piece_of
    >>> V, F = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]])
    >>> stretched = piece_of(V, F, matrix=np.diag([2.0, 1, 1, 1]))
    >>> stretched.V.tolist()
    [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    """

    name: str
    """for messages"""
    shape: Shape
    whole: Whole
    """the shape with the vertices that mirrors add"""
    placement: Placement
    handles: Sequence[HandlePose]
    handle_of: IntArray
    """(n,) int, the number of the handle of each vertex, or -1"""
    rest_weights: FloatArray | None = None
    """(n,) weights of the vertices far from moved handles; None if all may move"""
    map_weights: FloatArray | float = 1.0
    """(n,) factors of the cubeness, or one for all"""
    detail_weights: FloatArray | float = 1.0
    """(n,) factors of the strength of details, or one for all"""
    region_shares: FloatArray | None = None
    """(n,1+k) shares of the object's own style and of each of its k regions; None for k = 0"""
    bones: Bones | None = None
    """what moves it; None if limbs are found from the shape"""
    seconds: float = 0.0
    """time to read it"""

    def __repr__(self) -> str:
        names = ("name", "vertices", "triangles")
        return described(type(self), [(name, getattr(self, name)) for name in names])

    @property
    def vertices(self) -> int:
        """Number of vertices n."""
        return len(self.shape.original)

    @property
    def solved(self) -> int:
        """Number N of vertices that are solved."""
        return len(self.whole.source)

    @property
    def triangles(self) -> int:
        """Number of triangles."""
        return len(self.shape.triangles)

    def everywhere(self, values: ArrayLike) -> NDArray[Any]:
        """Return values (n,...) of the vertices, or one for all, at all that are solved (N,...)."""
        every = np.broadcast_to(values, (self.vertices, *np.shape(values)[1:]))
        return self.whole.everywhere(every)

    @property
    def V(self) -> FloatArray:  # noqa: N802 - the field's name
        """(N,3) positions at rest, where it is solved."""
        return self.placement.place(self.whole.images(self.shape.original))

    @property
    def F(self) -> IntArray:  # noqa: N802 - the field's name
        """(M,3) int triangles, whose normals point outward where it is solved."""
        F = self.whole.triangles
        return F[:, ::-1] if self.placement.is_mirrored else F

    @property
    def targets(self) -> FloatArray:
        """(N,3) where handles take the vertices, where it is solved."""
        handle_of = self.whole.beyond_handles(self.handle_of)
        own = targets(self.shape.original, handle_of, self.handles)
        return self.placement.place(self.whole.images(own))

    @property
    def is_held(self) -> BoolArray:
        """(n,) bool, the vertices that handles hold exactly."""
        is_exact = [not handle.is_cubic for handle in self.handles]
        return np.array([*is_exact, False])[self.handle_of]  # the last is of those in none

    @property
    def is_still(self) -> BoolArray:
        """(n,) bool, the vertices that should not change.

        Those where the map is 0. If a handle is posed, there are none: the rest should follow.
        """
        if any(handle.is_moved for handle in self.handles):
            return np.zeros(self.vertices, dtype=bool)
        return np.broadcast_to(np.asarray(self.map_weights) == 0.0, self.vertices)

    @property
    def may_lose_symmetry(self) -> bool:
        """Whether regions or a moved handle may make it other than its rest shape is."""
        is_moved = any(handle.is_moved for handle in self.handles)
        return is_moved or self.region_shares is not None

    def read_back(
        self,
        positions: FloatArray,
        rotations: FloatArray | None,
        at_rest: FloatArray,
        is_held: BoolArray,
        *,
        is_idle: bool = False,
    ) -> tuple[FloatArray, Any]:
        """Return a result, (n,3) and (n,3,3) or None, in the coordinates of the object.

        `positions`, `at_rest`: (N,3), of the result and before, where it was solved. `rotations`:
        (N,3,3), or None. `is_held`: (N,) bool. `is_idle`: whether nothing was to change.
        """
        n = self.vertices
        # Held vertices must not move by rounding errors of the placement.
        is_still = (positions[:n] == at_rest[:n]).all(axis=1) | is_idle
        is_held = is_held[:n]
        own = self._mesh_of(positions, is_held | is_still).astype(self.shape.original.dtype)
        own[is_still] = self.shape.original[is_still]
        self.whole.symmetrize(own, is_held | is_still)
        if rotations is None:
            return own, None
        turned = self.placement.read_rotations_back(rotations[:n])
        self.whole.settle_rotations(turned, is_held)
        return own, turned

    def _mesh_of(self, positions, is_held):
        """Return the mesh (n,3) of solved positions (N,3); held vertices of a cage are given."""
        if isinstance(self.whole, Subdivided):
            goal = targets(self.shape.original, self.handle_of, self.handles)
            at_rest = self.placement.place(self.whole.cage(self.shape.original))
            goal = self.placement.place(self.whole.cage(goal))
            positions = self.whole.fitted(positions, at_rest, goal, is_held)
        return self.placement.read_back(positions[: self.vertices])


P = TypeVar("P", bound=Piece)


def parts_of(pieces: Sequence[P]) -> Iterator[tuple[P, slice]]:
    """Yield pieces that are solved together, each with its part of the arrays (N,...) of all.

    The part begins with the vertices of the piece itself; those that its mirrors add follow.
    """
    end = 0
    for piece in pieces:
        begin, end = end, end + piece.solved
        yield piece, slice(begin, end)


def is_stiff(piece: Piece, positions: FloatArray, own: FloatArray) -> bool:
    """Return whether a piece is a cage that does not follow its result.

    It has so few vertices that their smooth surface cannot become what was solved: however the 8
    corners of a cube are moved, the ball that is seen of it stays round.

    `positions`: (N,3), the result, where it was solved. `own`: (n,3), the mesh that was read back
    from it.
    """
    whole = piece.whole
    if not isinstance(whole, Subdivided):
        return False
    rest, now = (whole.images(mesh.astype(np.float64)) for mesh in (piece.shape.original, own))
    shapes = rest, piece.placement.read_back(positions), now
    found = (triangle_areas_and_normals(U, whole.triangles) for U in shapes)
    (area, before), (_, wanted), (_, after) = found
    change, left = (area @ ((n - wanted) ** 2).sum(axis=1) for n in (before, after))
    return bool(change > LEAST**2 * area.sum() and left > LEFT * change)

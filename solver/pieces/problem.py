# SPDX-License-Identifier: GPL-3.0-or-later
"""What is solved at once: one piece, or several that are kept together."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, cast

import numpy as np

from ..aliases import BoolArray, FloatArray
from ..errors import CubicCraftError
from ..inputs import instance, instances
from ..surface.symmetry import NO_PARTNER, Mirror
from ..values import described
from .floor import Floor
from .holds import Hold, holds_of
from .joined_style import joined_style
from .piece import P, Piece, parts_of
from .subdivided import Subdivided
from .symmetry import common_planes, even_planes, suits

if TYPE_CHECKING:  # SciPy is loaded when it is needed, not for its names
    from ..iteration.options import SolverOptions
    from ..iteration.pose import Pose
    from ..iteration.setup import Setup
    from ..iteration.stylization import Stylization
    from ..proxy.options import ProxyOptions
    from ..styles.style import Style


@dataclass(frozen=True, eq=False, repr=False)
class Problem(Generic[P]):
    """Pieces that `join_pieces` has joined, and all that is computed once per shape and handles.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import ball, join_pieces, piece_of
    >>> V, F = ball()
    >>> pieces = [piece_of(V, F, name="head"), piece_of(0.2 * V - [0, 1, 0], F, name="eye")]
    >>> problem = join_pieces(pieces)
    >>> problem.name, problem.vertices, problem.components
    ('"head" and "eye"', 1400, 2)
    """

    pieces: tuple[P, ...]
    setup: Setup
    is_still: BoolArray
    """(N,) bool, the vertices that should not change, which the setup was made with"""
    without_holds: Setup
    """the setup before groups were held"""
    holds: Sequence[Hold]
    seconds: float
    """time to read and factorize"""
    planes: Sequence[Mirror] | None = None
    """about which the pieces are symmetric at rest, see `symmetry.py`; None if not asked"""

    def __repr__(self) -> str:
        names = ("name", "vertices", "triangles", "components")
        return described(Problem, [(name, getattr(self, name)) for name in names])

    @property
    def name(self) -> str:
        """The names of the pieces, for messages."""
        return listed([piece.name for piece in self.pieces])

    @property
    def vertices(self) -> int:
        """Number of vertices."""
        return sum(piece.vertices for piece in self.pieces)

    @property
    def triangles(self) -> int:
        """Number of triangles."""
        return sum(piece.triangles for piece in self.pieces)

    @cached_property
    def _floor(self):
        return Floor(self.setup, self.pieces[0].placement.up)

    @property
    def components(self) -> int:
        """Number of connected parts, loose vertices not counted."""
        return sum(piece.shape.components for piece in self.pieces)

    @property
    def style(self) -> Style:
        """What the vertices of all pieces are turned toward."""
        return joined_style(self.pieces)

    @property
    def pose(self) -> Pose:
        """Where handles take the vertices and the groups that are held, and the limbs of bones."""
        from ..limbs import joined_limbs

        limbs = [piece.bones and piece.bones.limbs_at(piece.placement) for piece in self.pieces]
        counts = [piece.solved for piece in self.pieces]
        return replace(self.pose_of_handles, limbs=joined_limbs(limbs, counts))

    @property
    def pose_of_handles(self) -> Pose:
        """The pose without limbs, which take time: all that `Stylization.moved` looks at."""
        from ..iteration.pose import Pose

        targets = np.concatenate([piece.targets for piece in self.pieces])
        return Pose(targets=targets, hold_matrices=[hold.matrix for hold in self.holds])

    def suits(self, pieces: Sequence[P]) -> bool:
        """Return whether the same objects with other positions are as symmetric as these are."""
        return not self.planes or suits(self.planes, _positions(pieces))

    def stylization(self, options: SolverOptions | None = None) -> Stylization:
        """Return a new Stylization of the pieces; by default, components keep their orientation.

        Raises
        ------
        CubicCraftError
            A style is invalid, or the device is not available.
        """
        from ..iteration.options import SolverOptions
        from ..iteration.stylization import Stylization

        options = SolverOptions(keep_rotation=True) if options is None else options
        return Stylization(self.setup, self.style, self.pose, options)

    def posed(self, pieces: Sequence[P]) -> Problem[P]:
        """Return the same objects in another pose and with other settings, without a factorization.

        `pieces`: with the shape and the placements of that pose; the rest is as in the first.
        """
        begin = time.perf_counter()
        setup = without_holds = self.without_holds.posed(_positions(pieces))
        holds = holds_of(pieces, setup.rest)
        if holds:
            setup = setup.with_holds([hold.weights for hold in holds])
        return replace(
            self,
            pieces=tuple(pieces),
            setup=setup,
            without_holds=without_holds,
            holds=holds,
            seconds=time.perf_counter() - begin,
        )

    def split(
        self,
        positions: FloatArray,
        rotations: FloatArray | None,
        *,
        keep_floor: bool = False,
        only_standing: bool = False,
    ) -> list[tuple[FloatArray, Any]]:
        """Return a result (N,3) and (N,3,3) as that of each piece, in its object's coordinates.

        `keep_floor` moves what stood on the ground back to it, with all feet; see `Floor`.
        """
        at_rest = self.setup.rest.input_positions
        if np.shape(positions) != at_rest.shape:
            raise CubicCraftError(
                f"the positions of {self.name} must have the shape {at_rest.shape}, as a Result of"
                f" its stylization has them, not {np.shape(positions)}"
            )
        if keep_floor:
            positions = self._floor.kept(positions, only_standing=only_standing)
        is_held = np.zeros(len(at_rest), dtype=bool)
        is_held[self.setup.pinned_input] = True
        is_idle = bool(self.is_still.all())
        found = []
        for piece, part in parts_of(self.pieces):
            own = positions[part], None if rotations is None else rotations[part]
            found.append(piece.read_back(*own, at_rest[part], is_held[part], is_idle=is_idle))
        return found


def join_pieces(
    pieces: Sequence[P],
    proxy: ProxyOptions | None = None,
    earlier: Sequence[Problem[P]] = (),
    *,
    keep_symmetric: bool = False,
) -> Problem[P]:
    """Join pieces, which are in the same coordinates, into one mesh, and factorize it.

    Parameters
    ----------
    proxy : ProxyOptions, optional
        How to prepare the surface; by default as in the extension.
    earlier : sequence of Problem
        What has not changed is reused.
    keep_symmetric : bool
        Whether figures of several pieces that are symmetric about a plane stay so.

    Raises
    ------
    CubicCraftError
        They cannot be solved; the message has their names.

    Examples
    --------
    A head becomes cubic, and the eye in its face goes along. As in the paper, without links, it
    stays where it was:

    >>> import numpy as np
    >>> from solver import PAPER, SolverOptions, Style, ball, join_pieces, piece_of, run
    >>> V, F = ball()
    >>> place = np.eye(4)
    >>> place[:3, 3] = 0, -1, 0
    >>> head = piece_of(V, F, Style(0.6), name="head")
    >>> eye = piece_of(0.2 * V, F, Style(0.0), name="eye", matrix=place)
    >>> options = SolverOptions(keep_rotation=True, device="numpy")
    >>> for proxy in (None, PAPER):
    ...     problem = join_pieces([head, eye], proxy)
    ...     result = run(problem.stylization(options))
    ...     _, (positions, _) = problem.split(result.positions, result.rotations)
    ...     print(f"{np.linalg.norm((positions - 0.2 * V).mean(axis=0)):.2f}")
    0.16
    0.00
    """
    from ..iteration.setup import Setup

    begin = time.perf_counter()
    pieces = cast("Sequence[P]", instances(pieces, "pieces", Piece))
    for one in earlier:
        instance(one, "earlier", Problem)
    is_still = np.concatenate([piece.everywhere(piece.is_still) for piece in pieces])
    is_held = _is_held(pieces)
    try:
        rest = _rest(pieces, proxy, earlier)
        planes = _planes(pieces, rest, earlier) if keep_symmetric else None
        even = even_planes(pieces, planes or ())
        known = (
            one.without_holds for one in earlier if _has_setup(one, pieces, rest, is_still, even)
        )
        setup = next(known, None)
        if setup is None:
            # The solver needs at least one free vertex.
            is_some_free = not (is_still | is_held).all()
            still = is_still if is_some_free and is_still.any() else None
            setup = Setup(rest, np.flatnonzero(is_held), still, [*_mirrors(pieces), *even])
        without_holds, holds = setup, holds_of(pieces, rest)
        if holds:
            setup = _with_holds(setup, holds, earlier)
    except CubicCraftError as error:
        raise CubicCraftError(f"{listed([piece.name for piece in pieces])}: {error}") from error
    seconds = time.perf_counter() - begin + sum(piece.seconds for piece in pieces)
    problem = Problem(tuple(pieces), setup, is_still, without_holds, holds, seconds, planes)
    _keep_floor(problem, earlier)
    return problem


def _keep_floor(problem, earlier):
    """Give a problem the Floor of one of the same setup: what it has factorized takes long."""
    for other in earlier:
        is_as_upright = np.array_equal(*(one.pieces[0].placement.up for one in (problem, other)))
        if other.setup is problem.setup and is_as_upright and "_floor" in other.__dict__:
            problem.__dict__["_floor"] = other._floor


def _rest(pieces, proxy, earlier):
    """Build the RestMesh, or reuse an earlier one of the same shapes with its links."""
    from ..proxy.options import ProxyOptions
    from ..surface.preparation import rest_mesh

    proxy = ProxyOptions() if proxy is None else instance(proxy, "proxy", ProxyOptions)
    for other in earlier:
        rest = other.setup.rest.with_options(proxy) if _has_shapes(other, pieces) else None
        if rest is not None:
            return rest
    triangles = [part.start + piece.F for piece, part in parts_of(pieces)]
    rest = rest_mesh(_positions(pieces), np.concatenate(triangles), proxy, _faces(pieces))
    return replace(rest, is_cage=any(isinstance(piece.whole, Subdivided) for piece in pieces))


def _planes(pieces, rest, earlier):
    """Find the planes about which the pieces are symmetric, or reuse those of the same shapes."""
    for other in earlier:
        if other.planes is not None and other.setup.rest.topology is rest.topology:
            return other.planes
    return common_planes(pieces, rest)


def _faces(pieces):
    if all(piece.whole.faces is None for piece in pieces):
        return None
    found, begin = [], 0
    for piece in pieces:
        own = piece.whole.faces
        found.append(begin + (np.arange(len(piece.F)) if own is None else own))
        begin = int(found[-1].max()) + 1
    return np.concatenate(found)


def _positions(pieces):
    return np.concatenate([piece.V for piece in pieces])


def _is_held(pieces):
    return np.concatenate([piece.everywhere(piece.is_held) for piece in pieces])


def _has_shapes(problem, pieces):
    return len(problem.pieces) == len(pieces) and all(
        one.whole.added == other.whole.added
        and one.shape.is_like(other.shape)
        and one.placement.shape_key == other.placement.shape_key
        for one, other in zip(problem.pieces, pieces, strict=True)
    )


def _has_setup(problem, pieces, rest, is_still, even):
    if problem.setup.rest is not rest or not np.array_equal(problem.is_still, is_still):
        return False
    others = even_planes(problem.pieces, problem.planes or ())
    if list(map(id, others)) != list(map(id, even)):
        return False
    pairs = zip(problem.pieces, pieces, strict=True)
    if any(one.whole.mirrored != other.whole.mirrored for one, other in pairs):
        return False
    return np.array_equal(_is_held(problem.pieces), _is_held(pieces))


def _with_holds(setup, holds, earlier):
    """Return a Setup with groups, or reuse an earlier one if only their goals have changed."""
    for other in earlier:
        if other.without_holds is setup and len(other.holds) == len(holds):
            pairs = zip(other.holds, holds, strict=True)
            if all(np.array_equal(one.weights, two.weights) for one, two in pairs):
                return other.setup
    return setup.with_holds([hold.weights for hold in holds])


def _mirrors(pieces):
    total, found = sum(piece.solved for piece in pieces), []
    for piece, part in parts_of(pieces):
        whole = piece.whole
        for reflection, partner in zip(whole.mirrored, whole.partners, strict=True):
            everywhere = np.full(total, NO_PARTNER)
            everywhere[part] = np.where(partner >= 0, partner + part.start, NO_PARTNER)
            found.append(piece.placement.mirror(reflection.mirror(everywhere)))
    return found


def listed(names: Sequence[str]) -> str:
    """Return names as words of a sentence."""
    quoted = [f'"{name}"' for name in names]
    if len(quoted) > 3:
        return f"{quoted[0]}, {quoted[1]} and {len(quoted) - 2} others"
    return " and ".join(filter(None, [", ".join(quoted[:-1]), quoted[-1]]))

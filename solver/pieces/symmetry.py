# SPDX-License-Identifier: GPL-3.0-or-later
"""What is symmetric at rest stays so, without being asked: a piece, or several that are linked.

Samples of links and the order of sums are never exactly symmetric, and a tail between two sides of
a cube goes to either of them.

A character has clothes, eyes and shoes: some are their own image about the plane of its body, some
are each other's. What holds on to each other, by links, is one figure. It has the planes of those
of its pieces that are symmetric about their own axes; a plane counts if next to all of the figure
is symmetric about it. An eye is symmetric about a plane of its own, too, but its head is not: it is
not held in that. Planes contain the vertical, as what keeps its place on the floor is shifted
afterward. With a sword in one hand, there is none: its links would be at odds with the projection,
which then is no descent (a table with one of three legs in its plane lost much of its style).
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ..aliases import FloatArray
from ..mesh.components import components
from ..surface.symmetry import MATCHING, NO_PARTNER, Mirror, partners
from .mirrored_styles import is_own_image, looks_alike
from .piece import Piece
from .reflection import flip
from .shape import LEAST_MATCHING
from .subdivided import Subdivided

if TYPE_CHECKING:  # SciPy is loaded when it is needed, not for its names
    from ..surface.rest import RestMesh

_ALIKE = 1e-5  # of matrices
_EVEN = 0.01  # of weights
_MOST = 4  # planes of one figure that are looked at
_SAMPLE = 400  # vertices, by half of which most planes are known not to be one of the figure

T = TypeVar("T", bound=Piece)


def with_own_symmetry(piece: T, up: FloatArray | None = None) -> T:
    """Return a piece that is solved alone, symmetric about the axes about which it is at rest.

    With a direction `up` (3,), where it is solved, only about planes that contain it: what keeps
    its place on the floor is shifted afterward.

    Neither where its form is not its own image, nor where handles, regions or painted weights are
    not symmetric. One with a symmetry that was asked for stays as it is.
    """
    whole = piece.whole
    if whole.matching is not None or piece.may_lose_symmetry:
        return piece
    axes = tuple(
        is_symmetric and is_own_image(flip(axis), piece.placement, up)
        for axis, is_symmetric in enumerate(piece.shape.symmetric_axes)
    )
    if not any(axes):
        return piece
    is_smooth = isinstance(whole, Subdivided)
    found = piece.shape.whole(whole.reflections, axes, is_smooth=is_smooth)
    if not all(_is_even_itself(piece, mirror) for mirror in found.own_partners):
        return piece
    return replace(piece, whole=found)


def _is_even_itself(piece: Piece, mirror: Mirror):
    """Return whether what is given for each vertex is the same for its partner."""
    has_one = mirror.partner >= 0
    partner = mirror.partner[has_one]
    is_in_handle = piece.handle_of >= 0
    if (is_in_handle[has_one] != is_in_handle[partner]).any():
        return False
    for weights in map(np.asarray, (piece.map_weights, piece.detail_weights)):
        if weights.ndim and np.abs(weights[has_one] - weights[partner]).max() > _EVEN:
            return False
    return True


def common_planes(pieces: Sequence[Piece], rest: "RestMesh") -> tuple[Mirror, ...]:
    """Return the planes about which what is linked in `rest` is symmetric."""
    of_vertex = np.repeat(np.arange(len(pieces)), [piece.solved for piece in pieces])
    figure = _figures(rest, of_vertex, len(pieces))
    area = np.bincount(of_vertex[rest.used], rest.areas * ~rest.is_sheet, len(pieces))
    found = []
    for number in range(figure.max() + 1):
        chosen = np.flatnonzero(figure == number)
        own = [pieces[k] for k in chosen.tolist()]
        if any(piece.whole.matching is not None for piece in own):
            continue  # what was asked for is enough
        rows = np.flatnonzero(figure[of_vertex] == number)
        V, of_row = rest.input_positions[rows], np.searchsorted(chosen, of_vertex[rows])
        for linear, offset in _candidates(own):
            if not _is_likely(V, linear, offset):
                continue
            partner = _partners(V, V @ linear.T + offset, of_row, area[chosen])
            if partner is None:
                continue
            everywhere = np.full(len(of_vertex), NO_PARTNER)
            everywhere[rows] = np.where(partner >= 0, rows[partner], NO_PARTNER)
            found.append(Mirror(everywhere, linear, offset))
    return tuple(found)


def even_planes(pieces: Sequence[Piece], planes: Sequence[Mirror]) -> list[Mirror]:
    """Return those of the planes about which forms, handles and weights are symmetric, too."""
    return [plane for plane in planes if _is_even(pieces, plane)]


def suits(planes: Sequence[Mirror], positions: FloatArray) -> bool:
    """Return whether partners are images of each other at other positions (N,3), too."""
    sizes = [np.ptp(positions[plane.partner >= 0], axis=0).max() for plane in planes]
    pairs = zip(planes, sizes, strict=True)
    return all(plane.suits(positions, 2.0 * MATCHING * size) for plane, size in pairs)


def _figures(rest, of_vertex, count):
    """Return the figure (p,) that each piece is part of: they are linked, one by one."""
    number = rest.topology.component
    pairs = np.unique(np.column_stack([of_vertex[rest.used], count + number]), axis=0)
    _, found = components(pairs, count + rest.topology.component_count)
    return np.unique(found[:count], return_inverse=True)[1].ravel()


def _candidates(pieces) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Yield reflections x -> A x + b about planes of the pieces, of the largest first."""
    seen = []
    for piece in sorted(pieces, key=lambda piece: -piece.vertices):
        for linear, offset in _own_planes(piece):
            if np.abs(linear @ piece.placement.up - piece.placement.up).max() > _ALIKE:
                continue
            given = np.column_stack([linear, offset])
            if any(np.allclose(given, other, rtol=0.0, atol=_ALIKE) for other in seen):
                continue
            if len(seen) == _MOST:
                return
            seen.append(given)
            yield linear, offset


def _own_planes(piece):
    flips = [flip(axis) for axis in range(3) if piece.shape.symmetric_axes[axis]]
    for reflection in (*piece.whole.added, *flips):
        mirror = piece.placement.mirror(reflection.mirror(np.empty(0, np.intp)))
        linear = mirror.linear
        if np.abs(linear @ linear.T - np.eye(3)).max() <= _ALIKE:  # else stretched aslant to it
            yield linear, mirror.offset


def _is_likely(V, linear, offset):
    """Return whether half of a sample of points (k,3) has images among them."""
    from scipy.spatial import KDTree  # here, because few need it

    reach = MATCHING * float(np.ptp(V, axis=0).max())
    sample = V[:: max(len(V) // _SAMPLE, 1)] @ linear.T + offset
    return np.mean(KDTree(V).query(sample)[0] <= reach) >= 0.5


def _partners(V, image, of_row, area):
    """Return the partners (k,) within a figure, without those of pieces that have no image.

    None if too much of the figure (its area, by pieces) has none.
    """
    found = partners(V, image, MATCHING * float(np.ptp(V, axis=0).max()))
    count = np.bincount(of_row, minlength=len(area))
    has_image = np.bincount(of_row, found >= 0, len(area)) >= LEAST_MATCHING * count
    is_kept = has_image[of_row] & (found >= 0)
    is_kept &= has_image[of_row[found]]
    if not is_kept.any() or area[has_image].sum() < LEAST_MATCHING * area.sum():
        return None
    return np.where(is_kept, found, NO_PARTNER)


def _is_even(pieces, plane):
    """Return whether all that is given for vertices is the same for their partners."""
    first = np.flatnonzero(plane.partner >= 0)
    second = plane.partner[first]
    of_vertex = np.repeat(np.arange(len(pieces)), [piece.solved for piece in pieces])
    for one, other in np.unique(np.column_stack([of_vertex[first], of_vertex[second]]), axis=0):
        if not _are_images(pieces[one], pieces[other], plane.linear):
            return False
    values = _values_of(pieces)
    return bool((np.abs(values[first] - values[second]) <= _EVEN).all())


def _are_images(one, other, linear):
    """Return whether the form of one piece is the image of that of another."""
    if one.may_lose_symmetry or other.may_lose_symmetry:
        return False
    first, second = one.placement.style, other.placement.style
    if (first.form and first.form.key) != (second.form and second.form.key):
        return False
    turn = np.asarray(first.orientation) @ linear @ np.transpose(second.orientation)
    return looks_alike(turn, first.form)


def _values_of(pieces) -> FloatArray:
    """Return (N,4): cubeness, crispness, strength of details, and what is in a handle."""
    columns = []
    for piece in pieces:
        style = piece.placement.style
        values = (
            style.cubeness * np.asarray(piece.map_weights),
            style.crispness * np.asarray(piece.map_weights),
            style.detail_strength * np.asarray(piece.detail_weights),
            piece.handle_of >= 0,
        )
        columns.append(np.column_stack([piece.everywhere(1.0 * x) for x in values]))
    return np.concatenate(columns)

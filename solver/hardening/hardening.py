# SPDX-License-Identifier: GPL-3.0-or-later
"""What a soft cubic shape becomes as its sides are made flat and its details are put back."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.spatial import KDTree

from ..algebra import by_blocks, smoothstep
from ..aliases import FloatArray, IntArray
from ..mesh.components import components
from ..proxy.samples import extents
from ..rotation_fit import fit_rotations, orthonormalize
from .base import base_of
from .borders import straightening
from .carrying import away_from, carried, giving_way, together
from .face_step import Target
from .new_crossings import NewCrossings
from .open_rims import open_rims
from .planes import flat_at_rest, flattening
from .rims import FREE, rims_and_flats
from .sides import CLEAR, NO_SIDE, STEADY, sides_of

ROUNDS = 12
"""steps of the iteration; sides are flat after them, and what still moves is not seen"""
GIVEN_BACK = range(ROUNDS // 4, ROUNDS - 2, 2)
"""those after which the volume of the soft shape is given back: some of it returns each time"""
OF_THICKNESS = 0.55
"""largest extent of what may leave the soft shape as it becomes flat, relative to the thickness
there: a ball becomes flat all over, and what is slender keeps its bends,..."""
HOLD = 0.05, 0.45
"""...and the least and the most of it, relative to its component,..."""
OF_SHEETS = 0.085
"""...and what it is for open sheets"""
TEETH = 0.03
"""of the size of a part: what would move farther to make a border straight is no tooth, but a
corner"""
THIN = 0.2, 0.4
"""of the size of details: parts thinner than the first stay soft, those beyond the second do not"""
RINGS = 2
"""of vertices around what has come to cross that stay soft, and as many that are between"""
SOFT = 0.0125, 0.05
"""of the size: the least and the largest distance from it beyond which none stay so; between, the
extent of what crosses: a fold takes more around it along than a corner that dips in"""
WHOLLY = 0.4
"""of that distance, within which they do"""
DRAWN = 0.2
"""cubeness from which on the crispness counts fully"""
FLAT = 0.5, 0.9
"""crispness from which on what is nearly flat begins to go to its plane, and is there, wholly"""
TRIES, GROWING = 6, 1.5
"""times that what would cross goes as one, with how much more around it each time it still does"""
LED = 2
"""first of them that two cross, in which the heavier stays as flat"""
_POINT = 1e-6  # extent in the unit box; what has none is held all the same
_ORTHONORMALIZATIONS = 4


@dataclass(frozen=True, eq=False)
class Hardening:
    """A soft shape, and what it becomes."""

    solved: FloatArray
    """(n,3) positions of the soft shape in the unit box"""
    soft: FloatArray
    """(n,3) the same with the strength of details asked for"""
    rotations: FloatArray
    """(n,3,3) of the soft shape"""
    asked: FloatArray
    """(n,) how far the vertices are to go from there to the hard shape, from 0 to 1"""
    firm: FloatArray
    """(n,) how far at a crispness of 1: less where they are thinner than details, but for plates,
    and where they were softened"""
    flat: FloatArray
    """(n,) how far they belong to planes, from 0 to 1"""
    target: Target
    side: IntArray
    """(m,) int"""
    facing: FloatArray
    """(m,3) as `sides_of` returns them"""
    moves: FloatArray
    """(n,3) of the vertices of the hard shape, to planes and to straight borders"""
    along: FloatArray
    """(n,3) how far they go along with what they are linked to, however crisp they are"""
    rim: FloatArray
    """(n,) how far they belong to rims between flats, or to what was flat at rest, from 0 to 1"""

    @cached_property
    def crispness(self):
        """(n,) how far the vertices go to the hard shape, from 0 to 1: what is flat, wholly."""
        return self.asked + smoothstep(self.asked, *FLAT) * self.flat * (1.0 - self.asked)

    def with_crispness(self, style):
        """Return the same with the crispness of another SolvedStyle; what was soft stays so."""
        return replace(self, asked=self.firm * _crispness_of(style))

    def followed(self, solved, R):
        """Return the same beside another soft shape (n,3), with rotations (n,3,3)."""
        offsets, soft = self.soft - self.solved, solved
        if offsets.any():
            soft = solved + np.einsum("nij,nkj,nk->ni", R, self.rotations, offsets)
        return replace(self, solved=solved, soft=soft, rotations=R)

    def softened(self, rest, vertices):
        """Return the same with vertices (k,), and some around them, as they are in the soft shape.

        Their details are, too: without them, folds may cross.
        """
        near = rest.skin.matrix(np.ones(len(rest.skin.indices)))
        share = np.zeros(len(rest.V))
        share[vertices] = 1.0
        for _ in range(RINGS):
            share = (near @ share > 0.0).astype(np.float64)
        count = np.diff(rest.skin.indptr)
        for _ in range(RINGS):
            share = (near @ share) / count
        far, nearest = KDTree(self.soft[vertices]).query(self.soft)
        reach = far / _reaches(rest, self.soft, vertices)[nearest]
        share = np.minimum(share, np.clip((1.0 - reach) / (1.0 - WHOLLY), 0.0, 1.0))
        share[vertices] = 1.0
        soft = self.soft + share[:, None] * (self.solved - self.soft)
        left = 1.0 - share
        parts = {name: left * getattr(self, name) for name in ("asked", "firm", "flat")}
        return replace(self, soft=soft, **parts)

    def to_planes(self, U):
        """Return the `flattening` of the hard shape U (n,3), however crisp it is."""
        base, rest = self.target.base, self.target.base.rest
        of_sides = self.side, self.target.directions, self.target.heights
        of_shape = base.is_tilted, base.thickness
        rims = self.rim, open_rims(rest.V, base.graph, self.rotations)
        return flattening(U, rest.F, base.graph, *of_sides, *of_shape, *rims)

    def flattened(self, U, planes, fixed, *, may_cross=False, apart=()):
        """Return the same with the moves of the hard shape U (n,3) to its `planes`, of `to_planes`.

        Linked parts go along. Vertices `fixed` stay, with all around them, and what would come to
        cross stays or goes as one, with all around it. Where things `may_cross`, that is not looked
        for, nor is it for two parts that cross before, but for those to be `apart`, (k,2) int.
        """
        rest, (moves, flat) = self.target.base.rest, planes
        moves = moves * smoothstep(self.asked, *FLAT)[:, None]
        nothing = np.zeros_like(moves)
        round_ = replace(self, flat=np.zeros_like(flat), moves=nothing, along=nothing)
        before = round_.positions(U)
        free = away_from(before, fixed)
        found = replace(round_, flat=free * flat, moves=free[:, None] * moves)
        of_parts = carried(rest, found.positions(U) - before, fixed)
        found = replace(found, along=free[:, None] * of_parts)
        X, F = found.positions(U), rest.F if rest.unrefined is None else rest.unrefined
        is_moved = (before != X).any(axis=1)[F].any(axis=1)
        if may_cross or not is_moved.any():
            return found
        part = rest.topology.part
        crossings = NewCrossings(before, X, F, is_moved, rest.faces, part, apart)
        seen = np.empty((0, 2), np.intp)
        for _ in range(TRIES):
            crossing = crossings.at(found.positions(U)).reshape(-1, 2)
            if not len(crossing):
                break
            seen = np.concatenate([seen, crossing])
            pairs, times = np.unique(seen, axis=0, return_counts=True)
            share, as_one = self._apart(before, X - before, F, pairs, times, free)
            along = share[:, None] * of_parts + as_one
            found = replace(found, flat=share * flat, moves=share[:, None] * moves, along=along)
        return found

    def _apart(self, before, moves, F, pairs, times, free):
        """Return how far vertices (n,) may go to planes, and how far (n,3) they go as one instead.

        `moves`: (n,3), to planes. `pairs`: (k,2) int, of triangles that have come to cross, and how
        many `times` (k,) they did. `free`: (n,), the most.
        """
        rest = self.target.base.rest
        part, parts = rest.topology.part, rest.topology.part[F[pairs, 0]]
        gives_way = giving_way(parts, np.bincount(part, rest.areas), parts[times > LED])
        is_led = gives_way.any(axis=1)
        share, of_led = free, np.ones_like(free)
        for time in np.unique(times):
            led, others = (F[pairs[(times == time) & which]] for which in (is_led, ~is_led))
            of_led = np.minimum(of_led, away_from(before, led, GROWING ** (time - 1)))
            share = np.minimum(share, away_from(before, others, GROWING ** (time - 1)))
        of_led[np.isin(part, parts[gives_way[:, ::-1]])] = 1.0
        share = np.minimum(share, of_led)
        as_one = together(before, F, pairs, moves, part, share < free, gives_way)
        return share, (free - share)[:, None] * as_one

    def straightening(self, U, fixed, *, may_cross=False):
        """Return the `straightening` of the end U (n,3).

        That of the triangles before refinement, which are seen: a step of a border along one of
        their edges is a long one in the refined mesh. The midpoints follow.
        """
        rest = self.target.base.rest
        F, of_sides = rest.F, (self.side, self.target.directions)
        if rest.unrefined is not None:
            F, piece = rest.unrefined, np.empty(len(rest.unrefined), np.intp)
            piece[rest.pieces] = np.arange(len(rest.F))  # one of each
            of_sides = self.side[piece], self.target.directions[piece]
        part = rest.topology.part
        moves = straightening(
            *(U, F, rest.unrefined_graph, *of_sides, fixed),
            farthest=TEETH * extents(rest.V, part)[part],
            faces=rest.faces,
            may_cross=may_cross,
        )
        return rest.along_edges(moves)

    def positions(self, U):
        """Return the positions (n,3) between the soft shape and the hard one U (n,3)."""
        return self.soft + self.crispness[:, None] * (U + self.moves - self.soft) + self.along

    def between(self, R):
        """Return the rotations (n,3,3) between the soft shape and the hard one R (n,3,3)."""

        def fitted(share, soft, R):
            return fit_rotations(((1.0 - share) * soft + share * R).swapaxes(1, 2), R)

        return by_blocks(fitted, self.crispness[:, None, None], self.rotations, R)


def is_hardened(stylization):
    """Return whether the soft shape of a Stylization is not its end, and more than thin parts."""
    style, rest = stylization.style, stylization.rest
    asked = style.crispness, style.detail_strength - 1.0
    return any(x.any() and (x * _share_of_thickness(rest)).any() for x in asked)


def hold_of(rest):
    """Return how firmly vertices (n,) are held near the soft shape, in the units of L."""
    component = rest.topology.component
    size = np.maximum(extents(rest.V, component), _POINT)[component]
    reach = np.clip(OF_THICKNESS * rest.thickness, HOLD[0] * size, HOLD[1] * size)
    reach = np.where(np.isfinite(rest.thickness), reach, OF_SHEETS * size)
    return np.maximum(rest.areas, _POINT * _POINT) / (reach * reach)


def hardening_of(stylization, before=None):
    """Return the Hardening of a Stylization at its present, soft shape.

    `before`: what triangles (m,3) faced in the frame of an animation before, see `sides_of`.
    """
    setup, rest = stylization.setup, stylization.rest
    base, thick = base_of(setup), _share_of_thickness(rest)
    sides = _sides(stylization, base, thick, before, STEADY)
    slides = 0.0 if rest.is_cage else 1.0  # a cage could not follow
    rims = rims_and_flats(base.graph, stylization.positions, rest.F, *sides[:2])
    rim, plate = slides * np.stack(rims)
    hold = hold_of(rest) * (1.0 - (1.0 - FREE) * rim)
    rim = np.maximum(rim, slides * flat_at_rest(rest.V, rest.F, base.graph, sides[0]))
    found = _raised(stylization, base, thick, sides, hold, plate, rim)
    firm = np.maximum(thick, plate)
    return replace(found, firm=firm, asked=firm * _crispness_of(stylization.style))


def hardening_after(last, stylization):
    """Return the Hardening of a Stylization of the same vertices as the last one, a moment ago.

    What was soft stays so, and sides change only where they clearly are others. What takes long is
    not found anew: rims, and where the rest shape is the same, its base.
    """
    base, setup, firm = last.target.base, stylization.setup, last.firm
    if base.rest is not setup.rest:
        base = base_of(setup)
    sides = _sides(stylization, base, firm, last.facing, CLEAR)
    of_rims = last.target.hold, last.target.slides, last.rim
    return _raised(stylization, base, firm, sides, *of_rims)


def _sides(stylization, base, firm, before, steady):
    """Return side (m,), facing (m,3) and directions, as `sides_of` at the present shape."""
    style, rest, R = stylization.style, stylization.rest, stylization.rotations
    F = rest.F
    is_free = ~(firm * _crispness_of(style) > 0.0)[F].all(axis=1) | ~base.normals.any(axis=1)
    is_free |= rest.is_sheet[F[:, 0]]
    normals = base.normals * (rest.outward[F[:, 0]] if style.forms else 1.0)
    if len(style.Q) > 1:
        frames = by_blocks(lambda F: _at_faces(style.Q, F), F)
    else:
        frames = np.broadcast_to(_at_faces(style.Q, np.zeros((1, 3), np.intp)), (len(F), 3, 3))
    side, facing, directions = sides_of(
        base.graph,
        by_blocks(lambda F, x: np.einsum("mij,mj->mi", _at_faces(R, F), x), F, normals),
        frames,
        style.forms,
        np.sort(style.form_of[F], axis=1)[:, 1],  # of two corners, or of one
        is_free=is_free,
        whole=rest.whole,
        before=before,
        steady=steady,
    )
    if style.forms:  # what is inside out faces the other way
        directions = directions * rest.outward[F[:, 0]]
    return side, facing, directions


def _raised(stylization, base, firm, sides, hold, plate, rim):
    """Return the Hardening with its details as high as they are asked to be, where it is firm."""
    style, (side, facing, directions) = stylization.style, sides
    solved, R = stylization.positions.copy(), stylization.rotations.copy()
    soft = solved.copy()
    strength = 1.0 + (style.detail_strength - 1.0) * firm
    if (strength != 1.0).any():
        added = (strength - 1.0) * base.heights
        soft += added[:, None] * np.einsum("nij,nj->ni", R, base.upward)
        stylization.impose(soft)
    heights = strength * base.heights
    target = Target(base, heights, directions, side == NO_SIDE, soft, hold, slides=plate)
    asked, still = firm * _crispness_of(style), np.zeros_like(soft)
    flat = np.zeros(len(soft))
    return Hardening(solved, soft, R, asked, firm, flat, target, side, facing, still, still, rim)


def _crispness_of(style):
    """Return how far vertices (n,) go to the hard shape where they are firm.

    What is hardly drawn to the form does not snap to it: a shape whose cubeness is keyed from 0 on
    becomes crisp bit by bit.
    """
    return style.crispness * np.minimum(style.cubeness / DRAWN, 1.0)


def _reaches(rest, U, vertices):
    """Return how far around vertices (k,), which cross at positions U (n,3), others stay soft."""
    is_crossing = np.zeros(len(U), dtype=bool)
    is_crossing[vertices] = True
    F = rest.F[is_crossing[rest.F].sum(axis=1) > 1]
    group = components(F, len(U))[1]
    return np.clip(extents(U, group)[group[vertices]], *SOFT)


def _share_of_thickness(rest):
    """Return how far vertices (n,) are thicker than details, from 0 to 1.

    What is thinner is one itself.
    """
    if not rest.options.detail:
        return np.ones(len(rest.V))
    component = rest.topology.component
    size = rest.options.detail * np.maximum(extents(rest.V, component), 1e-12)[component]
    return smoothstep(rest.thickness / size, *THIN)


def _at_faces(R, F):
    """Return rotations (n,3,3) of vertices at the triangles (m,3,3)."""
    means = (R[F[:, 0]] + R[F[:, 1]] + R[F[:, 2]]) / 3.0
    sides = np.linalg.det(means) < 0.0  # mirrored frames are between mirrored ones
    means[sides] *= -1.0
    means = orthonormalize(means, _ORTHONORMALIZATIONS)
    means[sides] *= -1.0
    return means

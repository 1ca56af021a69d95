# SPDX-License-Identifier: GPL-3.0-or-later
"""Affine maps between two shapes of the same vertices: what transforming a whole mesh does."""

from dataclasses import dataclass, replace

import numpy as np

_ROUNDING = 2.0**-24  # of float32, relative
_MARGIN = 16.0  # several transforms in a row, each of a few roundings
_FLAT = 3e-7  # extent relative to the largest one, below which a shape says nothing about it
_SAMPLES = 256  # of four vertices each: one is without those moved by hand, if these are half
_SOME = 4096  # vertices of a large mesh that represent all
_LEAST_SHARE = 0.125  # of the vertices, that must agree on how all have been transformed
_GOOD_PART = 0.25  # of the distances, that a map may leave where no vertices agree


@dataclass(frozen=True)
class Affine:
    """The map ``x -> linear @ x + offset`` of points in object space; it has an inverse."""

    linear: np.ndarray
    """(3,3) float64"""
    offset: np.ndarray
    """(3,) float64"""
    is_flattened: bool = False
    """the shape that it was found by has lost an extent, which this map keeps"""
    is_unique: bool = True
    """more vertices agree on it than are needed to find a map"""
    is_solid: bool = True
    """the shapes that it was found by lack no extent"""

    @property
    def is_identity(self) -> bool:
        """Whether it leaves all points unchanged, bit for bit."""
        return np.array_equal(self.linear, np.eye(3)) and not self.offset.any()

    def moved(self, points: np.ndarray) -> np.ndarray:
        """Map (n,3) points; float32, the same bits for the identity."""
        if self.is_identity:
            return points
        with np.errstate(over="ignore"):  # infinities are refused when the result is written
            return (points @ self.linear.T + self.offset).astype(np.float32)

    def agrees(self, before: np.ndarray, after: np.ndarray, slack: float = 1.0) -> np.ndarray:
        """Return which points it has moved, up to the rounding of float32.

        `before`, `after`: (n,3). `slack`: factor of the rounding. Returns (n,) bool.
        """
        return _agrees(self.linear, self.offset, before, after, slack)


IDENTITY = Affine(np.eye(3), np.zeros(3))


def fit(before: np.ndarray, after: np.ndarray) -> Affine | None:
    """Find the affine map that has moved all vertices, up to the rounding of float32.

    If the vertices lie in a plane, on a line or in one point, there are many such maps. Then the
    missing extents are scaled by the mean of the others, and not mirrored.

    `before`, `after`: (n,3) float32. Returns Affine, or None if there is none.
    """
    if np.array_equal(before, after):
        return IDENTITY
    if not (len(before) and np.isfinite(before).all() and np.isfinite(after).all()):
        return None
    some = _some(len(before))
    if len(some) < len(before):
        # Of a large mesh, a sample is enough: its map is that of all vertices or of none.
        found = _fit_all(before[some], after[some])
        if found is None or (found.is_solid and not found.agrees(before, after, 4.0).all()):
            return None
        if found.is_solid and found.agrees(before, after).all():
            return found
    return _fit_all(before, after)


def _fit_all(before: np.ndarray, after: np.ndarray) -> Affine | None:
    linear, offset, extents = _least_squares(before, after)
    if not _agrees(linear, offset, before, after).all():
        return None
    return _plain(_completed(linear, before, after, extents), before, after)


def _some(count: int) -> np.ndarray:
    """Choose a few thousand vertices from all over the mesh."""
    return np.linspace(0, count - 1, min(count, _SOME)).astype(int)


def consensus(before: np.ndarray, after: np.ndarray) -> Affine:
    """Find how a mesh was transformed if some vertices were also moved by hand.

    `before`, `after`: (n,3) float32, of at least one vertex. Returns the map of most vertices; if
    hardly any two agree, the one that fits all best, or the identity.
    """
    if not (np.isfinite(before).all() and np.isfinite(after).all()):
        return IDENTITY
    rng = np.random.default_rng(0)
    some = _some(len(before))
    some_before, some_after = before[some], after[some]
    best, votes = IDENTITY, 0
    enough = max(5, int(_LEAST_SHARE * len(some)))
    if IDENTITY.agrees(some_before, some_after).sum() >= enough:
        return IDENTITY  # also where more have been moved alike
    for _ in range(_SAMPLES):
        if 2 * votes > len(some):
            break
        sample = rng.choice(len(some), min(4, len(some)), replace=False)
        found = _map_of(some_before[sample], some_after[sample])
        agreed = found.agrees(some_before, some_after, 16.0)
        if agreed.sum() > max(votes, 4):
            found = _map_of(some_before[agreed], some_after[agreed])
            count = int(found.agrees(some_before, some_after).sum())
            if count > votes:
                best, votes = found, count
    if votes >= enough:
        agreed = best.agrees(before, after, 4.0)
        return _plain(_map_of(before[agreed], after[agreed]), before[agreed], after[agreed])
    nearest = _map_of(before, after)
    left = np.linalg.norm(nearest.moved(before) - after)
    return nearest if left < _GOOD_PART * np.linalg.norm(before - after) else IDENTITY


def _plain(found: Affine, before: np.ndarray, after: np.ndarray) -> Affine:
    """Round a map to zeros and float32 values, as Blender may have applied it, if they agree.

    Halves that were mirror images bit for bit then remain so.
    """
    linear, offset = found.linear, found.offset
    least = 2 * _ROUNDING * np.abs(linear).max()
    linear = np.where(np.abs(linear) < least, 0.0, linear).astype(np.float32)
    least = 2 * _ROUNDING * np.abs(after).max()
    offset = np.where(np.abs(offset) < least, 0.0, offset).astype(np.float32)
    plain = replace(found, linear=linear.astype(np.float64), offset=offset.astype(np.float64))
    return plain if plain.agrees(before, after).all() else found


def _map_of(before: np.ndarray, after: np.ndarray) -> Affine:
    linear, _, extents = _least_squares(before, after)
    return _completed(linear, before, after, extents)


def _least_squares(before: np.ndarray, after: np.ndarray) -> tuple[np.ndarray, np.ndarray, int]:
    """Return linear part and offset of the nearest map, and how many extents the shape has."""
    start, end = before.mean(axis=0, dtype=np.float64), after.mean(axis=0, dtype=np.float64)
    X, Y = before - start, after - end
    values, axes = np.linalg.eigh(X.T @ X)
    has_extent = values > _FLAT**2 * values[-1]
    known = axes[:, has_extent]
    linear = (Y.T @ (X @ known)) / values[has_extent] @ known.T
    return linear, end - linear @ start, int(has_extent.sum())


def _agrees(
    linear: np.ndarray,
    offset: np.ndarray,
    before: np.ndarray,
    after: np.ndarray,
    slack: float = 1.0,
) -> np.ndarray:
    # Of what Blender has added up: products of the matrix, the translation, and the sum.
    terms = np.abs(linear) @ np.abs(before).max(axis=0, initial=0.0).astype(np.float64)
    size = max(np.max(terms + np.abs(offset)), np.abs(after).max(initial=0.0))
    far = np.abs(before @ linear.T + offset - after)
    return (far <= slack * _MARGIN * _ROUNDING * size).all(axis=1)


def _completed(linear: np.ndarray, before: np.ndarray, after: np.ndarray, extents: int) -> Affine:
    """Complete the map in the missing extents; its effect on the vertices does not change."""
    U, scales, Vt = np.linalg.svd(linear)
    # An extent that was scaled to zero is only a rounding error from it.
    is_there = (scales > 4 * _FLAT * scales[0]) & (np.arange(3) < extents)
    if not is_there.all():
        mean = np.exp(np.log(scales[is_there]).mean()) if is_there.any() else 1.0
        scales = np.where(is_there, scales, mean)
        if np.linalg.det(U) * np.linalg.det(Vt) < 0:
            U[:, -1] *= -1
        linear = (U * scales) @ Vt
    offset = after.mean(axis=0, dtype=np.float64) - linear @ before.mean(axis=0, dtype=np.float64)
    is_flattened = int(is_there.sum()) < extents
    is_solid = extents == 3 and not is_flattened
    return Affine(linear, offset, is_flattened, len(before) > extents + 1, is_solid)

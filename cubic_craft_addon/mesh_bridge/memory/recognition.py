# SPDX-License-Identifier: GPL-3.0-or-later
"""Recognition of vertices that we have written: transformed, joined, removed, or moved."""

import hashlib
from dataclasses import dataclass

import numpy as np

from .affine import IDENTITY, Affine, consensus, fit

_RESULTS = 4095  # so few that mixing equal numbers gives the same number
_PLACES = 2**24  # as many as float32 represents exactly
_MOST_RUNS = 256  # more result from cutting faces, not from joining meshes


def make_marks(original: np.ndarray, written: np.ndarray) -> np.ndarray:
    """Make the marks of a result; the same for the same shapes.

    Blender joins attributes with the meshes, copies and removes them with the vertices, and mixes
    them for vertices in between. A mark is three integers: a small one that identifies the result,
    the index of the vertex, and the number of vertices. Vertices that were never cubified have no
    mark (zeros), a joined part counts from 0 again, and vertices in between have a broken mark, or
    one out of order.

    `original`, `written`: (n,3) float32. Returns (n,3) float32.
    """
    digest = hashlib.blake2b(np.ascontiguousarray(original).data, digest_size=8)
    digest.update(np.ascontiguousarray(written).data)
    marks = np.empty((len(written), 3), np.float32)
    marks[:, 0] = 1 + int(digest.hexdigest(), 16) % _RESULTS
    marks[:, 1] = np.arange(len(written)) % _PLACES
    marks[:, 2] = len(written)
    return marks


def groups(marks: np.ndarray) -> list[np.ndarray]:
    """Return the vertices of each result, as ascending arrays of their numbers."""
    results = np.rint(np.nan_to_num(marks[:, 0])).clip(0, _RESULTS).astype(int)
    return [np.flatnonzero(results == result) for result in np.unique(results[results > 0])]


def runs(marks: np.ndarray, rows: np.ndarray) -> tuple[list[np.ndarray], np.ndarray]:
    """Split the vertices of a result where their order restarts.

    Returns `runs`: list of arrays of vertices; `between`: array of the vertices with broken marks.
    """
    places = marks[rows, 1]
    is_whole = places == np.rint(places)
    whole = rows[is_whole]
    starts = np.flatnonzero(np.diff(marks[whole, 1]) <= 0) + 1
    return np.split(whole, starts), rows[~is_whole]


@dataclass(frozen=True)
class Part:
    """Vertices that were transformed alike."""

    rows: np.ndarray | slice
    map: Affine


@dataclass(frozen=True)
class Recognized:
    """The vertices that we have written; those in no part have no original."""

    parts: tuple[Part, ...]
    is_edited: bool
    """whether some are not where transforming the parts would have moved them"""

    @property
    def is_whole(self) -> bool:
        """Whether it is a single mesh, as it was written."""
        return isinstance(self.parts[0].rows, slice)

    @property
    def is_in_place(self) -> bool:
        """Whether it is a single mesh that was not transformed."""
        return self.is_whole and self.parts[0].map.is_identity

    def moved(self, stored: np.ndarray, elsewhere: np.ndarray) -> np.ndarray:
        """Transform (n,3) stored points with their parts; vertices in no part are `elsewhere`."""
        if self.is_whole:
            return self.parts[0].map.moved(stored)
        points = elsewhere.copy()
        for part in self.parts:
            points[part.rows] = part.map.moved(stored[part.rows])
        return points


UNCHANGED = Recognized((Part(slice(None), IDENTITY),), is_edited=False)


def recognize(marks: np.ndarray, written: np.ndarray, present: np.ndarray) -> Recognized | None:
    """Recognize a result.

    `marks`: (n,3) float32, of `make_marks`. `written`, `present`: (n,3) float32, the shape as we
    wrote it, and as it is. Returns Recognized, or None if the original of some vertices cannot be
    determined.
    """
    parts: list[Part] = []
    is_edited = False
    for rows in groups(marks):
        found = _recognize_group(marks, written, present, rows)
        if found is None:
            return None
        parts += found.parts
        is_edited |= found.is_edited
    if not parts:
        return None
    if len(parts) == 1 and len(_rows(parts[0])) == len(marks) == marks[0, 2]:
        parts = [Part(slice(None), parts[0].map)]
    return Recognized(tuple(parts), is_edited)


def _rows(part: Part) -> np.ndarray:
    assert isinstance(part.rows, np.ndarray)
    return part.rows


def _recognize_group(
    marks: np.ndarray, written: np.ndarray, present: np.ndarray, rows: np.ndarray
) -> Recognized | None:
    """Do this for the vertices of one result, or of several copies of it."""
    at_once = fit(written[rows], present[rows])
    if at_once is not None:
        return Recognized((Part(rows, at_once),), at_once.is_flattened)
    found, between = runs(marks, rows)
    if len(found) > _MOST_RUNS:
        return None
    places, counts = np.unique(marks[np.concatenate(found), 1], return_counts=True)
    single = places[counts == 1]
    parts, is_edited = [], False
    for run in found:
        own = fit(written[run], present[run])
        if own is not None and own.is_unique:
            is_edited |= own.is_flattened
        elif np.float32(len(run)) == marks[run[0], 2] or np.isin(marks[run, 1], single).all():
            own = consensus(written[run], present[run])
            is_edited = True
        else:
            between = np.concatenate([between, run])
            continue
        parts.append(Part(run, own))
    # Vertices in between belong to the part with which they were moved.
    for place, part in enumerate(parts):
        agrees = part.map.agrees(written[between], present[between])
        parts[place] = Part(np.concatenate([_rows(part), between[agrees]]), part.map)
        between = between[~agrees]
    return Recognized(tuple(parts), is_edited) if parts and not len(between) else None

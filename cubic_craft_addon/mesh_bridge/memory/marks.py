# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks on the vertices that we have written: which of them still have an original.

Blender joins attributes with the meshes, copies and removes them with the vertices, and mixes them
for vertices in between. A mark is three integers: a small one that identifies the result, the
index of the vertex, and the number of vertices. Vertices that were never cubified have no mark
(zeros), a joined part counts from 0 again, and vertices in between have a broken mark, or one
out of order.
"""

import hashlib

import numpy as np

_RESULTS = 4095  # so few that mixing equal numbers gives the same number
_PLACES = 2**24  # as many as float32 represents exactly


def make_marks(original: np.ndarray, written: np.ndarray) -> np.ndarray:
    """Make the marks of a result; the same for the same shapes.

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


def is_complete(marks: np.ndarray, run: np.ndarray) -> bool:
    """Return whether a run contains all vertices of its result."""
    return np.float32(len(run)) == marks[run[0], 2]

# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of `Faces` as kernels take them."""

from typing import Any, NamedTuple

import numpy as np

NUMBERS = 7
"""of each face: its body's vertices from and to, its links from and to, its two ends: for an edge
its vertices, for a vertex itself, for a facet one of its vertices; then for a vertex where in
`between` its own numbers begin"""


class FaceTables(NamedTuple):
    """The tables of `Faces`, as arguments of a kernel."""

    frames: Any
    """(k,3,3), in rows the point, the axis, and the length with two zeros"""
    numbers: Any
    """(7k,) int, see `NUMBERS`"""
    targets: Any
    """(l,) int"""
    ways: Any
    """(l,3)"""
    between: Any
    """(b,) int"""
    edge_start: Any
    """where edges begin"""
    facet_start: Any
    """where facets begin"""


def face_tables(faces, keep, keep_integers):
    """Return the FaceTables of Faces, or of none, which a kernel for cubes never reads.

    `faces`: Faces or None. `keep`, `keep_integers`: callable, bring an array of real numbers, or of
    integers, to where the kernels take it.
    """
    if faces is None:
        nothing = keep_integers(np.zeros(1, np.int32))
        frames, ways = keep(np.zeros((1, 3, 3))), keep(np.zeros((1, 3)))
        return FaceTables(frames, nothing, nothing, ways, nothing, 0, 0)
    lengths = np.stack([faces.lengths, 0 * faces.lengths, 0 * faces.lengths], axis=1)
    ends = np.tile(np.arange(len(faces.points))[:, None], (1, 2))
    ends[faces.edge_start : faces.facet_start] = faces.edge_ends
    facets = slice(faces.facet_start, None)
    ends[facets] = ends[faces.targets[faces.links[facets, 0]]]
    starts = np.zeros((len(faces.points), 1), int)
    starts[: faces.edge_start, 0] = faces.between_start
    numbers = np.concatenate([faces.vertices, faces.links, ends, starts], axis=1)
    return FaceTables(
        keep(np.stack([faces.points, faces.axes, lengths], axis=1)),
        keep_integers(numbers.ravel().astype(np.int32)),
        keep_integers(faces.targets),
        keep(faces.ways),
        keep_integers(faces.between),
        faces.edge_start,
        faces.facet_start,
    )

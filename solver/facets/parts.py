# SPDX-License-Identifier: GPL-3.0-or-later
"""Connected parts of a surface that polygons stay in."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra


def parts_of(graph, region, charts, cuts):
    """Return the connected parts (m,) of one region and one chart, and their charts (m,).

    A part that lies on both sides of a cut, as around the end of a seam, is divided half-way
    between these: its polygons would bridge the cut. The second half is a chart of its own.

    `graph`: FaceGraph. `region`, `charts`: (m,). `cuts`: (c,2) int, as of `low_poly`.
    """
    m, charts = len(region), charts.copy()
    is_same = region[graph.one] == region[graph.other]
    is_same &= charts[graph.one] == charts[graph.other]
    lower, upper = np.minimum(graph.one, graph.other), np.maximum(graph.one, graph.other)
    cuts = np.sort(np.asarray(cuts, dtype=np.int64), axis=1)
    is_same &= ~np.isin(lower.astype(np.int64) * m + upper, cuts[:, 0] * m + cuts[:, 1])
    part = graph.regions(is_same)[1]
    while True:
        both = cuts[part[cuts[:, 0]] == part[cuts[:, 1]]]
        if not len(both):
            return part, charts
        both = both[np.unique(part[both[:, 0]], return_index=True)[1]]
        ends = graph.one[is_same], graph.other[is_same]
        lengths = sp.csr_matrix((graph.distance[is_same], ends), shape=(m, m))
        far = [dijkstra(lengths, directed=False, indices=side, min_only=True) for side in both.T]
        is_second = far[1] < far[0]
        charts[is_second] = charts.max() + 1 + part[is_second]
        is_same &= is_second[graph.one] == is_second[graph.other]
        part = graph.regions(is_same)[1]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of many points are nearest to others."""

from scipy.spatial import KDTree

FEW = 2000
"""points to look from: for fewer, starting threads takes longer than one thread needs"""
_LEAF = 32  # points, compared one by one; SciPy's 10 take a tenth longer


class Nearest:
    """Points (n,3) to look for."""

    def __init__(self, points):
        # as soon as it is made: such a tree is asked only a few times
        self._tree = KDTree(points, leafsize=_LEAF, balanced_tree=False, compact_nodes=False)

    def __call__(self, places, **options):
        """Return the nearest points to places (k,3), n for none; options of `KDTree.query`."""
        workers = 1 if len(places) < FEW else -1
        return self._tree.query(places, workers=workers, **options)[1]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Things of flat sides, as props of games are."""

from itertools import pairwise

import numpy as np


def extruded_grid(heights, xs, ys):
    """Return the closed surface of columns on a grid, in quads: what is of one height is flat.

    `heights`: (a,b), above 0, of the cells between xs (a+1,) and ys (b+1,); of 0: none.
    """
    V, quads, number = [], [], {}

    def corner(i, j, z):
        return number.setdefault((i, j, z), len(number))

    a, b = heights.shape
    height = np.pad(heights, 1)
    for i in range(a):
        for j in range(b):
            top = heights[i, j]
            if not top:
                continue
            around = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            quads.append([corner(*at, top) for at in around])
            quads.append([corner(*at, 0.0) for at in around[::-1]])
            beside = [
                height[i + 1, j],
                height[i + 2, j + 1],
                height[i + 1, j + 2],
                height[i, j + 1],
            ]
            levels = np.unique(np.append(heights, 0.0))
            for k, low in enumerate(beside):
                one, other = around[k], around[(k + 1) % 4]
                between = levels[(levels >= low) & (levels <= top)]
                for z, upper in pairwise(between):
                    ends = (one, z), (other, z), (other, upper), (one, upper)
                    quads.append([corner(*at, h) for at, h in ends])
    V = np.array([(xs[i], ys[j], z) for i, j, z in number])
    return V, np.array(quads)


def chest():
    """Return a box with a wider lid, whose underside is a narrow ledge all around."""
    heights = np.full((3, 3), 0.2)
    heights[1, 1] = 0.6
    V, quads = extruded_grid(heights, [0, 0.06, 0.94, 1.0], [0, 0.06, 0.74, 0.8])
    return V * [1, 1, -1], quads[:, ::-1]


def wall():
    """Return a wall with sixteen small sills that stand out of it."""
    heights = np.full((9, 9), 0.3)
    heights[1::2, 1::2] = 0.34
    ticks = np.cumsum([0, *[0.16, 0.08] * 4, 0.16])
    return extruded_grid(heights, ticks, ticks)


def gate():
    """Return two posts with a beam, and three edges of an arch between them."""
    heights = np.full((5, 2), 0.2)
    heights[1:4, 0] = 0.0
    V, quads = extruded_grid(heights, [0, 0.2, 0.35, 0.65, 0.8, 1.0], [0, 0.85, 1.0])
    V[np.isin(V[:, 0], (0.2, 0.8)) & (V[:, 1] == 0.85), 1] = 0.7
    return V, quads

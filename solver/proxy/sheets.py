# SPDX-License-Identifier: GPL-3.0-or-later
"""Planar sheets among other parts: a ground, a wall, the leaf cards of a tree.

A plane has nothing to become cubic, and nothing to say to what is smaller than it. So it has no
cubic term, no side to harden, and no links to the smaller ones: a figure on a ground is solved as
it is alone. The smaller sheets ride along with what they are linked to.
"""

import numpy as np

from ..mesh.edges import Triangles
from ..mesh.rest_measures import triangle_areas_and_normals
from .samples import extents
from .thickness import outward_sign

PLANAR = 0.9999
"""share of the area that faces one way, or the opposite one"""
LARGER = 1.5
"""times the extent of another part: then a sheet is its ground"""
SCENE = 2.0
"""times the largest part: what is larger than that is a scene"""
CARD = 0.02
"""of the area of what it is linked to: an open sheet with less is a card"""
STRANDS = 100
"""closed parts that are as small, and slender, are cards, too, if so many are on something..."""
SLENDER = 6.0
"""...which are so many times as long as they are thick"""
SQUARE = 0.01
"""how far cosines may be from those of the planes of an extruded outline, and of its rim"""
CAPS, SHARE = 0.3, 0.98
"""shares of the area of an extruded outline: of its planes, and of them with the rim"""


def planar_sheets(V, F, part):
    """Return which parts (p,) are planar sheets. None is if there are no other parts.

    `V`: (n,3). `F`: (m,3) int. `part`: (n,) int.
    """
    area, normal = triangle_areas_and_normals(V, F)
    total, moments = moments_of_normals(area, normal, part[F[:, 0]], int(part.max()) + 1)
    largest = np.linalg.eigvalsh(moments)[:, -1]
    is_sheet = (largest > PLANAR * total) & (total > 0.0)
    return is_sheet if not is_sheet.all() else np.zeros(len(total), dtype=bool)


def extrusions(V, F, part):
    """Return which parts (p,) are extruded outlines, such as letters: two planes, and a rim."""
    area, normal = triangle_areas_and_normals(V, F)
    of_face = part[F[:, 0]]
    total, moments = moments_of_normals(area, normal, of_face, int(part.max()) + 1)
    axis = np.linalg.eigh(moments)[1][:, :, -1]
    cosine = np.abs((normal * axis[of_face]).sum(axis=1))
    is_cap, is_rim = cosine > 1.0 - SQUARE, cosine < SQUARE
    caps, both = (
        np.bincount(of_face, area * rows, len(total)) for rows in (is_cap, is_cap | is_rim)
    )
    return (caps > CAPS * total) & (both > SHARE * total)


def cards(V, F, part, component):
    """Return which parts (p,) are cards: small open sheets, such as strands of hair, or lashes.

    They come in hundreds that lie through each other, and must not hold what they are on. So do
    strands that are closed tubes; but where they are few, they are fingers, legs or spokes.

    `V`, `F`, `part`: as of `planar_sheets`. `component`: (n,) int, what is linked; a card is small
    beside that.
    """
    area, normal = triangle_areas_and_normals(V, F)
    own, linked = part[F[:, 0]], component[F[:, 0]]
    whole = np.zeros(int(part.max()) + 1)
    whole[own] = np.bincount(linked, area)[linked]
    total = np.bincount(own, area, len(whole))
    is_small = total < CARD * whole
    if not is_small.any():
        return is_small
    is_open = outward_sign(Triangles(V, F), part) == 0.0
    height = (V[F[:, 0]] * normal).sum(axis=1)
    volume = np.abs(np.bincount(own, area * height, len(whole))) / 3.0
    thickness = 4.0 * volume / np.maximum(total, 1e-300)  # of a tube
    is_strand = is_small & ~is_open & (extents(V, part) > SLENDER * thickness)
    place = np.zeros(len(whole), dtype=np.intp)
    place[own] = linked
    is_strand &= (np.bincount(place, is_strand) >= STRANDS)[place]
    is_strand &= (np.bincount(place, ~is_small) > 0.0)[place]  # a heap of sticks is no hair
    return is_small & is_open | is_strand


def moments_of_normals(area, normal, of_face, count):
    """Return the areas (p,) of parts, and the moments (p,3,3) of their normals, times areas."""
    products = (area * x * y for x in normal.T for y in normal.T)
    moments = np.stack([np.bincount(of_face, product, count) for product in products], axis=1)
    return np.bincount(of_face, area, count), moments.reshape(-1, 3, 3)


def working_extent(V, F, part):
    """Return the extent that counts as 1 while solving: that of the whole, unless it is a scene.

    A ground of 50 m, or a stray triangle, must not make a figure so small that its run ends before
    it is cubic. What has no extent at all counts as it is.
    """
    sizes = extents(V, part)
    largest = float(sizes[~planar_sheets(V, F, part)].max())
    whole = float(np.ptp(V, axis=0).max()) or 1.0
    return min(whole, SCENE * largest) if largest > 0.0 else whole


def is_ground(sizes, is_sheet, one, other):
    """Return for which pairs (k,) of parts one is a planar sheet and the other is smaller.

    `sizes`, `is_sheet`: (p,) extents of parts, and which are `planar_sheets`; or (n,), of vertices.
    """
    found = is_sheet[one] & (sizes[one] > LARGER * sizes[other])
    return found | is_sheet[other] & (sizes[other] > LARGER * sizes[one])

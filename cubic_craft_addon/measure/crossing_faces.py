# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces that can be seen to cross others in a result and did not in the original.

As the report counts them: cards of hair may cross each other. This changes nothing.
"""

from collections.abc import Iterable
from itertools import pairwise

import bpy
import numpy as np

from ...solver.contacts.crossings import crossings
from ...solver.contacts.shown import shown
from ...solver.mesh.components import components
from .. import mesh_bridge
from ..read.object_frame import world_at_rest


def crossing_faces(objects: Iterable[bpy.types.Object]) -> dict[bpy.types.Object, np.ndarray]:
    """Find the faces of results that cross others of them, as the objects are placed now.

    `objects`: objects with results, none of which share a mesh. Returns for each object with such
    faces their numbers (k,) int, in ascending order. Raises CubicCraftError: a result or its
    original cannot be read.
    """
    objects = list(objects)
    shapes = [_shapes(obj) for obj in objects]
    firsts = np.cumsum([0, *(len(now) for now, *_ in shapes)])
    F = np.concatenate([F + first for (_, _, F, _), first in zip(shapes, firsts, strict=False)])
    now, then = (np.concatenate([shape[k] for shape in shapes]) for k in (0, 1))
    pairs = crossings(now, F)
    pairs = pairs[~np.isin(_codes(pairs, len(F)), _codes(crossings(then, F), len(F)))]
    pairs = pairs[~_is_card(then, F)[pairs].all(axis=1)]
    is_crossing = np.zeros(len(F), dtype=bool)
    is_crossing[pairs[shown(now, F, pairs)]] = True
    found = {}
    ends = pairwise(np.cumsum([0, *(len(F) for _, _, F, _ in shapes)]))
    for obj, (begin, end), (*_, faces) in zip(objects, ends, shapes, strict=True):
        numbers = np.unique(faces[is_crossing[begin:end]])
        if len(numbers):
            found[obj] = numbers
    return found


def _shapes(obj):
    """Return the result (n,3) and the original in the world, triangles (m,3) and their faces."""
    mesh = mesh_bridge.mesh_of(obj)
    now = mesh_bridge.result_positions(obj)
    original = mesh_bridge.original_positions(mesh, "ORIGINAL")
    matrix = np.array(world_at_rest(obj))  # where it was solved
    now, then = (V.astype(float) @ matrix[:3, :3].T + matrix[:3, 3] for V in (now, original))
    return now, then, mesh_bridge.triangles(mesh, original), mesh_bridge.faces_of_triangles(mesh)


def _is_card(V, F):
    """Return which triangles (m,) are of small open sheets."""
    from ...solver.proxy.sheets import cards  # here, because SciPy comes with it

    _, part = components(F, len(V))
    return cards(V, F, part, np.zeros(len(V), np.intp))[part[F[:, 0]]]


def _codes(pairs, count):
    return pairs[:, 0] * count + pairs[:, 1]

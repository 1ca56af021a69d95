# SPDX-License-Identifier: GPL-3.0-or-later
"""Hypothesis strategies for meshes that nothing can be relied on about.

Only names, sizes and seeds are drawn, and NumPy makes the coordinates from the seeds: thousands of
examples are quick to draw, and one that fails shrinks to few pieces with few damages.
"""

from dataclasses import replace
from functools import reduce

import numpy as np
from broken_mesh import BrokenMesh
from damages import DAMAGES, FOR_THE_SOLVER_ONLY
from hypothesis import strategies as st
from pieces import PIECES

SEEDS = st.integers(0, 2**16)
SCALES = (1.0, 1e-6, 1e-3, 1e3, 1e6)
OFFSETS = ((0.0, 0.0, 0.0), (1e6, -1e6, 0.0), (0.0, 0.0, 1e6), (1.0, 2.0, -3.0))

_TURNS = np.array(
    [
        np.eye(3),
        [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
        [[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.6]],
    ]
)


@st.composite
def broken_meshes(draw, for_blender=False):
    """Draw a BrokenMesh; one for Blender has no face with the same vertex twice."""
    names = draw(st.lists(st.sampled_from(sorted(PIECES)), min_size=1, max_size=3))
    mesh = reduce(BrokenMesh.joined, [_piece(draw, name) for name in names])
    damages = DAMAGES if for_blender else DAMAGES | FOR_THE_SOLVER_ONLY
    for name in draw(st.lists(st.sampled_from(sorted(damages)), max_size=3)):
        seed = draw(SEEDS)
        mesh = damages[name](mesh, np.random.default_rng(seed))
        mesh = replace(mesh, notes=[*mesh.notes, f"{name} {seed}"])
    return _placed(draw, mesh)


def _piece(draw, name):
    size, seed = draw(st.integers(1, 4)), draw(SEEDS)
    rng = np.random.default_rng(seed)
    mesh = PIECES[name](rng, size)
    return replace(mesh, V=mesh.V + rng.random(3) * 3, notes=[f"{name} {size} {seed}"])


def _placed(draw, mesh):
    turn = draw(st.integers(0, len(_TURNS) - 1))
    scale, offset = draw(st.sampled_from(SCALES)), draw(st.sampled_from(OFFSETS))
    V = mesh.V @ _TURNS[turn].T * scale + offset
    return replace(mesh, V=V, notes=[*mesh.notes, f"turn {turn}, scale {scale}, at {offset}"])

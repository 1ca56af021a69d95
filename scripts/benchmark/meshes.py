# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes that are measured, as V (n,3) float64 and F (m,3) int."""

import numpy as np

from solver import ball

FILES = ("spot.obj", "homer.obj", "bunny.obj", "owl.obj", "horse.ply", "armadillo.obj")
BLOBS = {"blob-10k": 10_000, "blob-40k": 40_000}
"""stand-ins and their vertices"""


def blob(vertices):
    """Return a ball with bumps."""
    V, F = ball(vertices)
    return V * [1.0, 0.8, 1.3] * (1.0 + 0.2 * np.sin(5.0 * V[:, [1, 2, 0]])), F


def known_meshes(folder):
    """Return the usual meshes in a folder by their names, or stand-ins if it has none."""
    paths = [folder / name for name in FILES if (folder / name).exists()]
    found = {path.stem: _read(path) for path in paths}
    return found or {name: blob(vertices) for name, vertices in BLOBS.items()}


def _read(path):
    import pymeshlab  # pyright: ignore[reportMissingImports]  # late: stand-ins need none

    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    return meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()

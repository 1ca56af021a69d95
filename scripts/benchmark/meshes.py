# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes that are measured.

Each is kept as ``.npz``, so that the processes that are measured read it with NumPy alone.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from solver import ball

CACHE = Path(__file__).resolve().parents[2] / "build" / "bench" / "meshes"
FILES = ("spot.obj", "homer.obj", "bunny.obj", "owl.obj", "horse.ply", "armadillo.obj")
BLOBS = {"blob-10k": 10_000, "blob-40k": 40_000}
"""stand-ins and their vertices"""


@dataclass(frozen=True)
class Mesh:
    """A mesh on disk."""

    name: str
    vertices: int
    path: Path
    """of the .npz"""


def read(path):
    """Return V (n,3) float64 and F (m,3) int of a mesh file or an .npz of `keep`."""
    if path.suffix == ".npz":
        with np.load(path) as arrays:
            return arrays["V"], arrays["F"]
    # Late: it would count as memory of the solver.
    import pymeshlab  # pyright: ignore[reportMissingImports]

    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    return meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()


def keep(name, path, V, F):
    """Write an .npz and return its Mesh."""
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savez(path, V=V, F=F)
    return Mesh(name, len(V), path)


def blob(vertices):
    """Return V (n,3) and F (m,3) of a ball with bumps."""
    V, F = ball(vertices)
    return V * [1.0, 0.8, 1.3] * (1.0 + 0.2 * np.sin(5.0 * V[:, [1, 2, 0]])), F


def known_meshes(folder):
    """Return {name: Mesh} of the usual meshes in a folder, or of stand-ins if it has none."""
    sources = [folder / name for name in FILES if (folder / name).exists()]
    meshes = [keep(s.stem, CACHE / f"{s.stem}.npz", *read(s)) for s in sources]
    if not meshes:
        meshes = [keep(name, CACHE / f"{name}.npz", *blob(n)) for name, n in BLOBS.items()]
    return {mesh.name: mesh for mesh in meshes}

# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes that are measured.

Each is kept as ``.npz``, so that reading it needs NumPy alone and adds nothing else to the memory
of the process that is measured.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .primitives import blob

FILES = ("spot.obj", "homer.obj", "bunny.obj", "owl.obj", "horse.ply", "armadillo.obj")
BLOBS = {"blob-10k": 5, "blob-41k": 6}
"""stand-ins and their subdivisions"""


@dataclass(frozen=True)
class Mesh:
    """A mesh on disk."""

    name: str
    vertices: int
    path: Path
    """of the .npz"""
    source: Path
    """what to read where reading the file is measured too"""


def read(path):
    """Return V (n,3) float64 and F (m,3) int of a mesh file or an .npz of `keep`."""
    path = Path(path)
    if path.suffix == ".npz":
        with np.load(path) as arrays:
            return arrays["V"], arrays["F"]
    # Only here: its import would count as memory of the solver.
    import pymeshlab  # pyright: ignore[reportMissingImports]

    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    return mesh.vertex_matrix(), mesh.face_matrix()


def keep(name, path, V, F, source=None):
    """Write an .npz and return its Mesh."""
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savez(path, V=V, F=F)
    return Mesh(name, len(V), path, source or path)


def known_meshes(folder, cache):
    """Return {name: Mesh} of the usual meshes in a folder, or of stand-ins if it has none."""
    sources = [folder / name for name in FILES if (folder / name).exists()]
    meshes = [keep(s.stem, cache / f"{s.stem}.npz", *read(s), source=s) for s in sources]
    if not meshes:
        meshes = [keep(name, cache / f"{name}.npz", *blob(n)) for name, n in BLOBS.items()]
    return {mesh.name: mesh for mesh in meshes}

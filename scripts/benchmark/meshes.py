# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes that are measured.

Each is kept as ``.npz``, so that reading it needs NumPy alone and adds nothing else to the memory
of the process that is measured.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import shapes

CACHE = Path(__file__).resolve().parents[2] / "build" / "bench" / "meshes"
FILES = ("spot.obj", "homer.obj", "bunny.obj", "owl.obj", "horse.ply", "armadillo.obj")
BLOBS = {"blob-10k": 5, "blob-41k": 6}
"""stand-ins and their subdivisions"""
BUNNY_SIZES = ((1000, 0), (3000, 0), (None, 0), (None, 1), (None, 2), (None, 3), (3907, 4))
"""vertices that the bunny is simplified to (None: not at all), and Loop subdivisions after it"""


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
    if path.suffix == ".npz":
        with np.load(path) as arrays:
            return arrays["V"], arrays["F"]
    # Late: it would count as memory of the solver.
    import pymeshlab  # pyright: ignore[reportMissingImports]

    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    return meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()


def keep(name, path, V, F, source=None):
    """Write an .npz and return its Mesh."""
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savez(path, V=V, F=F)
    return Mesh(name, len(V), path, source or path)


def known_meshes(folder):
    """Return {name: Mesh} of the usual meshes in a folder, or of stand-ins if it has none."""
    sources = [folder / name for name in FILES if (folder / name).exists()]
    meshes = [keep(s.stem, CACHE / f"{s.stem}.npz", *read(s), source=s) for s in sources]
    if not meshes:
        meshes = [keep(name, CACHE / f"{name}.npz", *shapes.blob(n)) for name, n in BLOBS.items()]
    return {mesh.name: mesh for mesh in meshes}


def made_meshes(fineness):
    """Return what artists bring and the usual meshes are not: many parts, clothes, coarse cages.

    With a `fineness` of 6, character and dressed body have about 50,000 vertices.
    """
    made = {
        "character": shapes.character(fineness),
        "dressed body": shapes.dressed_body(fineness),
        "coarse character": shapes.character(3),
        "sphere 16 x 8": shapes.sphere(16, 8),
        "sphere 64 x 32": shapes.sphere(64, 32),
    }
    return [keep(name, CACHE / f"made-{name}.npz", *mesh) for name, mesh in made.items()]


def scaled_meshes(bunny, max_vertices):
    """Return one shape from 1 k to about 1 M vertices: the bunny, or a blob if it is None."""
    if bunny is None:
        return [
            keep("blob", CACHE / f"blob-subdivided-{count}.npz", *shapes.blob(count))
            for count in range(3, 9)
            if 10 * 4**count + 2 <= max_vertices
        ]
    return [
        _resized(bunny, start, loops)
        for start, loops in BUNNY_SIZES
        if (start or bunny.vertices) * 4**loops <= max_vertices
    ]


def _resized(mesh, vertices, loops):
    """Return the mesh, simplified unless `vertices` is None, then subdivided; made only once."""
    path = CACHE / f"{mesh.name}-{vertices or 'full'}-loop-{loops}.npz"
    if path.exists():
        return Mesh(mesh.name, len(read(path)[0]), path, path)
    import pymeshlab  # pyright: ignore[reportMissingImports]

    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(*read(mesh.path)))
    if vertices is not None:
        meshes.meshing_decimation_quadric_edge_collapse(
            targetfacenum=2 * vertices - 4,  # of a closed surface of genus 0
            preservetopology=True,
            preservenormal=True,
        )
    if loops:
        everywhere = pymeshlab.PercentageValue(0.0)
        meshes.meshing_surface_subdivision_loop(iterations=loops, threshold=everywhere)
    result = meshes.current_mesh()
    return keep(mesh.name, path, result.vertex_matrix(), result.face_matrix())

# SPDX-License-Identifier: GPL-3.0-or-later
"""One shape from 1 k to about 1 M vertices."""

from .meshes import Mesh, keep, read
from .primitives import blob

BUNNY_SIZES = ((1000, 0), (3000, 0), (None, 0), (None, 1), (None, 2), (None, 3), (3907, 4))
"""vertices that the bunny is simplified to (None: not at all), and Loop subdivisions after it"""
BLOB_SUBDIVISIONS = (3, 4, 5, 6, 7, 8)


def scaled_meshes(bunny, cache, max_vertices):
    """Return a list of Mesh, ascending: of the bunny, or of a blob if there is none.

    Parameters
    ----------
    bunny : Mesh or None
    cache : Path
        What has been made before is taken from there.
    max_vertices : int
    """
    if bunny is None:
        return [
            _made_once("blob", cache / f"blob-subdivided-{count}.npz", blob, count)
            for count in BLOB_SUBDIVISIONS
            if 10 * 4**count + 2 <= max_vertices
        ]
    return [
        _made_once("bunny", cache / f"bunny-{start or 'full'}-loop-{loops}.npz", _resized, *how)
        for start, loops in BUNNY_SIZES
        if (start or bunny.vertices) * 4**loops <= max_vertices
        for how in [(bunny, start, loops)]
    ]


def _made_once(name, path, make, *arguments):
    if not path.exists():
        return keep(name, path, *make(*arguments))
    return Mesh(name, len(read(path)[0]), path, path)


def _resized(mesh, vertices, loops):
    """Return V and F of a mesh, simplified unless `vertices` is None, then subdivided."""
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
    return result.vertex_matrix(), result.face_matrix()

# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be wrong with a mesh: `DAMAGES` maps names to functions.

Each takes a BrokenMesh and a random generator, and returns another BrokenMesh. Those of
`FOR_THE_SOLVER_ONLY` make faces that Blender does not let into a mesh.
"""

from dataclasses import replace

import numpy as np


def _some(rng, count):
    """Return a few random numbers below count."""
    return rng.integers(0, count, rng.integers(1, 4)).tolist()


def duplicate_faces(mesh, rng):
    """Repeat faces, some from the other side."""
    faces = [mesh.faces[i] for i in _some(rng, len(mesh.faces))]
    return replace(mesh, faces=mesh.faces + faces + [faces[0][::-1]])


def flipped_faces(mesh, rng):
    """Turn about half of the faces over."""
    faces = [face[::-1] if rng.random() < 0.5 else face for face in mesh.faces]
    return replace(mesh, faces=faces)


def missing_faces(mesh, rng):
    """Leave a third of the faces out."""
    faces = [face for face in mesh.faces if rng.random() < 0.67]
    return replace(mesh, faces=faces or mesh.faces[:1])


def degenerate_faces(mesh, rng):
    """Add triangles with the same corner twice or three times."""
    i, j = rng.integers(0, len(mesh.V), 2).tolist()
    return replace(mesh, faces=mesh.faces + [(i, i, j), (i, j, i), (i, i, i)])


def wild_faces(mesh, rng):
    """Add triangles between any vertices."""
    wild = [tuple(rng.choice(len(mesh.V), 3, replace=False).tolist()) for _ in range(3)]
    return replace(mesh, faces=mesh.faces + wild)


def coincident_vertices(mesh, rng):
    """Put some vertices where others are."""
    V = mesh.V.copy()
    V[_some(rng, len(V))] = V[rng.integers(len(V))]
    return replace(mesh, V=V)


def spikes(mesh, rng):
    """Pull a vertex far away."""
    V = mesh.V.copy()
    V[rng.integers(len(V))] *= 10.0 ** rng.integers(1, 6)
    return replace(mesh, V=V)


def isolated_vertices(mesh, rng):
    """Add vertices without an edge, one of them far away."""
    V = np.concatenate([mesh.V, rng.random((3, 3)) * [[1.0], [1.0], [1e4]]])
    return replace(mesh, V=V)


def isolated_edges(mesh, rng):
    """Add an edge without a face, and one that hangs on the mesh."""
    n = len(mesh.V)
    V = np.concatenate([mesh.V, rng.random((3, 3))])
    return replace(mesh, V=V, edges=mesh.edges + [(n, n + 1), (0, n + 2)])


def shuffled(mesh, rng):
    """Renumber vertices and faces at random."""
    number = rng.permutation(len(mesh.V))
    V = np.empty_like(mesh.V)
    V[number] = mesh.V
    faces = [tuple(number[list(face)].tolist()) for face in mesh.faces]
    edges = [(int(number[i]), int(number[j])) for i, j in mesh.edges]
    return replace(mesh, V=V, faces=[faces[i] for i in rng.permutation(len(faces))], edges=edges)


def flat(mesh, rng):
    """Press it into a plane."""
    return replace(mesh, V=mesh.V * _direction_weights(rng, 1))


def line(mesh, rng):
    """Press it into a line."""
    return replace(mesh, V=mesh.V * _direction_weights(rng, 2))


def _direction_weights(rng, zeros):
    weights = np.ones(3)
    weights[rng.permutation(3)[:zeros]] = 0.0
    return weights


DAMAGES = {
    damage.__name__: damage
    for damage in (
        *(duplicate_faces, flipped_faces, missing_faces, wild_faces, coincident_vertices),
        *(spikes, isolated_vertices, isolated_edges, shuffled, flat, line),
    )
}
FOR_THE_SOLVER_ONLY = {"degenerate_faces": degenerate_faces}

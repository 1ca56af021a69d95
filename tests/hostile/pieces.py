# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces that hostile meshes are put together from: `PIECES` maps names to functions.

Each takes a random generator and a size from 1 to 4, and returns a BrokenMesh about as large as the
unit box.
"""

import numpy as np
from broken_mesh import BrokenMesh

_TETRAHEDRON = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def _grid_faces(rows, columns, closed_rows=False, closed_columns=False, number=None):
    """Return the quads of a grid; `number` maps a row and a column to a vertex."""
    number = number or (lambda r, c: (r % rows) * columns + c % columns)
    return [
        (number(r, c), number(r + 1, c), number(r + 1, c + 1), number(r, c + 1))
        for r in range(rows - (not closed_rows))
        for c in range(columns - (not closed_columns))
    ]


def triangle(rng, size):
    """Return a single triangle."""
    return BrokenMesh(rng.random((3, 3)), [(0, 1, 2)])


def sheet(rng, size):
    """Return a wavy sheet of quads with a boundary."""
    n = size + 2
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    z = 0.3 * np.sin(4 * x + rng.random()) * np.cos(3 * y)
    return BrokenMesh(np.stack([x, y, z], -1).reshape(-1, 3), _grid_faces(n, n))


def ball(rng, size):
    """Return a closed bumpy ball with two poles."""
    rows, columns = size + 2, size + 4
    polar, azimuth = np.meshgrid(
        np.linspace(0, np.pi, rows + 2)[1:-1],
        np.linspace(0, 2 * np.pi, columns, endpoint=False),
        indexing="ij",
    )
    x, y = np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth)
    V = np.stack([x, y, np.cos(polar)], -1).reshape(-1, 3) * (1 + 0.3 * rng.random((x.size, 1)))
    faces = _grid_faces(rows, columns, closed_columns=True)
    north, south, last = len(V), len(V) + 1, (rows - 1) * columns
    for c in range(columns):
        faces.append((north, c, (c + 1) % columns))
        faces.append((south, last + (c + 1) % columns, last + c))
    return BrokenMesh(np.concatenate([V, [[0, 0, 1.2], [0, 0, -1.2]]]), faces)


def moebius(rng, size):
    """Return a Moebius strip: it cannot be oriented."""
    columns, rows = 6 * size + 3, 3
    t = np.linspace(0, 2 * np.pi, columns, endpoint=False)[:, None]
    s = np.linspace(-0.3, 0.3, rows)[None, :]
    radius = 1 + s * np.cos(t / 2)
    V = np.stack([radius * np.cos(t), radius * np.sin(t), s * np.sin(t / 2)], -1).reshape(-1, 3)

    def number(c, r):
        return c * rows + r if c < columns else rows - 1 - r

    return BrokenMesh(V, _grid_faces(columns, rows, closed_rows=True, number=number))


def book(rng, size):
    """Return pages on one edge, which has more than two faces."""
    pages = size + 2
    angles = np.sort(rng.random(pages)) * 2 * np.pi
    outer = [[[np.cos(a), np.sin(a), 0], [np.cos(a), np.sin(a), 1]] for a in angles]
    V = np.concatenate([[[0, 0, 0], [0, 0, 1]], np.array(outer).reshape(-1, 3)])
    return BrokenMesh(V, [(0, 1, 3 + 2 * p, 2 + 2 * p) for p in range(pages)])


def dust(rng, size):
    """Return tiny tetrahedra, far apart from each other in their own measure."""
    centres = rng.random((3 * size, 3))
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]) * 10.0 ** -rng.integers(2, 7)
    V = (centres[:, None] + corners).reshape(-1, 3)
    return BrokenMesh(
        V,
        [
            tuple(4 * part + i for i in face)
            for part in range(len(centres))
            for face in _TETRAHEDRON
        ],
    )


def soup(rng, size):
    """Return triangles between random vertices: anything may be connected with anything."""
    n = 4 * size + 3
    faces = [tuple(rng.choice(n, 3, replace=False).tolist()) for _ in range(6 * size)]
    return BrokenMesh(rng.random((n, 3)), faces)


def needles(rng, size):
    """Return a fan of triangles with angles down to 1e-9 radians."""
    n = 3 * size + 2
    angles = np.cumsum(10.0 ** -rng.integers(1, 10, n))
    rim = np.stack([np.cos(angles), np.sin(angles), 0.1 * rng.random(n)], -1)
    V = np.concatenate([np.zeros((1, 3)), rim])
    return BrokenMesh(V, [(0, k, k + 1) for k in range(1, n)])


def concave(rng, size):
    """Return one n-gon, a comb with deep notches."""
    teeth = size + 1
    outline = [(0.0, -0.2)]
    for tooth in range(teeth):
        outline += [(tooth, 1.0), (tooth + 0.5, rng.choice([1e-6, 0.1, 0.9]))]
    outline += [(float(teeth), 1.0), (float(teeth), -0.2)]
    V = np.array([(x / teeth, y, 0.05 * rng.random()) for x, y in outline])
    return BrokenMesh(V, [tuple(range(len(V)))])


def crossed(rng, size):
    """Return one n-gon that crosses itself, a star drawn in one go."""
    n = 2 * size + 3
    angles = 2 * np.pi * np.arange(n) * (n // 2) / n
    V = np.stack([np.cos(angles), np.sin(angles), np.zeros(n)], -1)
    return BrokenMesh(V, [tuple(range(n))])


def holed(rng, size):
    """Return one n-gon with a hole, which a bridge of two coincident edges leads to."""
    outer = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)], float)
    inner = np.array([(0.3, 0.3), (0.3, 0.7), (0.7, 0.7), (0.7, 0.3), (0.3, 0.3)], float)
    V = np.concatenate([outer, inner])
    return BrokenMesh(np.column_stack([V, np.zeros(10)]), [tuple(range(10))])


def double_cover(rng, size):
    """Return a sheet with every face twice, once from either side: all normals cancel out."""
    mesh = sheet(rng, size)
    return BrokenMesh(mesh.V, mesh.faces + [face[::-1] for face in mesh.faces])


def point(rng, size):
    """Return a tetrahedron without any extent."""
    return BrokenMesh(np.tile(rng.random(3), (4, 1)), list(_TETRAHEDRON))


PIECES = {
    piece.__name__: piece
    for piece in (
        *(triangle, sheet, ball, moebius, book, dust, soup, needles),
        *(concave, crossed, holed, double_cover, point),
    )
}

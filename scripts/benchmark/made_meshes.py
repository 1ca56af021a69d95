# SPDX-License-Identifier: GPL-3.0-or-later
"""What artists bring and the usual meshes are not: many parts, clothes, coarse cages."""

import numpy as np

from .meshes import keep
from .primitives import blob

GAP = 0.008
"""between a body and its clothes, of the height"""
WAIST = (-0.3, 0.4)
"""from where to where the body is clothed; its height is about 3"""
BALL = 0.2
"""radius of what is stuck to the body"""


def made_meshes(cache, fineness):
    """Return {name: Mesh} of all that is made.

    Parameters
    ----------
    cache : Path
    fineness : int
        Subdivisions of the bodies. With 6, character and dressed body have about 50,000 vertices;
        the coarse ones are always the same.
    """
    made = {
        "character": character(fineness),
        "dressed body": dressed_body(fineness),
        "coarse character": character(3),
        "sphere 16 x 8": sphere(16, 8),
        "sphere 64 x 32": sphere(64, 32),
    }
    return {name: keep(name, cache / f"made-{name}.npz", *mesh) for name, mesh in made.items()}


def character(fineness):
    """Return V (n,3) and F (m,3) of a body with twelve balls that touch it, each of its own."""
    V, F = blob(fineness)
    parts = [(V, F)]
    for at in V[:12]:  # the corners of the icosahedron lie all around
        ball, triangles = blob(fineness - 3)
        ball = BALL * ball / np.linalg.norm(ball, axis=1, keepdims=True)
        parts.append((ball + at + BALL * at / np.linalg.norm(at), triangles))
    return _joined(parts)


def dressed_body(fineness):
    """Return V and F of a body with a copy of its middle around it, like a shirt."""
    V, F = blob(fineness)
    a, b, c = (V[corner] for corner in F.T)
    normals = np.zeros_like(V)
    for corner in F.T:
        np.add.at(normals, corner, np.cross(b - a, c - a))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    height = V[F, 2].mean(axis=1)
    clothed = F[(height > WAIST[0]) & (height < WAIST[1])]
    used, triangles = np.unique(clothed, return_inverse=True)
    shirt = V[used] + GAP * np.ptp(V[:, 2]) * normals[used]
    return _joined([(V, F), (shirt, triangles.reshape(-1, 3))])


def sphere(segments, rings):
    """Return V and F of a sphere of meridians and parallels, with triangles at both poles."""
    polar = np.linspace(0, np.pi, rings + 1)[1:-1, None]
    around = np.arange(segments) * (2 * np.pi / segments)
    x, y = np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around)
    z = np.broadcast_to(np.cos(polar), x.shape)
    V = np.concatenate([np.stack([x, y, z], axis=-1).reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    here = np.arange(x.size).reshape(x.shape)
    beside = np.roll(here, -1, axis=1)
    top, bottom = np.full(segments, x.size), np.full(segments, x.size + 1)
    corners = [
        (here[:-1], here[1:], beside[1:]),
        (here[:-1], beside[1:], beside[:-1]),
        (top, here[0], beside[0]),
        (bottom, beside[-1], here[-1]),
    ]
    return V, np.concatenate([np.stack([a.ravel() for a in c], axis=1) for c in corners])


def _joined(parts):
    """Return meshes as the parts of one."""
    offsets = np.cumsum([0, *(len(V) for V, _ in parts)])[:-1]
    V = np.concatenate([V for V, _ in parts])
    return V, np.concatenate([F + k for (_, F), k in zip(parts, offsets, strict=True)])

# SPDX-License-Identifier: GPL-3.0-or-later
"""The forms that have names.

Each is given by the directions that its sides face, all equally far from the origin. So all are
convex: a star or an hourglass would be its convex hull. Where nothing else is asked for, the cube's
local step has code of its own, which is faster.
"""

import itertools
from collections.abc import Sequence
from functools import cache, partial

import numpy as np
from numpy.typing import ArrayLike

from ..errors import CubicCraftError
from ..inputs import real_numbers, whole_number
from .polytope import EXACT, Polytope, from_directions

GOLDEN = (1.0 + np.sqrt(5.0)) / 2.0
ROUND = 64
"""sides of a prism or pyramid that looks like a cylinder or cone"""
SLOPE = np.radians(30.0)
"""angle of the sides of a pyramid or cone above the horizontal that their normals have"""
LEAST_WEIGHT = 0.01
"""of a box; with 0 it would be flat"""
BEVEL = 0.25
"""width of the bevels of the rounded cube on its six sides, relative to its half size"""

_exactly = partial(from_directions, rounding=EXACT)


@cache
def cube() -> Polytope:
    """Return the cube as a body like all others, to draw it, and for meshes with other forms, too.

    It is made without SciPy, which may be missing where it is only drawn.
    """
    corners = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
    return Polytope(np.concatenate([np.eye(3), -np.eye(3)]), np.ones(6), corners, EXACT)


def box(weights: ArrayLike) -> Polytope:
    """Return the box with these half sizes (3,): the costs of normals along its three axes.

    With equal weights it is the cube. With (1, 1, 0), only horizontal surfaces cost nothing, so
    that slabs form; with (0, 0, 1), walls become vertical, but keep their outline.
    """
    sizes = np.maximum(real_numbers(weights, "the weights of a box"), LEAST_WEIGHT)
    if sizes.shape != (3,):
        raise CubicCraftError(f"the weights of a box must be three numbers, not {sizes.shape}")
    body = _exactly(np.concatenate([np.eye(3), -np.eye(3)]), np.tile(sizes, 2))
    return body.scaled(sizes.min() / body.offsets.min())


def rounded_cube() -> Polytope:
    """Return the cube with bevels at its edges and corners: 26 sides.

    The bevels of edges are rectangles and those of corners triangles, which share their corners.
    """
    edges = _cyclic([(a, b, 0) for a, b in _signs(2)])
    directions = np.concatenate([np.eye(3), -np.eye(3), edges, _signs(3)])
    corner = np.array([1.0, 1.0 - BEVEL, 1.0 - BEVEL])
    offsets = -np.sort(-np.abs(directions), axis=1) @ corner
    return _exactly(directions, offsets / np.linalg.norm(directions, axis=1))


def octahedron() -> Polytope:
    """Return the form with eight sides."""
    return _exactly(list(itertools.product((-1, 1), repeat=3)))


def tetrahedron() -> Polytope:
    """Return the form with four sides."""
    corners = itertools.product((-1, 1), repeat=3)
    return _exactly([corner for corner in corners if np.prod(corner) > 0])


def dodecahedron() -> Polytope:
    """Return the form with twelve pentagons."""
    return _exactly(_cyclic([(0, a, b * GOLDEN) for a, b in _signs(2)]))


def icosahedron() -> Polytope:
    """Return the form with twenty triangles."""
    rings = _cyclic([(0, a / GOLDEN, b * GOLDEN) for a, b in _signs(2)])
    return _exactly(_signs(3) + rings)


def rhombic_dodecahedron() -> Polytope:
    """Return the form with twelve rhombi."""
    return _exactly(_cyclic([(a, b, 0) for a, b in _signs(2)]))


def prism(sides: int) -> Polytope:
    """Return the form with so many walls around Z, and two caps."""
    return _exactly([*_ring(sides), (0, 0, 1), (0, 0, -1)])


def pyramid(sides: int) -> Polytope:
    """Return the form with so many slopes around Z, and a base."""
    slopes = [(np.cos(SLOPE) * x, np.cos(SLOPE) * y, np.sin(SLOPE)) for x, y, _ in _ring(sides)]
    return _exactly([*slopes, (0, 0, -1)])


cylinder, cone = partial(prism, ROUND), partial(pyramid, ROUND)

PLAIN = {
    "rounded": rounded_cube,
    "octahedron": octahedron,
    "tetrahedron": tetrahedron,
    "dodecahedron": dodecahedron,
    "icosahedron": icosahedron,
    "rhombic": rhombic_dodecahedron,
    "cylinder": cylinder,
    "cone": cone,
}
"""forms without settings by their names"""
WITH_SIDES = {"prism": prism, "pyramid": pyramid}
"""forms with a number of sides"""


def named(name: str, sides: int = 6, weights: Sequence[float] = (1.0, 1.0, 1.0)) -> Polytope | None:
    """Return the form of a name, None for the cube.

    `name`: "cube", "box", or one of `PLAIN` and `WITH_SIDES`. `sides`, `weights`: of the forms that
    have them. Raises CubicCraftError: there is no such form.
    """
    if name == "cube":
        return None
    if name == "box":
        return None if all(weight == 1.0 for weight in weights) else box(weights)
    if name in WITH_SIDES:
        return WITH_SIDES[name](sides)
    if name not in PLAIN:
        names = ", ".join(["cube", "box", *PLAIN, *WITH_SIDES])
        raise CubicCraftError(f"there is no form {name!r}; give one of {names}, or a Polytope")
    return PLAIN[name]()


def _signs(count):
    return list(itertools.product((-1, 1), repeat=count))


def _cyclic(vectors):
    return [(v[k], v[(k + 1) % 3], v[(k + 2) % 3]) for v in vectors for k in range(3)]


def _ring(sides):
    sides = whole_number(sides, "the number of sides of a form", 3)
    angles = 2.0 * np.pi * np.arange(sides) / sides
    return [(np.cos(angle), np.sin(angle), 0.0) for angle in angles]

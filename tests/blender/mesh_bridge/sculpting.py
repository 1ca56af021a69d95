# SPDX-License-Identifier: GPL-3.0-or-later
"""What a hand does to a result, and all of its shapes to compare."""

import numpy as np
from rich_mesh import points_of, position_of

SHAPE_TOLERANCE = 2e-6  # of the coordinates, a few roundings


def sculpt(obj, rows=slice(40, 60), change=(0.1, -0.2, 0.3)):
    """Move vertices; their shape keys follow, as they do in Sculpt Mode."""
    mesh = obj.data
    for key in mesh.shape_keys.key_blocks if mesh.shape_keys else ():
        for point in key.points[rows]:
            point.co = np.add(point.co, change)
    for vertex in mesh.vertices[rows]:
        vertex.co = np.add(vertex.co, change)
    mesh.update()


def shapes_of(obj):
    """Return the positions, and the points of all shape keys."""
    keys = obj.data.shape_keys
    names = keys.key_blocks.keys() if keys else []
    return [position_of(obj.data), *(points_of(obj.data, name) for name in names)]


def check_near(shapes, expected, tolerance=SHAPE_TOLERANCE):
    for points, others in zip(shapes, expected, strict=True):
        np.testing.assert_allclose(points, others, atol=tolerance)


def check_bits(shapes, expected):
    for points, others in zip(shapes, expected, strict=True):
        assert points.tobytes() == others.tobytes()

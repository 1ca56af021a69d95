# SPDX-License-Identifier: GPL-3.0-or-later
"""How cubic a surface is: which way its triangles face."""

import numpy as np

from solver import triangle_areas_and_normals

AXES = np.concatenate([np.eye(3), -np.eye(3)])


def share_facing(V, F, directions=AXES, degrees=6.0):
    """Return the share of the area that lies within so many degrees of one of the directions."""
    areas, normals = triangle_areas_and_normals(V, F)
    is_near = (normals @ directions.T).max(axis=1) > np.cos(np.radians(degrees))
    return areas[is_near].sum() / areas.sum()


def angle_to_axes(V, F):
    """Return the mean angle of the normals to the nearest axis, in degrees, by area."""
    areas, normals = triangle_areas_and_normals(V, F)
    largest = np.minimum(np.abs(normals).max(axis=1), 1.0)
    return np.degrees(np.average(np.arccos(largest), weights=areas))


def squareness(V):
    """Return how much farther the corners are from the middle than the sides; sqrt(2) at most."""
    radius, angle = np.linalg.norm(V[:, :2], axis=1), np.arctan2(V[:, 1], V[:, 0])
    quarter = np.abs((angle + np.pi / 4) % (np.pi / 2) - np.pi / 4)
    return radius[quarter > np.pi / 4 - 0.1].max() / radius[quarter < 0.1].max()

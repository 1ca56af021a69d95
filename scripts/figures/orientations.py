# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 6: one mesh, cubified toward cubes of different orientation, each drawn around it."""

import math

import bpy
import numpy as np
from headless.gallery import Group
from headless.studio import surface
from mathutils import Euler, Matrix, Vector

from .picture import Picture, side_by_side
from .workshop import Model, Workshop, moved

__all__ = ("compose",)

CUBENESS = 0.4
ORIENTATIONS = (
    # Euler angles in degrees, relative to the mesh stood upright
    (0.0, 0.0, 0.0),
    (0.0, 0.0, 45.0),
    (45.0, 0.0, 0.0),
    (0.0, 45.0, 0.0),
)
HEIGHT = 640
"""pixels"""
MARGIN = 1.08
"""how much larger the cube is than the shape"""
THICKNESS = 0.012
"""of the cube's edges, relative to the edge"""
EDGES = (0.05, 0.06, 0.07)
"""linear RGB"""


def compose(workshop: Workshop) -> Picture:
    """Stand the cubic versions in a row, each in the frame that it is turned toward."""
    (model,) = workshop.there(["bunny"], instead=["monkey"])
    edges = surface("Frame", EDGES, roughness=0.6)
    groups = []
    for angles in ORIENTATIONS:
        shape = workshop.cubified(model, CUBENESS, angles)
        label = " ".join(f"{angle:g}\N{DEGREE SIGN}" for angle in angles)
        group = workshop.group(model, shape, label, "green")
        _add_frame(group, model, shape, angles, edges)
        groups.append(group)
    return side_by_side(groups, HEIGHT)


def _add_frame(
    group: Group,
    model: Model,
    shape: np.ndarray,
    angles: tuple[float, float, float],
    edges: bpy.types.Material,
) -> None:
    """Draw the cube as a frame around the shape (n,3), in object space."""
    axes = Euler([math.radians(angle) for angle in angles]).to_matrix()
    along = shape @ np.array(axes)
    low, high = along.min(axis=0), along.max(axis=0)
    half = float((high - low).max()) / 2 * MARGIN
    centre = axes @ Vector((low + high) / 2)
    frame = _cube(half)
    frame.data.materials.append(edges)
    place = model.place @ Matrix.Translation(centre) @ axes.to_4x4()
    group.copies.append(frame)
    group.places.append(place)
    corners = np.array([vertex.co for vertex in frame.data.vertices])
    group.points = np.concatenate([group.points, moved(corners, place)])


def _cube(half: float) -> bpy.types.Object:
    """Return a cube's edges as bars, in no scene."""
    signs = (-half, half)
    corners = [(x, y, z) for x in signs for y in signs for z in signs]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    mesh = bpy.data.meshes.new("Frame")
    mesh.from_pydata(corners, [], faces)
    frame = bpy.data.objects.new("Frame", mesh)
    bars = frame.modifiers.new("Bars", "WIREFRAME")
    bars.thickness = 2.0 * half * THICKNESS
    bars.offset = 0.0
    return frame

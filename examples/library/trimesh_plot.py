# SPDX-License-Identifier: GPL-3.0-or-later
"""A torus of trimesh at growing cubeness, colored by the angles that remain to the nearest axes.

It needs no Blender, but the library, trimesh and Matplotlib:
python examples/library/trimesh_plot.py plot.png
"""

import sys

import numpy as np
import trimesh
from matplotlib import cm
from matplotlib.figure import Figure

from cubic_craft import stylize_mesh

CUBENESS = (0.0, 0.1, 0.4, 1.0)
LARGEST_ANGLE = 55.0  # degrees, between a diagonal and the axes


def angles(mesh):
    """Return the angle between each triangle and the nearest side of a cube in degrees, (m,)."""
    return np.degrees(np.arccos(np.abs(mesh.face_normals).max(axis=1).clip(0.0, 1.0)))


torus = trimesh.creation.torus(1.0, 0.45, major_sections=64, minor_sections=32)
figure = Figure(figsize=(12, 3.2), layout="constrained")
for number, cubeness in enumerate(CUBENESS, start=1):
    result = stylize_mesh(torus, cubeness)
    axes = figure.add_subplot(1, len(CUBENESS), number, projection="3d")
    surface = axes.plot_trisurf(*result.vertices.T, triangles=result.faces, antialiased=False)
    surface.set_facecolor(cm.viridis(angles(result) / LARGEST_ANGLE))
    axes.set_box_aspect(result.extents.copy(), zoom=1.25)
    axes.set_axis_off()
    axes.set_title(f"cubeness {cubeness:g}: {angles(result).mean():.0f}° on average")
figure.savefig(sys.argv[1], dpi=100)

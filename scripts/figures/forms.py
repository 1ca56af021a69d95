# SPDX-License-Identifier: GPL-3.0-or-later
"""Forms: one mesh as each of them."""

import numpy as np

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group
from cubic_craft.cubic_craft_addon.command_line.reading.form_mesh import FormMesh, make_form
from cubic_craft.cubic_craft_addon.mesh_bridge import shade_shape
from cubic_craft.cubic_craft_addon.settings.values import Settings

from .figure_meshes import FigureMeshes

CUBENESS = 0.6
HOUSE = ((-0.6, -0.5), (0.6, -0.5), (0.6, 0.3), (0.0, 0.8), (-0.6, 0.3))
"""outline of the object that a form is made from, seen along Y"""
HALF_LENGTH = 0.7
"""along Y"""
FORMS = {
    "cube": {"form": "CUBE"},
    "box, weights 0.6 0.6 1": {"form": "BOX", "form_weights": (0.6, 0.6, 1.0)},
    "octahedron": {"form": "OCTAHEDRON"},
    "tetrahedron": {"form": "TETRAHEDRON"},
    "dodecahedron": {"form": "DODECAHEDRON"},
    "icosahedron": {"form": "ICOSAHEDRON"},
    "rhombic dodecahedron": {"form": "RHOMBIC"},
    "prism, 6 sides": {"form": "PRISM", "form_sides": 6},
    "pyramid, 4 sides": {"form": "PYRAMID", "form_sides": 4},
    "cylinder": {"form": "CYLINDER"},
    "cone": {"form": "CONE"},
    "object: a house": {"form": "OBJECT"},
}
"""label: settings"""


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return the versions of Blender's own bear, whatever meshes there are."""
    (model,) = meshes.there([], instead=["bear"])
    house = make_form(_house())
    groups = []
    for label, settings in FORMS.items():
        own = {"form_object": house} if settings["form"] == "OBJECT" else {}
        shape = meshes.cubified(model, CUBENESS, **settings, **own)
        groups.append(meshes.group(model, shape, label, "green"))
        shade_shape(groups[-1].copies[0], {"crispness": Settings.crispness})
    return groups


def _house() -> FormMesh:
    points = [(x, y, z) for y in (-HALF_LENGTH, HALF_LENGTH) for x, z in HOUSE]
    count = len(HOUSE)
    ends = [(0, k, k + 1) for k in range(1, count - 1)]
    sides = [(k, (k + 1) % count, k + count) for k in range(count)]
    return FormMesh(np.array(points), np.array(ends + sides))

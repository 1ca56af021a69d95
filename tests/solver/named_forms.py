# SPDX-License-Identifier: GPL-3.0-or-later
"""All forms that have names, and the cube as one of them."""

from solver.styles import forms

POLYTOPES = {
    "cube": forms.cube,
    "box": lambda: forms.box((1, 2, 3)),
    "slab": lambda: forms.box((1, 1, 0)),
    "pillar": lambda: forms.box((0, 0, 1)),
    "rounded cube": forms.rounded_cube,
    "octahedron": forms.octahedron,
    "tetrahedron": forms.tetrahedron,
    "dodecahedron": forms.dodecahedron,
    "icosahedron": forms.icosahedron,
    "rhombic dodecahedron": forms.rhombic_dodecahedron,
    "prism of 3": lambda: forms.prism(3),
    "prism of 5": lambda: forms.prism(5),
    "prism of 6": lambda: forms.prism(6),
    "prism of 8": lambda: forms.prism(8),
    "pyramid": lambda: forms.pyramid(4),
    "cylinder": forms.cylinder,
    "cone": forms.cone,
}

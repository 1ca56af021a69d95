# SPDX-License-Identifier: GPL-3.0-or-later
"""All forms that have names, and the cube as one of them."""

import numpy as np

from solver.styles import forms
from solver.styles.polytope import from_directions

POLYTOPES = {
    "cube": lambda: from_directions(np.concatenate([np.eye(3), -np.eye(3)])),
    "box": lambda: forms.box((1, 2, 3)),
    "slab": lambda: forms.box((1, 1, 0)),
    "pillar": lambda: forms.box((0, 0, 1)),
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

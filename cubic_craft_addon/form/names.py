# SPDX-License-Identifier: GPL-3.0-or-later
"""The forms that an artist can choose: what a ball would become."""

OF_OBJECT = ("OBJECT", "DIRECTIONS")
"""those that take another object"""
WITH_SIDES = ("PRISM", "PYRAMID")
"""those with a number of sides"""

FORM_SETTINGS = ("form_sides", "form_weights", "form_object", "form_directions")
"""further settings, of which each form has those of `form_settings`"""

# Only append: the place of a form is its number in files.
FORMS = (
    ("CUBE", "Cube", "Six squares, as in the paper"),
    ("BOX", "Box", "A cube with a strength of its own along each axis, for pillars and slabs"),
    ("ROUNDED", "Rounded Cube", "A cube with bevels at its edges and corners"),
    ("OCTAHEDRON", "Octahedron", "Eight triangles, like a cut gem"),
    ("TETRAHEDRON", "Tetrahedron", "Four triangles"),
    ("DODECAHEDRON", "Dodecahedron", "Twelve pentagons"),
    ("ICOSAHEDRON", "Icosahedron", "Twenty triangles"),
    ("RHOMBIC", "Rhombic Dodecahedron", "Twelve rhombi, like a garnet"),
    ("PRISM", "Prism", "Walls around the Z axis, and two caps"),
    ("PYRAMID", "Pyramid", "Slopes around the Z axis, and a base"),
    ("CYLINDER", "Cylinder", "A round wall and two caps"),
    ("CONE", "Cone", "A round slope and a base"),
    ("OBJECT", "Object", "The convex hull of another object, about its origin"),
    ("DIRECTIONS", "Directions", "The directions that the faces of another object face"),
    ("FACES", "Selected Faces", "The directions that faces of this mesh face, picked in Edit Mode"),
)


def form_settings(form: str) -> list[str]:
    """Return the names of the further settings of a form."""
    names = []
    if form in WITH_SIDES:
        names.append("form_sides")
    if form == "BOX":
        names.append("form_weights")
    if form in OF_OBJECT:
        names.append("form_object")
    if form == "FACES":
        names.append("form_directions")
    return names

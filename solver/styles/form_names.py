# SPDX-License-Identifier: GPL-3.0-or-later
"""The forms that can be asked for by name: what a ball would become."""

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
WITH_SIDES = ("PRISM", "PYRAMID")
"""forms with a number of sides"""
OF_OBJECT = ("OBJECT", "DIRECTIONS")
"""forms that are made from another object, or from a file"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of one mesh in several versions: of each, its settings and what stands beside it."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import bmesh
import bpy
import numpy as np
from mathutils import Euler, Matrix

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group
from cubic_craft.cubic_craft_addon.command_line.picture.studio import FINISHES, surface
from cubic_craft.cubic_craft_addon.command_line.reading.form_mesh import FormMesh, make_form
from cubic_craft.cubic_craft_addon.mesh_bridge import shade_shape
from cubic_craft.cubic_craft_addon.settings.values import Settings

from .figure_meshes import AS_IN_THE_PAPER, FigureMeshes, stand_beside

HOUSE = ((-0.6, -0.5), (0.6, -0.5), (0.6, 0.3), (0.0, 0.8), (-0.6, 0.3))
"""outline of the object that a form is made from, seen along Y"""
HALF_LENGTH = 0.7
"""along Y"""
CUBE = 0.2
"""edge of what stands beside a mesh, relative to its largest side"""
BEVEL = 0.06
"""relative to the edge"""


class Version(NamedTuple):
    """A version of the mesh."""

    label: str
    settings: dict[str, Any]
    """the orientation in degrees, relative to the mesh"""
    beside: bpy.types.Object | None = None
    """what stands beside it, turned as the form"""
    size: float = 1.0
    """of that, relative to the largest side of the mesh"""


def compose(
    meshes: FigureMeshes,
    name: str,
    instead: str,
    versions: Callable[[], list[Version]],
    *,
    has_original: bool = True,
    is_shaded: bool = False,
) -> list[Group]:
    """Return the original, if it is to be seen, and the versions.

    `name`: of the mesh; if it is not there, the shape `instead`. `is_shaded`: as Cubify shades the
    results.
    """
    (model,) = meshes.there([name], instead=[instead])
    groups = [meshes.group(model, model.original, "original", "grey")] if has_original else []
    for label, settings, beside, size in versions():
        group = meshes.group(model, meshes.cubified(model, **settings), label, "green")
        if is_shaded:
            shade_shape(group.copies[0], {"crispness": Settings.crispness, **settings})
        if beside is not None:
            angles = map(math.radians, settings.get("orientation", (0.0, 0.0, 0.0)))
            axes = model.place.to_3x3().normalized() @ Euler(tuple(angles)).to_matrix()
            stand_beside(group, beside, axes.to_4x4() @ Matrix.Scale(size * group.extent, 4))
        groups.append(group)
    return groups


def by_cubeness() -> list[Version]:
    """Return growing cubeness, as in the paper."""
    values = (0.03, 0.1, 0.4, 1.5)
    return [Version(f"cubeness {x:g}", {**AS_IN_THE_PAPER, "cubeness": x}) for x in values]


def by_crispness() -> list[Version]:
    """Return soft to crisp; the one between has the defaults."""
    looks = {"soft": {"crispness": 0.0, "solidity": 0.1}, "cubic": {}, "crisp": {"crispness": 1.0}}
    return [Version(name, {"cubeness": 0.4, **settings}) for name, settings in looks.items()]


def by_orientation() -> list[Version]:
    """Return cubes of different orientation, as in the paper, with each cube."""
    clay = surface("Cube", *FINISHES["clay"])
    degree, corner = "\N{DEGREE SIGN}", math.degrees(math.atan(math.sqrt(0.5)))
    orientations = {
        "not turned": (0.0, 0.0, 0.0),
        f"45{degree} about Z": (0.0, 0.0, 45.0),
        f"45{degree} about X": (45.0, 0.0, 0.0),
        "on a corner": (45.0, corner, 0.0),
    }
    # Left free, the whole mesh would turn toward the cube.
    settings = AS_IN_THE_PAPER | {"rotation": "KEEP", "cubeness": 0.6}
    return [
        Version(label, {**settings, "orientation": angles}, _cube(clay), CUBE)
        for label, angles in orientations.items()
    ]


def by_form() -> list[Version]:
    """Return all forms that need no choice of the artist, and one from an object."""
    forms = {
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
        "object: a house": {"form": "OBJECT", "form_object": _house()},
    }
    return [Version(label, {"cubeness": 0.6, **form}) for label, form in forms.items()]


def _cube(clay: bpy.types.Material) -> bpy.types.Object:
    edited = bmesh.new()
    bmesh.ops.create_cube(edited, size=1.0)
    cube = _object("Cube", edited, clay)
    bevel = cube.modifiers.new("Bevel", "BEVEL")
    bevel.width, bevel.segments = BEVEL, 3
    return cube


def _object(name: str, edited: bmesh.types.BMesh, material: bpy.types.Material) -> bpy.types.Object:
    mesh = bpy.data.meshes.new(name)
    edited.to_mesh(mesh)
    edited.free()
    mesh.materials.append(material)
    return bpy.data.objects.new(name, mesh)


def _house() -> bpy.types.Object:
    points = [(x, y, z) for y in (-HALF_LENGTH, HALF_LENGTH) for x, z in HOUSE]
    count = len(HOUSE)
    ends = [(0, k, k + 1) for k in range(1, count - 1)]
    sides = [(k, (k + 1) % count, k + count) for k in range(count)]
    return make_form(FormMesh(np.array(points), np.array(ends + sides)))

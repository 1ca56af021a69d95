# SPDX-License-Identifier: GPL-3.0-or-later
"""What each figure shows: groups for a gallery, whose copies are in no scene yet."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import bmesh
import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import (
    ELEVATION,
    UP,
    Gallery,
    Group,
    outline,
    stand,
)
from cubic_craft.cubic_craft_addon.command_line.picture.studio import FINISHES, surface
from cubic_craft.cubic_craft_addon.command_line.reading.form_mesh import FormMesh, make_form
from cubic_craft.cubic_craft_addon.mesh_bridge import shade_shape
from cubic_craft.cubic_craft_addon.settings.values import Settings

from .figure_meshes import AS_IN_THE_PAPER, FigureMeshes, colored_by, stand_beside

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples"

CAST = {"owl": 0.4, "bunny": 0.4, "armadillo": 0.4, "spot": 0.4, "horse": 0.4}
OWN_CAST = {"bear": 0.4, "monkey": 0.4, "fox": 0.4}
"""of the teaser, name: cubeness"""
GAP = 0.35
"""between neighbors, in the units of the gallery"""
ROWS_APART = 0.25
"""in the picture, between the top of the front row and the bottom of the back row"""
UV_CUBENESS = 0.7
PIXELS = 2048
ROUGHNESS = 0.5
"""of the texture"""
POSES = {
    "bunny": (EXAMPLES / "bunny_ears.json", 0.2),
    "armadillo": (EXAMPLES / "armadillo_dance.json", 0.2),
    "monkey": (EXAMPLES / "monkey_ears.json", 0.4),
    "bear": (HERE / "bear_nod.json", 0.4),
}
"""name: file of handles, cubeness"""
HELD = (0.03, 0.06, 0.22)
MOVED = (0.85, 0.19, 0.02)
"""linear RGB of the vertices of handles that stay and that are moved"""
HOUSE = ((-0.6, -0.5), (0.6, -0.5), (0.6, 0.3), (0.0, 0.8), (-0.6, 0.3))
"""outline of the object that a form is made from, seen along Y"""
HALF_LENGTH = 0.7
"""along Y"""
CUBE = 0.2
"""edge of what stands beside a mesh, relative to its largest side"""
BEVEL = 0.06
"""relative to the edge"""


def teaser(meshes: FigureMeshes) -> list[Group]:
    """Return several meshes in gray, and after each its cubic version in green."""
    groups = []
    for model in meshes.there(list(CAST), instead=list(OWN_CAST)):
        shape = meshes.cubified(model, (CAST | OWN_CAST)[model.name])
        groups.append(meshes.group(model, model.original, f"{model.name}, original", "grey"))
        groups.append(meshes.group(model, shape, f"{model.name}, cubic", "green"))
    return groups


def in_two_rows(
    groups: list[Group], scene: bpy.types.Scene, _resolution: tuple[int, int]
) -> Gallery:
    """Stand the originals in a row, and the cubic versions in one before it."""
    outlines = [outline(group, turns=False) for group in groups]  # left, right, bottom, top
    backs, fronts = outlines[::2], outlines[1::2]
    lift = max(front[3] for front in fronts) + ROWS_APART - min(back[2] for back in backs)
    x, turntables = 0.0, []
    for number, (back, front) in enumerate(zip(backs, fronts, strict=True)):
        left, right = min(back[0], front[0]), max(back[1], front[1])
        for group, y in zip(groups[2 * number :], (lift / math.sin(ELEVATION), 0.0), strict=False):
            turntables.append(stand(group, Vector((x - left, y, 0.0)), scene))
        x += right - left + GAP
    bottom, top = min(front[2] for front in fronts), lift + max(back[3] for back in backs)
    center = Vector(((x - GAP) / 2, 0.0, 0.0)) + UP * ((bottom + top) / 2)
    finishes = [group.finish for group in groups]
    return Gallery(scene, turntables, center, x, top - bottom + GAP, finishes)


def uv_texture(meshes: FigureMeshes) -> list[Group]:
    """Return a mesh with Blender's own test grid, which its UVs let go along, before and after."""
    (model,) = meshes.there(["spot"], instead=["monkey"])
    shape = meshes.cubified(model, UV_CUBENESS)
    grid = bpy.data.images.new("Grid", PIXELS, PIXELS)
    grid.generated_type = "COLOR_GRID"
    grid.pack()
    material = colored_by("ShaderNodeTexImage", ROUGHNESS, image=grid)
    groups = []
    for positions, label in ((model.original, "original"), (shape, f"cubeness {UV_CUBENESS:g}")):
        group = meshes.group(model, positions, label, "grey")
        _paint(group, material)
        groups.append(group)
    return groups


def handles(meshes: FigureMeshes) -> list[Group]:
    """Return each mesh at rest, and posed and cubic, with its handles colored."""
    groups = []
    for model in meshes.there(["bunny", "armadillo"], instead=["monkey", "bear"]):
        file, cubeness = POSES[model.name]
        held = meshes.handles(model, file)
        posed = meshes.cubified(model, cubeness, handles=held)
        label = f"posed, cubeness {cubeness:g}"
        for group in (
            meshes.group(model, model.original, "original, its handles", "grey"),
            meshes.group(model, posed, label, "green"),
        ):
            _color(group, held)
            groups.append(group)
    return groups


def _color(group: Group, handles: tuple[Any, ...]) -> None:
    mesh = group.copies[0].data
    color, roughness = FINISHES[group.finish]
    colors = np.ones((len(mesh.vertices), 4), np.float32)
    colors[:, :3] = color
    for handle in reversed(handles):  # where they overlap, the first counts
        is_still = np.array_equal(np.reshape(handle.matrix, (4, 4)), np.eye(4))
        colors[list(handle.vertices), :3] = HELD if is_still else MOVED
    attribute = mesh.attributes.new("Handles", "FLOAT_COLOR", "POINT")
    attribute.data.foreach_set("color", colors.ravel())
    _paint(group, colored_by("ShaderNodeAttribute", roughness, attribute_name="Handles"))


def _paint(group: Group, material: bpy.types.Material) -> None:
    materials = group.copies[0].data.materials
    materials.clear()
    materials.append(material)


class Version(NamedTuple):
    """A version of the mesh."""

    label: str
    settings: dict[str, Any]
    """the orientation in degrees, relative to the mesh"""
    beside: bpy.types.Object | None = None
    """what stands beside it, turned as the form"""
    size: float = 1.0
    """of that, relative to the largest side of the mesh"""


def versions_of(
    meshes: FigureMeshes,
    *,
    name: str,
    instead: str = "",
    versions: Callable[[], list[Version]],
    has_original: bool = True,
    is_shaded: bool = False,
) -> list[Group]:
    """Return the original, if it is to be seen, and the versions.

    `name`: of the mesh; if its file is not there, the shape `instead`. `is_shaded`: as Cubify
    shades the results.
    """
    (model,) = meshes.there([name], instead=[instead or name])
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

# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 3: meshes that are posed by handles while they become cubic."""

from pathlib import Path
from typing import Any

import bpy
import numpy as np

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group
from cubic_craft.cubic_craft_addon.command_line.picture.studio import FINISHES

from .figure_meshes import FigureMeshes, colored_by

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples"
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


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return each mesh at rest, and posed and cubic, with its handles colored."""
    groups = []
    for model in meshes.there(["bunny", "armadillo"], instead=["monkey", "bear"]):
        file, cubeness = POSES[model.name]
        handles = meshes.handles(model, file)
        posed = meshes.cubified(model, cubeness, handles=handles)
        label = f"posed, cubeness {cubeness:g}"
        for group in (
            meshes.group(model, model.original, "original, its handles", "grey"),
            meshes.group(model, posed, label, "green"),
        ):
            _color(group.copies[0].data, group.finish, handles)
            groups.append(group)
    return groups


def _color(mesh: bpy.types.Mesh, finish: str, handles: tuple[Any, ...]) -> None:
    color, roughness = FINISHES[finish]
    colors = np.ones((len(mesh.vertices), 4), np.float32)
    colors[:, :3] = color
    for handle in reversed(handles):  # where they overlap, the first counts
        is_still = np.array_equal(np.reshape(handle.matrix, (4, 4)), np.eye(4))
        colors[list(handle.vertices), :3] = HELD if is_still else MOVED
    attribute = mesh.attributes.new("Handles", "FLOAT_COLOR", "POINT")
    attribute.data.foreach_set("color", colors.ravel())
    mesh.materials.clear()
    mesh.materials.append(colored_by("ShaderNodeAttribute", roughness, attribute_name="Handles"))

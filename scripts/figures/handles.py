# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 3: meshes that are posed by handles while they become cubic."""

from typing import Any

import bpy
import numpy as np
from headless.studio import FINISHES, surface

from .figure_meshes import FigureMeshes
from .picture import Picture, side_by_side

__all__ = ("compose",)

POSES = {
    "bunny": ("examples/bunny_ears.json", 0.2),
    "armadillo": ("examples/armadillo_dance.json", 0.2),
}
OWN_POSES = {
    "monkey": ("examples/monkey_ears.json", 0.4),
    "bear": ("scripts/figures/bear_nod.json", 0.4),
}
"""name: file of handles, cubeness"""
HELD = (0.03, 0.06, 0.22)
MOVED = (0.85, 0.19, 0.02)
"""linear RGB of the vertices of handles that stay and that are moved"""
HEIGHT = 560
"""pixels"""


def compose(meshes: FigureMeshes) -> Picture:
    """Show each mesh at rest, and posed and cubic, with its handles coloured."""
    groups = []
    for model in meshes.there(list(POSES), instead=list(OWN_POSES)):
        name, cubeness = (POSES | OWN_POSES)[model.name]
        handles = meshes.handles(model, meshes.root / name)
        posed = meshes.cubified(model, cubeness, handles=handles)
        label = f"posed, cubeness {cubeness:g}"
        for group in (
            meshes.group(model, model.original, "original, its handles", "grey"),
            meshes.group(model, posed, label, "green"),
        ):
            _colour(group.copies[0].data, group.finish, handles)
            groups.append(group)
    return side_by_side(groups, HEIGHT)


def _colour(mesh: bpy.types.Mesh, finish: str, handles: tuple[Any, ...]) -> None:
    """Paint the vertices of the handles onto a finish."""
    color, roughness = FINISHES[finish]
    colors = np.ones((len(mesh.vertices), 4), np.float32)
    colors[:, :3] = color
    for handle in reversed(handles):  # where they overlap, the first counts
        is_still = np.array_equal(np.reshape(handle.matrix, (4, 4)), np.eye(4))
        colors[list(handle.vertices), :3] = HELD if is_still else MOVED
    attribute = mesh.attributes.new("Handles", "FLOAT_COLOR", "POINT")
    attribute.data.foreach_set("color", colors.ravel())
    mesh.materials.clear()
    mesh.materials.append(_painted(roughness))


def _painted(roughness: float) -> bpy.types.Material:
    """Return a material whose colour is the attribute of `_colour`."""
    material = surface("Handles", HELD, roughness)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    colors = nodes.new("ShaderNodeAttribute")
    colors.attribute_name = "Handles"
    links.new(colors.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    return material

# SPDX-License-Identifier: GPL-3.0-or-later
"""One mesh at growing cubeness: figure 5, and the README's first picture."""

from typing import Any

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group

from .figure_meshes import AS_IN_THE_PAPER, FigureMeshes, Model

__all__ = ("compose", "compose_character")

CUBENESS = (0.03, 0.1, 0.4, 1.5)
OF_CHARACTER = (0.2, 0.4, 1.0)


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return the original and its cubic versions, as in the paper."""
    (model,) = meshes.there(["bunny"], instead=["monkey"])
    return _growing(meshes, model, CUBENESS, **AS_IN_THE_PAPER)


def compose_character(meshes: FigureMeshes) -> list[Group]:
    """Return a character and its cubic versions, at the default settings."""
    (model,) = meshes.there([], instead=["fox"])
    return _growing(meshes, model, OF_CHARACTER)


def _growing(
    meshes: FigureMeshes, model: Model, cubeness: tuple[float, ...], **settings: Any
) -> list[Group]:
    groups = [meshes.group(model, model.original, "original", "grey")]
    for value in cubeness:
        shape = meshes.cubified(model, value, **settings)
        groups.append(meshes.group(model, shape, f"cubeness {value:g}", "green"))
    return groups

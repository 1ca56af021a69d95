# SPDX-License-Identifier: GPL-3.0-or-later
"""The README's first picture: a character at growing cubeness, at the default settings."""

from headless.gallery import Group

from .figure_meshes import FigureMeshes

__all__ = ("compose",)

CUBENESS = (0.2, 0.4, 1.0)


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return the original and its cubic versions."""
    (model,) = meshes.there([], instead=["fox"])
    groups = [meshes.group(model, model.original, "original", "grey")]
    for value in CUBENESS:
        shape = meshes.cubified(model, value)
        groups.append(meshes.group(model, shape, f"cubeness {value:g}", "green"))
    return groups

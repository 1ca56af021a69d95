# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 5: one mesh at growing cubeness."""

from headless.gallery import Group

from .figure_meshes import AS_IN_THE_PAPER, FigureMeshes

__all__ = ("compose",)

CUBENESS = (0.03, 0.1, 0.4, 1.5)


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return the original and its cubic versions."""
    (model,) = meshes.there(["bunny"], instead=["monkey"])
    groups = [meshes.group(model, model.original, "original", "grey")]
    for value in CUBENESS:
        shape = meshes.cubified(model, value, **AS_IN_THE_PAPER)
        groups.append(meshes.group(model, shape, f"cubeness {value:g}", "green"))
    return groups

# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 5: one mesh at growing cubeness."""

from .figure_meshes import AS_IN_THE_PAPER, FigureMeshes
from .picture import Picture, side_by_side

__all__ = ("compose",)

CUBENESS = (0.03, 0.1, 0.4, 1.5)
HEIGHT = 460
"""pixels"""


def compose(meshes: FigureMeshes) -> Picture:
    """Stand the original and its cubic versions in a row."""
    (model,) = meshes.there(["bunny"], instead=["monkey"])
    groups = [meshes.group(model, model.original, "original", "grey")]
    for value in CUBENESS:
        shape = meshes.cubified(model, value, **AS_IN_THE_PAPER)
        groups.append(meshes.group(model, shape, f"cubeness {value:g}", "green"))
    return side_by_side(groups, HEIGHT)

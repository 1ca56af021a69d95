# SPDX-License-Identifier: GPL-3.0-or-later
"""One mesh that becomes cubic: figure 5 at growing cubeness, and the README's first picture."""

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group
from cubic_craft.cubic_craft_addon.mesh_bridge import shade_shape
from cubic_craft.cubic_craft_addon.settings.values import Settings

from .figure_meshes import AS_IN_THE_PAPER, FigureMeshes

CUBENESS = (0.03, 0.1, 0.4, 1.5)
LOOKS = {"soft": {"crispness": 0.0, "solidity": 0.1}, "cubic": {}, "crisp": {"crispness": 1.0}}
"""of the character, by the settings that are not the defaults"""


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return the original and its cubic versions, as in the paper."""
    (model,) = meshes.there(["bunny"], instead=["monkey"])
    groups = [meshes.group(model, model.original, "original", "grey")]
    for value in CUBENESS:
        shape = meshes.cubified(model, value, **AS_IN_THE_PAPER)
        groups.append(meshes.group(model, shape, f"cubeness {value:g}", "green"))
    return groups


def compose_character(meshes: FigureMeshes) -> list[Group]:
    """Return a character as it was, and from soft to crisp; the one between has the defaults."""
    (model,) = meshes.there([], instead=["fox"])
    groups = [meshes.group(model, model.original, "original", "grey")]
    for name, settings in LOOKS.items():
        group = meshes.group(model, meshes.cubified(model, 0.4, **settings), name, "green")
        shade_shape(group.copies[0], {"crispness": Settings.crispness, **settings})
        groups.append(group)
    return groups

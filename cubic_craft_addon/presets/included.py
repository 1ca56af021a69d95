# SPDX-License-Identifier: GPL-3.0-or-later
"""The looks that are included with the extension, from soft to hard."""

from typing import Any

from ...solver.method import LOOK, PAPER, SETTINGS


def _look(about: str, **others: Any) -> tuple[str, dict[str, Any]]:
    """Return what a tooltip says of a look, and its values, of which `others` are no defaults."""
    return about, {name: SETTINGS[name].default for name in LOOK} | others


INCLUDED = {
    "Soft": _look("Flat sides and soft edges, as if molded", crispness=0.0, solidity=0.1),
    "Rounded": _look(
        "Clearly cubic, with wide round edges", cubeness=0.25, crispness=0.0, solidity=0.1
    ),
    "Cubic": _look("Flat sides and clear edges, with all details: the defaults"),
    "Crisp": _look(
        "Edges as if cut with a knife; faces and other details stay", cubeness=0.6, crispness=1.0
    ),
    "Blocks": _look(
        "Sides that are perfectly flat, without details",
        cubeness=0.6,
        crispness=1.0,
        detail_strength=0.0,
    ),
    "Chunky": _look(
        "Flat sides and sharp edges; limbs, necks and bodies stay as thick as they are",
        cubeness=1.0,
        solidity=1.0,
    ),
    "Monolith": _look(
        "Flat sides; necks and limbs melt into one block",
        cubeness=1.0,
        crispness=1.0,
        solidity=0.0,
        keep_pose=False,
        detail=0.0,
    ),
    "As_in_the_Paper": ("Only the energy of Liu and Jacobson, as in their paper", PAPER),
}
"""the description and the values of each, by its identifier"""

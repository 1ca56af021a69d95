# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh that the artist transforms while something is shown on it: what lies under it goes along.

Blender keeps the undo step of an operator before it tells anybody of the operator. So that step has
the transformed shape over a note and attributes of before, and whoever goes back to it has to find
the transform once more. The note knows what was shown by its fingerprint only; so the shape itself
is remembered here, as long as undo steps can ask for it.
"""

from typing import Any

import bpy
import numpy as np

from ..access.fingerprint import fingerprint_of_values
from ..access.shapes import Shapes
from ..memory.affine import fit
from .store import marked, move_live, write_live_part

_MOST = 64  # remembered at once; Blender keeps 32 undo steps unless it is told otherwise

_shown: dict[str, np.ndarray] = {}
"""what was shown when a mesh was transformed, by fingerprint, the latest last"""


def take_along(
    mesh: bpy.types.Mesh, part: dict[str, Any], present: Shapes, shown: np.ndarray | None = None
) -> dict[str, Any] | None:
    """Transform what is stored under a preview as the artist has transformed what is shown.

    Parameters
    ----------
    mesh : with a preview on it, in Object Mode
    part : the part "live" of its note
    present : the shapes that are there now
    shown : (n,3) numpy array, what was shown last, if that is known

    Returns
    -------
    The part "live" that is on the mesh now; None where all vertices have not been moved alike, and
    nothing has changed.
    """
    known = _shown.get(part["fingerprint"], shown)
    if known is None or len(known) != len(present.base):
        return None
    way = fit(known, present.base)
    if way is None:
        return None
    _remember(known)
    move_live(mesh, way.moved)
    moved = marked(part, present)
    write_live_part(mesh, moved)
    return moved


def _remember(shown: np.ndarray) -> None:
    fingerprint = fingerprint_of_values(shown)
    _shown[fingerprint] = _shown.pop(fingerprint, shown)
    while len(_shown) > _MOST:
        del _shown[next(iter(_shown))]

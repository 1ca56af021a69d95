# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh that the artist transforms during a preview: the data under the preview follows.

Blender stores the undo step of an operator before it notifies handlers. That step therefore has the
transformed shape with the earlier note and attributes, and going back to it requires finding the
transform again. The note has only the fingerprint of the shape shown, so the shape itself is kept
here, as long as undo steps may need it.
"""

from typing import Any

import bpy
import numpy as np

from ..access.fingerprint import fingerprint_of_values
from ..access.shapes import Shapes
from ..memory.affine import fit
from .store import marked, move_live, write_live_part

_MOST = 64  # shapes kept; Blender keeps 32 undo steps by default

_shown: dict[str, np.ndarray] = {}
"""the shape shown when a mesh was transformed, by fingerprint, the latest last"""


def take_along(
    mesh: bpy.types.Mesh, part: dict[str, Any], present: Shapes, shown: np.ndarray | None = None
) -> dict[str, Any] | None:
    """Transform the data stored under a preview as the artist has transformed the visible mesh.

    `mesh`: with a preview on it, in Object Mode. `part`: the "live" part of its note. `present`:
    the current shapes. `shown`: (n,3), the shape shown last, if known. Returns the "live" part that
    is on the mesh now; None if not all vertices were moved alike, and nothing has changed.
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

# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the shape of a preview a result: that of a file which was written while the preview was on.

Blender tells nobody that it saves automatically.
"""

from typing import Any

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.attributes import check_names
from ..access.checks import check_writable
from ..access.fingerprint import fingerprint_of_values
from ..access.note import is_run, read_note
from ..access.shapes import read_shapes, write_shapes
from ..memory.cubic_key import find_cubic_key, remove_cubic_key
from ..memory.first_original import first_kept
from ..memory.last_run import note_run
from ..memory.original import Start, drop_stored, original_shapes, store_original
from ..memory.strokes import read_strokes
from ..preview.end import end_preview
from .rollback import all_or_nothing


def noted_outcome(mesh: bpy.types.Mesh) -> Any:
    """Return the outcome that `Preview.show` has noted on the mesh, None if there is none."""
    return read_note(mesh).get("live", {}).get("outcome")


def keep_preview(mesh: bpy.types.Mesh, run: dict[str, Any], start: Start) -> None:
    """Write the shape that the preview shows as a result.

    `mesh`: with a preview on it, in Object Mode. `run`: the note of the run (see `note`). `start`:
    what the run has started from if the mesh was edited by hand since the last result. Raises
    CubicCraftError: the shape is not that of the preview, the run is not one, or a mesh that cannot
    be written. The mesh is then unchanged.
    """
    check_writable(mesh, mesh.name)
    check_names(mesh)
    shown = read_shapes(mesh)
    part = read_note(mesh).get("live")
    if part is None or part["fingerprint"] != fingerprint_of_values(shown.base):
        raise CubicCraftError(f'Mesh "{mesh.name}" does not have the shape of its preview')
    if not is_run(run):
        raise CubicCraftError(f'Mesh "{mesh.name}" has a preview of an unknown run')
    unturned = np.tile(np.array((1, 0, 0, 0), np.float32), (len(mesh.vertices), 1))
    with all_or_nothing(mesh):
        end_preview(mesh)
        cubic_key = find_cubic_key(mesh)
        original = original_shapes(mesh, start)
        strokes = read_strokes(mesh, start)
        keep_first = first_kept(mesh, start, original)
        drop_stored(mesh)
        keep_first()
        store_original(mesh, original, shown, unturned, strokes)
        note_run(mesh, run)
        write_shapes(mesh, shown)
        remove_cubic_key(mesh, cubic_key)

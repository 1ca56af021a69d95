# SPDX-License-Identifier: GPL-3.0-or-later
"""Write a result to the mesh itself or to a shape key.

Both always start from the original and replace an earlier result of ours. Everything is
computed and checked before the first write.
"""

from typing import Any

import bpy
import numpy as np

from ..access.arrays import loose_vertices, mark_moved
from ..access.attributes import check_names
from ..access.checks import check_relative_keys, check_writable, mesh_of
from ..access.rotations import matrices_from_quaternions
from ..access.rounded_for_storage import carry_finite, rotations_for_storage, rounded_for_storage
from ..access.shapes import write_shapes
from ..memory.cubic_key import find_cubic_key, remove_cubic_key, write_cubic_key
from ..memory.last_run import note_run
from ..memory.original import Start, drop_stored, original_shapes, store_original
from ..preview.end import end_preview
from .rollback import all_or_nothing


def write_mesh(
    mesh: bpy.types.Mesh,
    positions: np.ndarray,
    rotations: np.ndarray,
    run: dict[str, Any] | None = None,
    start: Start = "HERE",
) -> None:
    """Write a result to the mesh: the base moves and the shape keys follow.

    Parameters
    ----------
    mesh : a mesh in Object Mode
    positions : (n,3) numpy array, object space; ignored for vertices in no face
    rotations : (n,3,3) numpy array, the local rotation of each vertex
    run : the note of the run (see `note`)
    start : what the result was made from if the mesh was edited by hand since the last one

    Raises
    ------
    CubicCraftError
        Wrong number of vertices, values that are not finite, a mesh that cannot be written, or
        a name conflict with our note or attributes. The mesh is then unchanged.
    """
    check_writable(mesh, mesh.name)
    check_names(mesh)
    end_preview(mesh)
    cubic_key = find_cubic_key(mesh)
    original = original_shapes(mesh, start)
    loose = loose_vertices(mesh)
    positions = rounded_for_storage(mesh, positions, original.base, loose)
    quaternions = rotations_for_storage(mesh, rotations, loose)
    written = carry_finite(mesh, original, positions, matrices_from_quaternions(quaternions))
    with all_or_nothing(mesh):
        drop_stored(mesh)
        store_original(mesh, original, written, quaternions)
        note_run(mesh, run)
        write_shapes(mesh, written)
        remove_cubic_key(mesh, cubic_key)


def write_shape_key(
    obj: bpy.types.Object,
    positions: np.ndarray,
    run: dict[str, Any] | None = None,
    start: Start = "HERE",
) -> None:
    """Write a result to the shape key "Cubic"; everything else has its original shape.

    Parameters
    ----------
    obj : an object with a mesh, in Object Mode
    positions : (n,3) numpy array, object space; ignored for vertices in no face
    run : the note of the run (see `note`)
    start : what the result was made from if the mesh was edited by hand since the last one

    Raises
    ------
    CubicCraftError
        Wrong number of vertices, values that are not finite, absolute shape keys, or a mesh that
        cannot be written. The mesh is then unchanged.
    """
    mesh = mesh_of(obj)
    check_writable(mesh, obj.name)
    check_relative_keys(obj)
    end_preview(mesh)
    cubic_key = find_cubic_key(mesh)
    original = original_shapes(mesh, start)
    positions = rounded_for_storage(mesh, positions, original.base, loose_vertices(mesh))
    with all_or_nothing(mesh):
        write_shapes(mesh, original)
        drop_stored(mesh)
        write_cubic_key(obj, positions, cubic_key)
        note_run(mesh, run)
        mark_moved(mesh)

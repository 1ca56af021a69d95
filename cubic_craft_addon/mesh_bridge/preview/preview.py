# SPDX-License-Identifier: GPL-3.0-or-later
"""Show intermediate shapes on a mesh while a modal operator runs.

The shapes they overwrite are stored on the mesh (see `store`); `end_preview` restores them. A
modifier would overwrite nothing, but it cannot show what Cubify writes to a mesh that has Multires
or is deformed by its parent: see `test_preview_by_modifier`.
"""

from dataclasses import replace
from typing import Any

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.arrays import loose_vertices
from ..access.attributes import LIVE, check_names
from ..access.checks import check_writable
from ..access.note import check_note, read_note
from ..access.rounded_for_storage import carry_finite, matrices_for_storage, rounded_for_storage
from ..access.shapes import Shapes, read_shapes, write_shapes
from ..access.sharp_edges import is_smooth, let_edges_follow
from ..memory.cubic_key import find_cubic_key
from ..memory.original import Start, original_shapes
from ..memory.strokes import read_strokes, with_strokes
from .store import end_preview, marked, store_live, take_along, write_live_part


class Preview:
    """A preview on one mesh, from its creation until `end_preview`.

    It holds only plain arrays and texts. Undo frees meshes, so the mesh is passed again to each
    call.
    """

    def __init__(self, mesh: bpy.types.Mesh, start: Start = "HERE") -> None:
        """Store the current shapes on the mesh; an existing preview is ended first.

        `start`: what the run starts from if the mesh was edited by hand since the last result.
        Raises CubicCraftError: a mesh that cannot be written, or a name conflict with our note or
        attributes; the mesh is then unchanged.
        """
        check_writable(mesh, mesh.name)
        check_note(mesh)
        check_names(mesh)
        end_preview(mesh)
        cubic_key = find_cubic_key(mesh)
        self._cubic_key = cubic_key.name if cubic_key is not None else None
        # A preview moves no free normals, which it would have to store first.
        self._original = replace(original_shapes(mesh, start), normals=None)
        self._strokes = read_strokes(mesh, start)
        self._loose = loose_vertices(mesh)
        self._keys = _key_names(mesh)
        self._is_smooth = is_smooth(mesh)
        present = read_shapes(mesh)
        self._shown = present.base
        store_live(mesh, present)

    @property
    def needs_rotations(self) -> bool:
        """Whether there are shape keys that follow the base, or strokes that turn with it."""
        return bool(self._original.relative) or self._strokes is not None

    def show(
        self,
        mesh: bpy.types.Mesh,
        positions: np.ndarray,
        rotations: np.ndarray | None = None,
        outcome: Any = None,
        has_edges: bool = False,
    ) -> None:
        """Show a shape on the mesh, as `write_mesh` would write it.

        Our own shape key also shows it, so that the picture does not depend on its value.

        `mesh`: the mesh, or its replacement after an undo; in Object Mode. `positions`: (n,3),
        object space; ignored for vertices in no face. `rotations`: (n,3,3), the local rotation of
        each vertex; None if they do not rotate, or `needs_rotations` is false. `outcome`: values
        for JSON, which `noted_outcome` returns if a file is opened with this shape. `has_edges`:
        whether sharp edges are to follow it. Raises CubicCraftError: wrong number of vertices,
        values that are not finite, a mesh that cannot be written, or one without this preview. The
        mesh is then unchanged.
        """
        check_writable(mesh, mesh.name)
        part = self._part_on(mesh) | {"outcome": outcome}
        base = rounded_for_storage(mesh, positions, self._original.base, self._loose)
        turns = rotations if self.needs_rotations else None
        matrices = matrices_for_storage(mesh, turns, self._loose)
        base = with_strokes(mesh, base, self._strokes, matrices)
        shown = self._with_keys(mesh, base, matrices)
        finished = marked(part, shown)
        # If writing fails half-way, `end_preview` must not mistake the mixture for an edit.
        write_live_part(mesh, marked(part, None))
        let_edges_follow(mesh, has_edges and self._is_smooth)
        write_shapes(mesh, shown)
        write_live_part(mesh, finished)
        self._shown = shown.base

    def take_along(self, mesh: bpy.types.Mesh) -> bool:
        """Transform the stored shapes as the artist has transformed the visible mesh.

        If the origin was set, or a transform applied, all vertices have been moved alike.
        `end_preview` would mistake the visible shape for one that was made by hand.

        Returns whether the preview must be ended and restarted, which is also so with other shape
        keys.
        """
        part = read_note(mesh).get("live")
        if part is None or LIVE not in mesh.attributes or mesh.is_editmode:
            return False
        if _key_names(mesh) != self._keys or len(mesh.vertices) != len(self._loose):
            return True  # the shapes before are stored on the mesh itself
        try:
            present = read_shapes(mesh)
        except CubicCraftError:
            return False
        if (present.base == self._shown).all():
            return False
        if take_along(mesh, part, present, self._shown) is None:
            return False
        self._shown = present.base
        return True

    def _with_keys(self, mesh: bpy.types.Mesh, base: np.ndarray, matrices: np.ndarray) -> Shapes:
        original = self._original
        if original.reference is None:
            return Shapes(base, {}, None, {})
        if not original.relative:
            shown = Shapes(base, {original.reference: base}, original.reference, {})
        else:
            shown = carry_finite(mesh, original, base, matrices)
        if self._cubic_key is None:
            return shown
        return replace(shown, keys=shown.keys | {self._cubic_key: base})

    def _part_on(self, mesh: bpy.types.Mesh) -> dict[str, Any]:
        """Return the "live" part of the note, once the shapes to be overwritten are stored."""
        part = read_note(mesh).get("live")
        if (
            part is None
            or LIVE not in mesh.attributes
            or len(mesh.vertices) != len(self._loose)
            or _key_names(mesh) != self._keys
        ):
            raise CubicCraftError(
                f'Mesh "{mesh.name}" has changed while a preview was on it: start again'
            )
        return part


def _key_names(mesh: bpy.types.Mesh) -> list[str]:
    return mesh.shape_keys.key_blocks.keys() if mesh.shape_keys is not None else []

# SPDX-License-Identifier: GPL-3.0-or-later
"""The shapes of a mesh in Edit Mode, read and written in place.

Edit Mode works on a copy of the mesh, a BMesh. In there, ``co`` of a vertex is the active shape
key, and each key has a layer, the active one also. On leaving Edit Mode, keys that depend on the
active one are moved by ``co`` minus its layer, so both are always written alike.
"""

import bmesh
import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.shapes import Shapes, assembled


class EditedMesh:
    """A mesh in Edit Mode; valid only while the mode cannot have been left."""

    def __init__(self, mesh: bpy.types.Mesh) -> None:
        self._mesh = mesh
        self._bm = bmesh.from_edit_mesh(mesh)
        self._names = mesh.shape_keys.key_blocks.keys() if mesh.shape_keys is not None else []
        self._co = _vectors([vertex.co[:] for vertex in self._bm.verts])
        # By index: a layer keeps its name when the artist renames its shape key.
        self._layers = self._bm.verts.layers.shape.values()
        self._points = [_vectors([v[layer][:] for v in self._bm.verts]) for layer in self._layers]
        self._active = self._find_active()

    def read_shapes(self) -> Shapes:
        """Read all shapes; ``position``, which does not exist in Edit Mode, is that of the base.

        Raises CubicCraftError: the layers are not those of the shape keys, which scripts may cause.
        """
        if not self._names:
            return assembled(self._mesh, self._co, {})
        if len(self._layers) != len(self._names):
            raise CubicCraftError(f'Mesh "{self._mesh.name}" has shape keys without layers')
        keys = dict(zip(self._names, self._points, strict=True))
        keys[self._names[self._active]] = self._co
        return assembled(self._mesh, keys[self._mesh.shape_keys.reference_key.name], keys)

    def write_shapes(self, shapes: Shapes) -> None:
        """Write shapes of the same shape keys as those of `read_shapes`."""
        co = shapes.position
        if self._names:
            co = shapes.keys[self._names[self._active]]
            for name, layer in zip(self._names, self._layers, strict=True):
                for vertex, place in zip(self._bm.verts, shapes.keys[name].tolist(), strict=True):
                    vertex[layer] = place
        for vertex, place in zip(self._bm.verts, co.tolist(), strict=True):
            vertex.co = place
        self._bm.normal_update()
        bmesh.update_edit_mesh(self._mesh, loop_triangles=True, destructive=False)

    def smooth_edges(self) -> None:
        """Remove all marks of sharp edges; `write_shapes` must follow."""
        for edge in self._bm.edges:
            edge.smooth = True

    def read_attribute(self, name: str) -> np.ndarray | None:
        """Read a point attribute of vectors, or None if there is none."""
        layer = self._bm.verts.layers.float_vector.get(name)
        return None if layer is None else _vectors([v[layer][:] for v in self._bm.verts])

    def _find_active(self) -> int:
        """Find the index of the shape key that ``co`` is.

        Only objects know which one it is. Of several in Edit Mode with this mesh, the one whose
        active key was at ``co`` is used.
        """
        places = [
            obj.active_shape_key_index or 0
            for obj in bpy.data.objects
            if obj.data == self._mesh and obj.mode == "EDIT"
        ]
        places = [place for place in places if place < len(self._points)] or [0]
        if not self._points:
            return 0
        return next((p for p in places if np.array_equal(self._points[p], self._co)), places[0])


def _vectors(items: list) -> np.ndarray:
    """Make an (n,3) float32 array of coordinates; Python floats keep their bits."""
    return np.array(items, np.float32).reshape(-1, 3)

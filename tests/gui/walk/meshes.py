# SPDX-License-Identifier: GPL-3.0-or-later
"""What is on a mesh, read without the extension: its shape, its original, its faces."""

import dataclasses
import hashlib
import json

import bmesh
import bpy
import numpy as np

NOTE = "cubic_craft_note"
ORIGINAL = "cubic_craft_original"
LIVE = "cubic_craft_live"
STROKES = f"{ORIGINAL}.strokes"
FIRST = "cubic_craft_first"


@dataclasses.dataclass(frozen=True)
class MeshState:
    """A mesh at rest between two steps; shapes and faces are given as hashes."""

    name: str
    shape: str  # the reference key's points, or without keys the positions; -0 counts as 0
    original: str  # the shape that Restore, or the end of Live and then Restore, has to bring
    faces: str  # edges, faces and UVs
    is_finite: bool
    has_preview: bool
    has_traces: bool
    is_edited: bool  # a result by hand; another original may then belong to it
    has_first: bool  # an original that was replaced


def read_all():
    """Return the state of all meshes of the file that are not linked, by `session_uid`."""
    return {mesh.session_uid: _read(mesh) for mesh in bpy.data.meshes if mesh.library is None}


def _read(mesh):
    data = _Edited(mesh) if mesh.is_editmode else _Plain(mesh)
    text = mesh.get(NOTE, "{}")
    note = json.loads(text) if isinstance(text, str) else {}
    return MeshState(
        name=mesh.name,
        shape=_hash_values(data.shape),
        original=_hash_values(_original(data, note)),
        faces=data.faces(),
        is_finite=bool(np.isfinite(data.shape).all()) and all(map(_is_finite, data.keys())),
        has_preview="live" in note,
        has_traces=bool(note),
        is_edited=_is_edited(data, note),
        has_first=data.attribute(FIRST) is not None,
    )


def _is_edited(data, note):
    """Return whether the shape, of which a preview may be shown, has been edited by hand.

    It is then none that was written to it, or one with strokes.
    """
    shape = data.shape
    if "live" in note:
        before = data.attribute(LIVE)
        shape = shape if before is None else before
    if "mesh" in note:
        is_written = note["mesh"]["fingerprint"] == _hash(shape)
        return not is_written or data.attribute(STROKES) is not None
    return "key" in note and note["key"]["base"] != _hash_values(shape)


def _original(data, note):
    shape = data.shape
    if "live" in note and note["live"]["fingerprint"] in ("", _hash_values(shape)):
        before = data.attribute(LIVE)
        shape = shape if before is None else before
    if "mesh" in note and note["mesh"]["fingerprint"] == _hash(shape):
        before = data.attribute(ORIGINAL)
        shape = shape if before is None else before
    return shape


def _is_finite(values):
    return np.isfinite(values).all()


def _hash(values):
    bits = np.ascontiguousarray(values, np.float32).tobytes()
    return hashlib.blake2b(bits, digest_size=16).hexdigest()


def _hash_values(values):
    # Edit Mode makes 0 of -0 in shape keys.
    return _hash(values + np.float32(0))


def _hash_faces(*arrays):
    return hashlib.blake2b(b"|".join(array.tobytes() for array in arrays)).hexdigest()


def _get(items, name, size, dtype=np.float32):
    values = np.empty(len(items) * size, dtype)
    items.foreach_get(name, values)
    return values.reshape(-1, size)


class _Plain:
    """A mesh outside Edit Mode."""

    def __init__(self, mesh):
        self._mesh = mesh
        keys = mesh.shape_keys
        source = mesh.vertices if keys is None else keys.reference_key.data
        self.shape = _get(source, "co", 3)

    def keys(self):
        keys = self._mesh.shape_keys
        return [] if keys is None else [_get(block.data, "co", 3) for block in keys.key_blocks]

    def attribute(self, name):
        found = self._mesh.attributes.get(name)
        return None if found is None else _get(found.data, "vector", 3)

    def faces(self):
        mesh = self._mesh
        return _hash_faces(
            _get(mesh.edges, "vertices", 2, np.int32),
            _get(mesh.loops, "vertex_index", 1, np.int32),
            _get(mesh.polygons, "loop_total", 1, np.int32),
            *(_get(layer.uv, "vector", 2) for layer in mesh.uv_layers),
        )


class _Edited:
    """A mesh in Edit Mode, where the BMesh is what counts."""

    def __init__(self, mesh):
        self._mesh = mesh
        self._bm = bmesh.from_edit_mesh(mesh)
        self.shape = self._vectors(lambda vertex: vertex.co)
        layers = self._bm.verts.layers.shape.values()
        if layers and self._active_key() != 0:
            self.shape = self._vectors(lambda vertex: vertex[layers[0]])

    def _active_key(self):
        users = [o for o in bpy.data.objects if o.data == self._mesh and o.mode == "EDIT"]
        return users[0].active_shape_key_index if users else 0

    def _vectors(self, read):
        return np.array([read(v)[:] for v in self._bm.verts], np.float32).reshape(-1, 3)

    def keys(self):
        layers = self._bm.verts.layers.shape.values()
        return [self._vectors(lambda v, layer=layer: v[layer]) for layer in layers]

    def attribute(self, name):
        layer = self._bm.verts.layers.float_vector.get(name)
        return None if layer is None else self._vectors(lambda vertex: vertex[layer])

    def faces(self):
        edges, faces = self._bm.edges, self._bm.faces
        self._bm.verts.index_update()
        corners = [corner for face in faces for corner in face.loops]
        layers = self._bm.loops.layers.uv.values()
        return _hash_faces(
            np.array([[v.index for v in edge.verts] for edge in edges], np.int32),
            np.array([corner.vert.index for corner in corners], np.int32),
            np.array([len(face.verts) for face in faces], np.int32),
            *(np.array([c[layer].uv[:] for c in corners], np.float32) for layer in layers),
        )

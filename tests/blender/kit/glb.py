# SPDX-License-Identifier: GPL-3.0-or-later
"""A .glb file as plain values, read without Blender."""

import json
import struct

import numpy as np

_TYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32}
_TYPES |= {5126: np.float32}
_SIZES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Glb:
    def __init__(self, path):
        data = path.read_bytes()
        assert data[:4] == b"glTF" and struct.unpack_from("<I", data, 8)[0] == len(data)
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20 : 20 + length])
        self._bytes = data[28 + length :]

    def mesh(self, name):
        """Return the primitives of the mesh of a node as dictionaries of arrays."""
        node = next(node for node in self.json["nodes"] if node["name"] == name)
        return [
            {key: self.array(number) for key, number in primitive["attributes"].items()}
            | {"indices": self.array(primitive["indices"])}
            | {"targets": [self.array(t["POSITION"]) for t in primitive.get("targets", [])]}
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]
        ]

    def array(self, number):
        """Return an accessor as an array, (n,) or (n,k); sparse ones too."""
        accessor = self.json["accessors"][number]
        size = _SIZES[accessor["type"]]
        if "bufferView" in accessor:
            kind = accessor["componentType"]
            values = self._values(accessor, kind, accessor["count"] * size)
        else:
            values = np.zeros(accessor["count"] * size, np.float32)
        values = values.reshape(-1, size).copy()
        sparse = accessor.get("sparse")
        if sparse:
            where, what = sparse["indices"], sparse["values"]
            rows = self._values(where, where["componentType"], sparse["count"])
            values[rows] = self._values(
                what, accessor["componentType"], sparse["count"] * size
            ).reshape(-1, size)
        return values[:, 0] if size == 1 else values

    def _values(self, place, kind, count):
        view = self.json["bufferViews"][place["bufferView"]]
        assert "byteStride" not in view
        start = view.get("byteOffset", 0) + place.get("byteOffset", 0)
        return np.frombuffer(self._bytes, _TYPES[kind], count, start)


def to_blender(points):
    """Return positions as Blender has them: glTF has +Y up."""
    x, y, z = points.T
    return np.stack([x, -z, y], axis=1)

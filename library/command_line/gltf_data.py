# SPDX-License-Identifier: GPL-3.0-or-later
"""The two parts of a glTF file: its JSON, and the bytes that this describes.

All buffers of a file become one. What lies in other files is refused, not looked for.
"""

import base64
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

from solver.console.errors import InputError

_MAGIC, _JSON, _BINARY = b"glTF", 0x4E4F534A, 0x004E4942
_HEAD = struct.Struct("<4sII")
_CHUNK = struct.Struct("<II")
_TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_COMPRESSED = frozenset(
    ("EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_draco_mesh_compression")
)
"""beside which some files hold the same once more, but programs read the compressed"""
_URI = "data:application/octet-stream;base64,"


class GltfData:
    """A file in memory.

    `tree`: the JSON, whose buffer views refer to one buffer. `binary`: the buffer.
    """

    def __init__(self, tree: dict[str, Any], binary: bytearray) -> None:
        self.tree, self.binary = tree, binary

    @classmethod
    def read(cls, path: Path) -> "GltfData":
        """Read a .glb or .gltf file.

        Raises InputError: it refers to another file, is compressed or cut off; the message lacks
        the path.
        """
        content = path.read_bytes()
        if not content.startswith(_MAGIC):
            return cls._joined(json.loads(content), b"")
        _, version, length = _HEAD.unpack_from(content)
        if version != 2 or length > len(content):
            raise InputError("is cut off or of another version than 2; export it again")
        chunks: dict[int, bytes] = {}
        begin = _HEAD.size
        while begin + _CHUNK.size <= length:
            size, kind = _CHUNK.unpack_from(content, begin)
            begin += _CHUNK.size
            chunks.setdefault(kind, content[begin : begin + size])
            begin += size
        return cls._joined(json.loads(chunks[_JSON]), chunks.get(_BINARY, b""))

    @classmethod
    def _joined(cls, tree: dict[str, Any], chunk: bytes) -> "GltfData":
        found = _COMPRESSED.intersection(tree.get("extensionsUsed", ()))
        if found:
            name = min(found)
            raise InputError(f"its data is compressed ({name}); export it without compression")
        binary, starts = bytearray(), list[int]()
        for buffer in tree.get("buffers", ()):
            uri, length = buffer.pop("uri", None), buffer["byteLength"]
            if uri is not None and not uri.startswith("data:"):
                raise InputError(f"its data lies in {uri[:80]!r}; export it as one .glb file")
            data = chunk if uri is None else base64.b64decode(uri.partition(",")[2])
            if len(data) < length:
                raise InputError("its data is cut off; export it again")
            binary.extend(b"\0" * (-len(binary) % 4))
            starts.append(len(binary))
            binary.extend(data[:length])
        for view in tree.get("bufferViews", ()):
            view["byteOffset"] = view.get("byteOffset", 0) + starts[view["buffer"]]
            view["buffer"] = 0
        return cls(tree, binary)

    def values(self, number: int) -> np.ndarray:
        """Return a copy (k,w) of the values of an accessor; fractions that are stored as integers.

        Raises InputError: they are cut off, or nowhere.
        """
        accessor = self.tree["accessors"][number]
        if "bufferView" not in accessor:
            raise InputError("has data that is stored nowhere; export it again")
        kind, width = accessor["componentType"], _WIDTHS[accessor["type"]]
        values = self.stored(accessor, accessor["count"], kind, width).copy()
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            of_rows = sparse["indices"]
            rows = self.stored(of_rows, sparse["count"], of_rows["componentType"], 1)
            values[rows.ravel()] = self.stored(sparse["values"], sparse["count"], kind, width)
        if accessor.get("normalized"):
            values = np.maximum(values / np.iinfo(values.dtype).max, -1.0)
        return values

    def stored(self, place: dict[str, Any], count: int, kind: int, width: int) -> np.ndarray:
        """Return what lies (count,width) at a place in a view, which can be written to."""
        view, dtype = self.tree["bufferViews"][place["bufferView"]], np.dtype(_TYPES[kind])
        size = width * dtype.itemsize
        stride = view.get("byteStride", size)
        begin = view["byteOffset"] + place.get("byteOffset", 0)
        if begin < 0 or count < 1 or begin + (count - 1) * stride + size > len(self.binary):
            raise InputError("its data is cut off; export it again")
        return np.ndarray((count, width), dtype, self.binary, begin, (stride, dtype.itemsize))

    def add(self, values: np.ndarray, **of_accessor: Any) -> int:
        """Store values at the end, and return the number of their accessor."""
        views = self.tree.setdefault("bufferViews", [])
        accessors = self.tree.setdefault("accessors", [])
        self.binary.extend(b"\0" * (-len(self.binary) % 4))
        place = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": values.nbytes}
        views.append(place)
        self.binary.extend(values.tobytes())
        accessors.append({"bufferView": len(views) - 1, "count": len(values), **of_accessor})
        return len(accessors) - 1

    def write(self, path: Path) -> None:
        """Write a .glb or .gltf file, as its suffix says."""
        binary = bytes(self.binary) + b"\0" * (-len(self.binary) % 4)
        tree = {**self.tree, "buffers": [{"byteLength": len(binary)}]} if binary else self.tree
        if path.suffix.lower() == ".gltf":
            if binary:
                tree["buffers"][0]["uri"] = _URI + base64.b64encode(binary).decode("ascii")
            path.write_text(json.dumps(tree), encoding="utf-8")
            return
        text = json.dumps(tree, separators=(",", ":")).encode("utf-8")
        text += b" " * (-len(text) % 4)
        chunks = [_CHUNK.pack(len(text), _JSON), text]
        if binary:
            chunks += [_CHUNK.pack(len(binary), _BINARY), binary]
        length = _HEAD.size + sum(map(len, chunks))
        path.write_bytes(b"".join([_HEAD.pack(_MAGIC, 2, length), *chunks]))

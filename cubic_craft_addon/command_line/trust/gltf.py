# SPDX-License-Identifier: GPL-3.0-or-later
"""What a glTF file refers to, and how much data it stands for.

Its importer reads buffers and images from any path, and makes arrays as large as the file says they
are, whether it has their content or not.
"""

import json
import re
from pathlib import Path
from typing import Any

from ....solver.console.errors import InputError
from .places import refuse_outside

_MAGIC, _HEADER, _CHUNK = b"glTF", 12, 8
_INLINE = ";base64,"
_MOST = 200
"""times as many bytes may be in the arrays as in the files, as these may be compressed"""
_FREE = 1 << 22
"""bytes that any file may stand for"""
_SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


def check_gltf(path: Path) -> None:
    """Look into a .gltf or .glb; what makes no sense is the importer's to refuse.

    Raises InputError: it refers to a file outside of its folder, or stands for far more data than
    it has.
    """
    try:
        content = json.loads(_json_of(path).decode())
    except ValueError:
        return  # for the importer as well, which says where
    try:
        parts = [part for kind in ("buffers", "images") for part in content.get(kind, [])]
        uris = [part["uri"] for part in parts if part.get("uri") is not None]
        bytes_said = sum(map(_bytes_said, content.get("accessors", [])))
        files = [_unquoted(uri) for uri in uris if not (uri[:5] == "data:" and _INLINE in uri)]
    except (ValueError, TypeError, KeyError, AttributeError, OverflowError) as error:
        raise InputError(f"{path}: cannot be read (makes no sense); export it again") from error
    refuse_outside(path, files)
    there = [path.resolve().parent / name for name in set(files)]
    size = path.stat().st_size + sum(other.stat().st_size for other in there if other.is_file())
    if bytes_said > _MOST * size + _FREE:
        raise InputError(
            f"{path}: cannot be read (its arrays would take {bytes_said:,} bytes, but its files "
            f"have {size:,}); export it again"
        )


def _unquoted(uri: str) -> str:
    """Return a path in which letters may be written as %20."""
    parts = re.split(r"((?:%[0-9a-fA-F]{2})+)", uri)
    parts[1::2] = (bytes.fromhex(x.replace("%", "")).decode(errors="replace") for x in parts[1::2])
    return "".join(parts)


def _json_of(path: Path) -> bytes:
    with path.open("rb") as file:
        begin = file.read(_HEADER + _CHUNK)
        if not begin.startswith(_MAGIC):
            return begin + file.read()
        return file.read(int.from_bytes(begin[_HEADER : _HEADER + 4], "little"))


def _bytes_said(accessor: dict[str, Any]) -> int:
    """Return how large an array is, or would be without what is sparse in it."""
    row = _SIZES.get(accessor["componentType"], 4) * _WIDTHS.get(accessor["type"], 16)
    sparse = accessor.get("sparse", {}).get("count", 0)
    return row * (max(0, int(accessor["count"])) + max(0, int(sparse)))

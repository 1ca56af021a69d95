# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts in a binary layer of USD, a "crate": all of them, also paths, are in one table.

After the bootstrap (magic, version, offset of the contents) come sections, of which that with the
name TOKENS has the texts, since version 0.4 compressed by LZ4.
"""

import struct

MAGIC = b"PXR-USDC"
_BOOTSTRAP, _SECTION = struct.Struct("<8s8Bq"), struct.Struct("<16sqq")
_COMPRESSED = (0, 4)
"""first version with compressed tables"""


def tokens(data: bytes) -> list[bytes]:
    """Return the texts of a crate.

    Raises ValueError, IndexError: it is none, or is cut off.
    """
    try:
        _, major, minor, *_, contents = _BOOTSTRAP.unpack_from(data)
        (count,) = struct.unpack_from("<Q", data, contents)
        sections = _SECTION.iter_unpack(data[contents + 8 :][: count * _SECTION.size])
        start = next(start for name, start, _ in sections if name.rstrip(b"\0") == b"TOKENS")
        if (major, minor) < _COMPRESSED:
            _, size = struct.unpack_from("<QQ", data, start)
            return data[start + 16 :][:size].split(b"\0")
        _, _, size = struct.unpack_from("<QQQ", data, start)
        return _decompressed(data[start + 24 :][:size]).split(b"\0")
    except (struct.error, StopIteration, OverflowError) as error:
        raise ValueError("no crate") from error


def _decompressed(data: bytes) -> bytes:
    """Undo USD's compression: one block of LZ4, or several that follow on their sizes."""
    if not data[0]:
        return _block(data[1:])
    parts, place = [], 1
    for _ in range(data[0]):
        (size,) = struct.unpack_from("<i", data, place)
        parts.append(_block(data[place + 4 :][:size]))
        place += 4 + size
    return b"".join(parts)


def _block(data: bytes) -> bytes:
    """Decompress one block of LZ4: literals, then a copy of earlier bytes, over and over."""
    out, place = bytearray(), 0

    def length(nibble: int) -> int:
        nonlocal place
        more = 255 if nibble == 15 else 0
        while more == 255:
            more = data[place]
            nibble, place = nibble + more, place + 1
        return nibble

    while place < len(data):
        token = data[place]
        place += 1
        count = length(token >> 4)
        out += data[place : place + count]
        place += count
        if place >= len(data):
            break
        distance = data[place] | data[place + 1] << 8
        place += 2
        begin, count = len(out) - distance, length(token & 15) + 4
        if not 0 <= begin < len(out):
            raise ValueError("a copy from nowhere")
        for index in range(begin, begin + count):  # it may copy what it has just written
            out.append(out[index])
    return bytes(out)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the header of a .ply file one that meshio reads right.

In binary files it takes ``uchar`` for signed, so that colors change, does not know ``char``,
``short`` and ``ushort``, and misreads faces with further properties, such as colors. In all files,
it does not know ``vertex_index`` as the name of the corners, which many programs write.
"""

import re

from solver.console.errors import InputError

_END = re.compile(rb"^end_header\r?\n", re.MULTILINE)
_INDEX = re.compile(rb"^property list (.*) vertex_index[ \t]*$", re.MULTILINE)
_TYPES = {b"uchar": b"uint8", b"char": b"int8"}


def readable_ply(content: bytes) -> bytes:
    """Return a file with another header, and the same content.

    Raises InputError: it has no header, or is one that meshio would misread; the message lacks the
    path.
    """
    end = _END.search(content)
    if not content.startswith(b"ply") or end is None:
        raise InputError("this is no .ply file; export it again")
    header = content[: end.start()].replace(b"\r\n", b"\n")
    header = _INDEX.sub(rb"property list \1 vertex_indices", header)
    lines = [_with_types(line) for line in header.split(b"\n")]
    element, of_faces = b"", []
    for words in map(bytes.split, lines):
        element = words[1] if words[:1] == [b"element"] else element
        if words[:1] == [b"property"] and element == b"face":
            of_faces.append(words[-1].decode(errors="replace"))
    others = [name for name in of_faces if name != "vertex_indices"]
    if others:
        raise InputError(
            f"its faces have the property {others[0]} besides their corners, which meshio cannot "
            "read; export it without"
        )
    return b"\n".join(lines) + b"end_header\n" + content[end.end() :]


def _with_types(line: bytes) -> bytes:
    words = line.split()
    if words[:1] != [b"property"]:
        return line
    return b" ".join([*(_TYPES.get(word, word) for word in words[:-1]), words[-1]])

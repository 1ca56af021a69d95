# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep what meshio decompresses of a .vtu file within the memory.

A file of some megabytes may hold a thousand times as much, and meshio takes it all before it
compares it with what the file says of itself.
"""

import contextlib
import lzma
import zlib
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

from meshio.vtu import _vtu

from solver.console.errors import InputError
from solver.memory import free_memory

SHARE = 0.25
"""of the free memory; meshio and the solver need several times what is in the file"""


@contextlib.contextmanager
def within_memory() -> Iterator[None]:
    """Refuse, during the block, what decompresses to more than a share of the free memory.

    Raises InputError: the message lacks the path.
    """
    free = free_memory()
    if free is None:
        yield
        return
    left = int(SHARE * free)

    def decompress(stream: Any, data: bytes) -> bytes:
        nonlocal left
        found = stream.decompress(data, left + 1)
        left -= len(found)
        if left < 0:
            message = f"its data would take more than {SHARE * free / 1e9:.2g} GB of memory"
            raise InputError(f"{message}; check where it comes from")
        if not stream.eof:
            raise InputError("a compressed array is cut off; export it again")
        return found

    own = {
        "zlib": SimpleNamespace(decompress=lambda data: decompress(zlib.decompressobj(), data)),
        "lzma": SimpleNamespace(decompress=lambda x: decompress(lzma.LZMADecompressor(), x)),
    }
    kept = {name: getattr(_vtu, name) for name in own}
    try:
        vars(_vtu).update(own)
        yield
    finally:
        vars(_vtu).update(kept)

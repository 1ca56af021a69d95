# SPDX-License-Identifier: GPL-3.0-or-later
"""Point caches: PC2 files, which Blender's Mesh Cache modifier and other programs play back."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ...solver import CubicCraftError
from ...solver.console.output import replacing

_HEADER = np.dtype(
    [
        ("signature", "S12"),
        ("version", "<i4"),
        ("points", "<i4"),
        ("start", "<f4"),
        ("rate", "<f4"),
        ("samples", "<i4"),
    ]
)
_SIGNATURE = b"POINTCACHE2"


@contextmanager
def new_point_cache(path: Path, frames: int, points: int) -> Iterator[np.ndarray]:
    """Make a file, and give its positions (frames, points, 3) to be filled, in any order.

    The file is there once all is filled; after an exception, an earlier one is left as it was.
    """
    with replacing(path) as partial:
        with partial.open("wb") as file:
            header = np.array([(_SIGNATURE, 1, points, 0.0, 1.0, frames)], _HEADER)
            file.write(header.tobytes())
            file.truncate(_HEADER.itemsize + 12 * frames * points)
        positions = _mapped(partial, frames, points, "r+")
        yield positions
        positions.flush()
        del positions


def read_point_cache(path: Path) -> np.ndarray:
    """Return the positions (frames, points, 3) of a file, read when they are used.

    Raises CubicCraftError: it is not a PC2 file, or it is incomplete.
    """
    with path.open("rb") as file:
        head = file.read(_HEADER.itemsize)
    if len(head) < _HEADER.itemsize or not head.startswith(_SIGNATURE):
        raise CubicCraftError(f'"{path}" is not a PC2 file')
    header = np.frombuffer(head, _HEADER)[0]
    frames, points = int(header["samples"]), int(header["points"])
    if path.stat().st_size < _HEADER.itemsize + 12 * frames * points:
        raise CubicCraftError(f'"{path}" is incomplete')
    return _mapped(path, frames, points, "r")


def _mapped(path, frames, points, mode):
    shape = (frames, points, 3)
    return np.memmap(path, "<f4", mode, offset=_HEADER.itemsize, shape=shape)

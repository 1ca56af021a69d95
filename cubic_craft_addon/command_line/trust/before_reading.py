# SPDX-License-Identifier: GPL-3.0-or-later
"""Look into a file before Blender reads it."""

import contextlib
from collections.abc import Iterator
from pathlib import Path

from ....solver.console.temporary import temporary_folder
from .fbx import check_fbx
from .gltf import check_gltf
from .obj import restricted_copy
from .trial import CRASHING, try_to_read
from .usd import check_usd


@contextlib.contextmanager
def readable(path: Path, importer: str, has_own_process: bool) -> Iterator[Path]:
    """Give the file that Blender may read for this one: itself, or a copy that refers to less.

    `path`: what was given, a regular file. `importer`: Blender's operator for it, such as
    "wm.usd_import". `has_own_process`: a crash ends nothing else, and is reported by whoever
    started this process. Raises InputError: the file refers to one outside of its folder, stands
    for far more data than it has, or crashes Blender.
    """
    suffix = path.suffix.lower()
    if suffix in (".glb", ".gltf"):
        check_gltf(path)
    if suffix == ".fbx":
        check_fbx(path)
    if suffix in (".usd", ".usda", ".usdc", ".usdz"):
        check_usd(path)
    if suffix in CRASHING and not has_own_process:
        try_to_read(path, importer)
    with temporary_folder() as folder:
        copy = restricted_copy(path.resolve(), folder) if suffix == ".obj" else None
        yield copy or path.resolve()

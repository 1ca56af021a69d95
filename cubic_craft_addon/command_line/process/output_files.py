# SPDX-License-Identifier: GPL-3.0-or-later
"""Output files: their names, checked before any work is done."""

import json
from pathlib import Path
from typing import Any

from ....solver.console.output import check_folder, check_place
from ....solver.console.temporary import replacing

__all__ = (
    "check_writable",
    "numbered",
    "per_cubeness",
    "write_json",
    "written",
)


def per_cubeness(path: Path, cubeness: list[float]) -> list[Path]:
    """One path per cubeness: the path itself for one value, else ``name_0.4.obj`` and so on."""
    if len(cubeness) == 1:
        return [path]
    return [path.with_name(f"{path.stem}_{value!r}{path.suffix}") for value in cubeness]


def numbered(path: Path, count: int) -> list[Path]:
    """Paths of a sequence: ``name_0001.png`` and so on; the path itself for a count of 0."""
    if not count:
        return [path]
    return [path.with_name(f"{path.stem}_{n:04d}{path.suffix}") for n in range(1, count + 1)]


def written(
    picture: Path | None, frames: int, mesh: Path | None, cubeness: list[float]
) -> list[Path]:
    """All paths that a run writes: pictures, then meshes."""
    pictures = numbered(picture, frames) if picture else []
    return pictures + (per_cubeness(mesh, cubeness) if mesh else [])


def check_writable(option: str, paths: list[Path]) -> None:
    """Refuse paths that cannot be written, before the long work starts.

    Raises
    ------
    InputError
        Naming the option, the path and the cure.
    """
    for path in paths:
        check_place(f"{option} {path}", path)
    check_folder(f"{option} {paths[0]}", paths[0].parent)


def write_json(path: Path, content: Any) -> None:
    """Write a file of JSON."""
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")

# SPDX-License-Identifier: GPL-3.0-or-later
"""The names of output files."""

from argparse import Namespace
from pathlib import Path


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


def leveled(path: Path, count: int) -> list[Path]:
    """Paths of the levels of detail of a mesh: ``name_lod1.glb`` and so on."""
    return [path.with_name(f"{path.stem}_lod{n}{path.suffix}") for n in range(1, count + 1)]


def meshes(path: Path, cubeness: list[float], levels: list[int]) -> list[Path]:
    """All meshes that a run writes, each with its levels of detail behind it."""
    own = per_cubeness(path, cubeness)
    return [each for path in own for each in (path, *leveled(path, len(levels)))]


def written(options: Namespace) -> list[Path]:
    """All paths that a run writes, but for its report: pictures, then meshes, or an animation."""
    pictures = numbered(options.output, options.turntable) if options.output else []
    mesh, animation = options.save_mesh, [options.bake] if options.bake else []
    own = meshes(mesh, options.cubeness, options.low_poly) if mesh else []
    return pictures + own + animation

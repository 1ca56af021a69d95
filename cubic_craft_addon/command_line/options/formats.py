# SPDX-License-Identifier: GPL-3.0-or-later
"""Which formats can be read, and which are written: those of `send.targets`."""

from ...send.targets import TARGETS

READABLE = (
    (".obj", ".ply", ".stl", ".glb", ".gltf", ".fbx")
    + (".usd", ".usdc", ".usda", ".usdz")
    + (".abc", ".blend")
)


def _suffixes(**wanted: bool) -> tuple[str, ...]:
    return tuple(
        suffix
        for target in TARGETS.values()
        if all(getattr(target, name) == value for name, value in wanted.items())
        for suffix in target.suffixes
    )


WRITABLE = tuple(suffix for suffix in _suffixes() if suffix != ".pc2")
ANIMATED = tuple(suffix for suffix in _suffixes(is_animated=True) if suffix != ".usdz")
"""for the frames of an animation"""
FOR_ENGINES = _suffixes(is_for_engines=True)

# What is read from these has other vertices than the file: corners are joined.
RENUMBER_VERTICES = (".stl", ".glb", ".gltf")

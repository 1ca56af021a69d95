# SPDX-License-Identifier: GPL-3.0-or-later
"""Which formats can be read, and which can be written with vertex order and count kept."""

__all__ = ("ANIMATED", "KEEP_VERTICES", "LOSE_VERTICES", "READABLE", "RENUMBER_VERTICES", "listing")

READABLE = (
    (".obj", ".ply", ".stl", ".glb", ".gltf", ".fbx")
    + (".usd", ".usdc", ".usda", ".usdz")
    + (".abc", ".blend")
)

# Each comes back with the same vertices in the same order: tests/scripts proves it.
KEEP_VERTICES = (".obj", ".ply", ".usd", ".usdc", ".usda", ".usdz", ".abc", ".blend")

# For the frames of an animation.
ANIMATED = (".abc", ".usd", ".usdc", ".usda", ".pc2")

# STL stores triangle corners only, glTF splits vertices at seams, FBX rounds on the way through
# its own units and axes.
LOSE_VERTICES = (".stl", ".glb", ".gltf", ".fbx")

# What is read from these has other vertices than the file: corners are joined.
RENUMBER_VERTICES = (".stl", ".glb", ".gltf")


def listing(suffixes: tuple[str, ...]) -> str:
    """Suffixes as readable text: ``".obj, .ply or .blend"``."""
    *others, last = suffixes
    return f"{', '.join(others)} or {last}" if others else last

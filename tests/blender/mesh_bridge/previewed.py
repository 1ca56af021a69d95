# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of previews share: meshes in all states in which one may begin."""

from typing import Any

from rich_mesh import add_rich_monkey, cubic_like

NOTE = "cubic_craft_note"
STATES = ("plain", "keys", "cubified", "cubified keys", "Cubic", "Cubic beside keys")


def add_monkey(bridge: Any, state: str) -> Any:
    """Add a rich monkey, with shape keys and an earlier result of ours as the state says."""
    obj = add_rich_monkey(keys="keys" in state)
    cubic, rotations = cubic_like(bridge.original_positions(obj.data), 3)
    if "cubified" in state:
        bridge.write_mesh(obj.data, cubic, rotations)
    if "Cubic" in state:
        bridge.write_shape_key(obj, cubic)
    return obj


def show_some(bridge: Any, mesh: Any, seeds: Any = (1, 2)) -> Any:
    """Begin a preview and show some shapes; returns it."""
    base = bridge.original_positions(mesh)
    preview = bridge.Preview(mesh)
    for seed in seeds:
        preview.show(mesh, *cubic_like(base, seed))
    return preview


def live_attributes(mesh: Any) -> list[str]:
    """List what a preview has left on a mesh."""
    points = [a.name for a in mesh.attributes if a.domain == "POINT"]
    return [name for name in points if name.startswith("cubic_craft_live")]

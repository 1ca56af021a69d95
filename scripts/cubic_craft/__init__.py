# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension of this tree under the name of its package, whatever the folder is called.

To import it imports nothing else: ``cubic_craft.solver`` and all other rooms are those of the root.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ("ROOT", "registered")

ROOT = Path(__file__).resolve().parents[2]

__path__ = [str(ROOT)]


@contextmanager
def registered() -> Iterator[None]:
    """Have the extension in Blender for the block, in factory settings without other add-ons."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    from . import operators
    from .cubic_craft_addon import registration

    registration.register()
    operators.register()
    try:
        yield
    finally:
        operators.unregister()
        registration.unregister()

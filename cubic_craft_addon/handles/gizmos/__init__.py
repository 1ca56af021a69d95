# SPDX-License-Identifier: GPL-3.0-or-later
"""Gizmos by which handles are moved, turned and scaled in the viewport while Live runs.

``places`` computes their positions and ``drag`` the effect of a drag on a pose, without a window;
``group`` is what Blender draws and sends mouse events to. While Live does not run, ``marks`` shows
where the handles are.
"""

from . import group, marks

__all__ = ("register", "unregister")


def register():
    """Register the gizmos and the marks."""
    group.register()
    marks.register()


def unregister():
    """Unregister them."""
    marks.unregister()
    group.unregister()

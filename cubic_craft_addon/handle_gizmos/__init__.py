# SPDX-License-Identifier: GPL-3.0-or-later
"""Gizmos by which handles are moved, turned and scaled in the viewport while Live runs.

``places`` says where they are, ``drag`` what a drag makes of a pose, without a window; ``group`` is
what Blender draws and hands the mouse to.
"""

from .group import register, unregister

__all__ = ("register", "unregister")

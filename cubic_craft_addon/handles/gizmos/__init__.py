# SPDX-License-Identifier: GPL-3.0-or-later
"""Gizmos by which handles are moved, turned and scaled in the viewport while Live runs.

``places`` computes their positions and ``drag`` the effect of a drag on a pose, without a window;
``group`` is what Blender draws and sends mouse events to.
"""

from .group import register, unregister

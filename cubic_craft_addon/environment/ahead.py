# SPDX-License-Identifier: GPL-3.0-or-later
"""What the first Cubify needs is loaded while the artist looks at the panel.

In pieces, between which Blender draws. The first click of each start of Blender then takes as long
as all others.
"""

import logging
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import bpy

from ...solver import loading_steps
from .kernel_cache import use_extension_folder
from .requirements import check_known_requirements

if TYPE_CHECKING:
    from ...solver.aliases import Device

FIRST_PAUSE = 0.3
"""seconds from the panel's first drawing, so that it is seen at once"""
PAUSE = 0.05
"""seconds between two pieces"""

_log = logging.getLogger(__name__)
_steps: Iterator[None] | None = None


def load_ahead(device: str) -> None:
    """Begin to load, unless that has been done; for each redraw.

    `device`: of the settings, such as "AUTO".
    """
    global _steps
    if _steps is not None or bpy.app.background:
        return
    _steps = loading_steps(cast("Device", device.lower()))
    bpy.app.timers.register(_next_step, first_interval=FIRST_PAUSE, persistent=True)


def _next_step():
    try:
        check_known_requirements()
        use_extension_folder()
        next(_steps or iter(()))
    except StopIteration:
        return None
    except Exception as error:  # nobody has asked for anything yet; the click tells what is wrong
        _log.debug("nothing more is loaded ahead: %s", error)
        return None
    return PAUSE


def unregister():
    """Load nothing more."""
    global _steps
    if bpy.app.timers.is_registered(_next_step):
        bpy.app.timers.unregister(_next_step)
    _steps = None

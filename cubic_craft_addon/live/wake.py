# SPDX-License-Identifier: GPL-3.0-or-later
"""How a changed property wakes Live, which has no timer while it is idle."""

from collections.abc import Callable

_listener: Callable[[], None] | None = None


def listen(listener: Callable[[], None] | None) -> None:
    """Set the function to call when a setting of Live changes, or None."""
    global _listener
    _listener = listener


def on_property(_properties, _context):
    """Pass the update of a property on."""
    if _listener is not None:
        _listener()

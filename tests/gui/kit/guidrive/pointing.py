# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the mouse is moved, and its wheel turned."""

from .events import events, settle


def move_mouse(point):
    """Move the mouse to a point."""
    events().move(*point)
    yield from settle()


def turn_wheel(wheel, steps):
    """Turn the mouse wheel: "WHEELUPMOUSE" or "WHEELDOWNMOUSE"."""
    for _ in range(steps):
        events().press(wheel)
        yield from settle()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Drive a GUI Blender from inside: open tabs, click buttons, drag sliders, press keys, check.

A test is a generator function; ``run(test)`` at the end of the script starts it. All that needs
Blender to react is called with ``yield from`` (without it, nothing happens); a bare ``yield`` gives
Blender one turn of its main loop: handle events, run modal operators, redraw. Wait on conditions
with ``wait_until``, not on seconds; ``yield 3.0`` leaves Blender alone for that long, to see that
nothing happens. Points are window pixels, from the bottom left.

    import guidrive as gui

    def test():
        yield from gui.open_sidebar("My Tab")
        button = yield from gui.find_button("my_extension.run")
        yield from gui.click(button)
        yield from gui.wait_until(lambda: gui.running_operators() == ["MY_EXTENSION_OT_run"])

    gui.run(test)
"""

from .buttons import button_under_mouse, find_button, open_sidebar
from .events import events
from .gestures import click, drag, drag_slider, enter_value, keys, type_text, undo
from .pictures import screenshot, smooth_screenshot
from .pointing import move_mouse, turn_wheel
from .runner import log, python_errors, run
from .screen import (
    Button,
    area,
    in_region,
    region,
    running_operators,
    simplify_viewport,
    viewport_point,
    window,
)
from .waiting import counts, wait_redraw, wait_until

__all__ = [
    "Button",
    "area",
    "button_under_mouse",
    "click",
    "counts",
    "drag",
    "drag_slider",
    "enter_value",
    "events",
    "find_button",
    "in_region",
    "keys",
    "log",
    "move_mouse",
    "open_sidebar",
    "python_errors",
    "region",
    "run",
    "running_operators",
    "screenshot",
    "simplify_viewport",
    "smooth_screenshot",
    "turn_wheel",
    "type_text",
    "undo",
    "viewport_point",
    "wait_redraw",
    "wait_until",
    "window",
]

# SPDX-License-Identifier: GPL-3.0-or-later
"""What a hand does: move, click, drag, press keys, type."""

from .buttons import reach
from .events import events, settle
from .pointing import move_mouse
from .screen import Button, viewport_point
from .waiting import counts, wait_until


def click(target, button="LEFTMOUSE"):
    """Click on a Button or on a point."""
    if isinstance(target, Button):
        yield from reach(target)
    else:
        yield from move_mouse(target)
    events().press(button)
    yield from settle()
    events().release(button)
    yield from settle()


def drag(start, end, steps=4, button="LEFTMOUSE"):
    """Press at a point, move to another in some steps, release."""
    yield from move_mouse(start)
    events().press(button)
    yield from settle()
    for step in range(1, steps + 1):
        x, y = (round(a + (b - a) * step / steps) for a, b in zip(start, end, strict=True))
        yield from move_mouse((x, y))
    events().release(button)
    yield from settle()


def drag_slider(slider, start=0.5, end=0.9, steps=4):
    """Drag in a slider found by find_button, between two fractions of its width."""
    slider = yield from reach(slider, start)
    yield from drag(slider.at(start), slider.at(end), steps)


def keys(*combinations):
    """Press keys by their names in bpy.types.Event, such as "ESC", "RET", "TAB", "CTRL+SHIFT+Z".

    They go to the region under the mouse; see viewport_point and move_mouse.
    """
    for combination in combinations:
        *modifiers, key = combination.split("+")
        modifiers = [f"LEFT_{modifier}" for modifier in modifiers]
        for name in (*modifiers, key):
            events().press(name)
            yield from settle()
        for name in (key, *reversed(modifiers)):
            events().release(name)
            yield from settle()


def type_text(text):
    """Type letters, digits, spaces and . , - _ into the field that is being edited."""
    for character in text:
        events().type(character)
        yield from settle()


def enter_value(field, value, end="RET"):
    """Type a value into a number or text field found by find_button, and confirm it by a key."""
    field = yield from reach(field)
    events().press("LEFT_CTRL")  # Ctrl and click starts to edit a slider, too
    yield from settle()
    yield from click(field.at())
    events().release("LEFT_CTRL")
    yield from settle()
    yield from keys("CTRL+A")
    yield from type_text(str(value))
    yield from keys(end)


def undo():
    """Press Ctrl-Z over the viewport and wait until Blender has taken back one step.

    References to objects, meshes and scenes taken before are invalid after it.
    """
    undone = counts["undo"]
    yield from move_mouse(viewport_point())
    yield from keys("CTRL+Z")
    yield from wait_until(lambda: counts["undo"] > undone, what="undo")

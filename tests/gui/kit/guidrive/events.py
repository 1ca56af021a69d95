# SPDX-License-Identifier: GPL-3.0-or-later
"""Where mouse and key events come from: Blender itself, or the X server."""

import functools
import subprocess

import bpy

from .screen import viewport_point, window, x_window

_MODIFIERS = {"LEFT_CTRL": "ctrl", "LEFT_SHIFT": "shift", "LEFT_ALT": "alt"}
_DIGITS = ("ZERO", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE")
_CHARACTERS = {" ": "SPACE", ".": "PERIOD", ",": "COMMA", "-": "MINUS", "_": "MINUS"}


class _SimulatedEvents:
    """Events made by Blender itself (it was started with --enable-event-simulate)."""

    turns = 2  # of the main loop: the mouse leaves a button in the first, enters one in the second

    def __init__(self):
        self.x, self.y = viewport_point()
        self.held = set()

    def _send(self, name, value, **extra):
        flags = {flag: name in self.held for name, flag in _MODIFIERS.items()}
        window().event_simulate(type=name, value=value, x=self.x, y=self.y, **flags, **extra)

    def move(self, x, y):
        self.x, self.y = x, y
        self._send("MOUSEMOVE", "NOTHING")

    def press(self, name):
        self.held.add(name)
        self._send(name, "PRESS")

    def release(self, name):
        self.held.discard(name)
        self._send(name, "RELEASE")

    def type(self, character):
        name = _CHARACTERS.get(character, character.upper())
        if character.isdigit():
            name = _DIGITS[int(character)]
        self._send(name, "PRESS", unicode=character)
        self._send(name, "RELEASE")


_X_BUTTONS = {
    "LEFTMOUSE": 1,
    "MIDDLEMOUSE": 2,
    "RIGHTMOUSE": 3,
    "WHEELUPMOUSE": 4,
    "WHEELDOWNMOUSE": 5,
}
_X_KEYS = {
    "BACK_SPACE": "BackSpace",
    "DEL": "Delete",
    "DOWN_ARROW": "Down",
    "END": "End",
    "ESC": "Escape",
    "HOME": "Home",
    "LEFT_ALT": "Alt_L",
    "LEFT_ARROW": "Left",
    "LEFT_CTRL": "Control_L",
    "LEFT_SHIFT": "Shift_L",
    "NUMPAD_1": "KP_1",
    "NUMPAD_ENTER": "KP_Enter",
    "RET": "Return",
    "RIGHT_ARROW": "Right",
    "TAB": "Tab",
    "UP_ARROW": "Up",
}


class _XEvents:
    """Real X events by xdotool (the run scripts' -x); Blender's window fills the screen."""

    turns = 4  # the X server needs some more

    def __init__(self):
        # Otherwise Blender itself moves the pointer while a slider is dragged.
        bpy.context.preferences.inputs.use_mouse_continuous = False
        self.x, self.y = viewport_point()
        self._xdotool("windowfocus", "--sync", x_window())

    def _xdotool(self, *arguments):
        command = ["xdotool", *map(str, arguments)]
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout

    def _key(self, name):
        if name in _DIGITS:
            return _DIGITS.index(name)
        is_function_key = name[0] == "F" and name[1:].isdigit()
        return _X_KEYS.get(name, name if is_function_key else name.lower())

    def move(self, x, y):
        self.x, self.y = x, y
        self._xdotool("mousemove", x, window().height - 1 - y)

    def press(self, name):
        if name.startswith("WHEEL"):
            self._xdotool("click", _X_BUTTONS[name])
        elif name in _X_BUTTONS:
            self._xdotool("mousedown", _X_BUTTONS[name])
        else:
            self._xdotool("keydown", self._key(name))

    def release(self, name):
        if name in _X_BUTTONS:
            self._xdotool("mouseup", _X_BUTTONS[name])
        else:
            self._xdotool("keyup", self._key(name))

    def type(self, character):
        self._xdotool("type", "--", character)


@functools.cache
def events():
    """Return the one source of events of this run."""
    return _SimulatedEvents() if bpy.app.use_event_simulate else _XEvents()


def settle():
    """Give Blender the turns that it needs to handle the events sent."""
    for _ in range(events().turns):
        yield

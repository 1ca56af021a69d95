# SPDX-License-Identifier: GPL-3.0-or-later
"""Where mouse and key events come from: Blender makes them itself."""

import functools

from .screen import viewport_point, window

_MODIFIERS = {"LEFT_CTRL": "ctrl", "LEFT_SHIFT": "shift", "LEFT_ALT": "alt"}
_DIGITS = ("ZERO", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE")
_CHARACTERS = {" ": "SPACE", ".": "PERIOD", ",": "COMMA", "-": "MINUS", "_": "MINUS"}


class _Events:
    """Events made by Blender itself (it was started with --enable-event-simulate)."""

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


@functools.cache
def events():
    """Return the one source of events of this run."""
    return _Events()


def settle():
    """Give Blender the turns that it needs to handle the events sent."""
    for _ in range(2):  # the mouse leaves a button in the first, enters one in the second
        yield

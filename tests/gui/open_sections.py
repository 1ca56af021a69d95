# SPDX-License-Identifier: GPL-3.0-or-later
"""Open the sections of the panel that most tests click in, before it is drawn for the first time.

An artist finds all of them closed but the first; `as_shipped` shows the panel like that.
"""

import importlib

_OPEN = ("orientation", "handles", "map", "result")

_panel = importlib.import_module("bl_ext.user_default.cubic_craft.cubic_craft_addon.ui.panel")
_shipped = _panel._SECTIONS
_panel._SECTIONS = tuple(
    (name, title, draw, is_closed and not name.endswith(_OPEN))
    for name, title, draw, is_closed in _shipped
)


def as_shipped():
    """Leave the sections to themselves."""
    _panel._SECTIONS = _shipped

# SPDX-License-Identifier: GPL-3.0-or-later
"""The one exception of the extension that is meant for the artist."""


class CubicCraftError(ValueError):
    """Something the user gave cannot be used.

    The message is one line, ready to be shown: it names the thing and the cure.
    """

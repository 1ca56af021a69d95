# SPDX-License-Identifier: GPL-3.0-or-later
"""What ends the command with one line."""


class InputError(Exception):
    """A file or an option that cannot be used; the message is one line, ready to be shown."""

# SPDX-License-Identifier: GPL-3.0-or-later
"""The one error that ends a run with exit code 2."""


class InputError(ValueError):
    """Something the user gave cannot be used.

    The message is one line: it names the option or file, the reason and the cure.
    """

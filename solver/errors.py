# SPDX-License-Identifier: GPL-3.0-or-later
"""The only exception whose message is meant for the user."""


class CubicCraftError(ValueError):
    """Invalid input.

    The message is one line, ready to be shown: it names the problem and the remedy.

    Examples
    --------
    >>> from solver import CubicCraftError, stylize
    >>> try:
    ...     stylize([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], cubeness=-1.0)
    ... except CubicCraftError as error:
    ...     print(error)
    cubeness must be finite and not negative
    """

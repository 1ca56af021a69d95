# SPDX-License-Identifier: GPL-3.0-or-later
"""Messages about unexpected errors."""

UNEXPECTED = (Exception, KeyboardInterrupt)
"""errors that an operator reports itself, because Blender would show a traceback"""


def in_words(error: BaseException) -> str:
    """Return an error as one short line, without a full stop."""
    if isinstance(error, MemoryError):
        return "there is not enough memory: close other programs, or use a mesh with fewer vertices"
    if isinstance(error, KeyboardInterrupt):
        return "it was interrupted"
    lines = str(error).strip().splitlines()
    return lines[0].strip().rstrip(".") if lines else type(error).__name__

# SPDX-License-Identifier: GPL-3.0-or-later
"""Names and messages as they can be printed, whoever has chosen the names."""


def one_line(text: str) -> str:
    """Return a text, such as a file's name, as it can be printed in one line."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: looks that are included with the extension, and those that the artist has saved.

``included`` has the former, ``files`` reads and writes the latter, ``selector`` is the property
that the panel shows, with a picture of each, and ``panel`` draws it.
"""

from .selector import forget as unregister

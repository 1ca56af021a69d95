# SPDX-License-Identifier: GPL-3.0-or-later
"""Where buttons were found before, in this run and earlier ones: where to look first.

A hint only: the mouse still has to meet the button there. Earlier runs are remembered where
GUIDRIVE_PLACES names a file.
"""

import functools
import json
import os
import pathlib

MOST = 4  # places of one button: as panels open and close, it moves

_path = os.environ.get("GUIDRIVE_PLACES")


def known(key):
    """Return the places of a button, the latest first: its edges, and how far it was scrolled."""
    return _places().get(key, [])


def remember(key, place):
    """Keep the place of a button."""
    others = [other for other in known(key) if other != place]
    _places()[key] = [place, *others][:MOST]
    if _path:
        new = pathlib.Path(f"{_path}.{os.getpid()}")
        new.write_text(json.dumps(_places()))
        new.replace(_path)


@functools.cache
def _places():
    try:
        return json.loads(pathlib.Path(_path or "").read_text())
    except (OSError, ValueError):
        return {}

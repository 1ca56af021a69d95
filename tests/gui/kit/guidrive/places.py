# SPDX-License-Identifier: GPL-3.0-or-later
"""Where buttons were found before, in this run and earlier ones: where to look first.

A hint only: the mouse still has to meet the button there. Earlier runs are remembered where
GUIDRIVE_PLACES names a file. While there is no such file, the places.json beside the script is
taken, so that a fresh machine does not have to search for all buttons once.
"""

import functools
import json
import os
import pathlib
import sys

MOST = 4  # places of one button: as panels open and close, it moves

_path = os.environ.get("GUIDRIVE_PLACES")
_files = [pathlib.Path(sys.path[0], "places.json")]  # the run scripts put the folder there
if _path:
    _files.insert(0, pathlib.Path(_path))


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
    for path in _files:
        if path.exists():
            try:
                return json.loads(path.read_text())
            except (OSError, ValueError):
                continue
    return {}

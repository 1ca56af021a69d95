# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep the places of buttons that runs have learned.

    keep_places.py LEARNED.json... KEPT.json

Of each button and size of its region, the places of all runs, those of the first file first, and
those that were kept already last.
"""

import json
import pathlib
import sys

MOST = 4

*learned, kept = map(pathlib.Path, sys.argv[1:])
places = {}
for path in (*learned, kept):
    for button, found in json.loads(path.read_text()).items():
        others = [place for place in found if place not in places.get(button, [])]
        places[button] = (places.get(button, []) + others)[:MOST]
lines = [f"{json.dumps(button)}: {json.dumps(places[button])}" for button in sorted(places)]
kept.write_text("{\n" + ",\n".join(lines) + "\n}\n")

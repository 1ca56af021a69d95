# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare what is declared with a file of what was declared, of one line an entry."""

import json
from pathlib import Path


def check(found, path):
    """Refuse what differs, with the lines as they would have to stand in the file.

    `found`: names, and values for JSON. `path`: a JSON file with a dict.
    """
    now = lines(found)
    then = lines(json.loads(Path(path).read_text(encoding="utf-8"))) if path.exists() else []
    gone, new = sorted(set(then) - set(now)), sorted(set(now) - set(then))
    assert not (gone or new), "\n".join([f"not in {path.name} as it is now:", *new, "was:", *gone])


def lines(values):
    """Return the lines of a file, without commas."""
    return [f"{json.dumps(n)}: {json.dumps(values[n], sort_keys=True)}" for n in sorted(values)]

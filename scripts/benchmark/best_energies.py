# SPDX-License-Identifier: GPL-3.0-or-later
"""The lowest energies ever reached, kept beside this file in ``best_energies.json``."""

import json
from pathlib import Path

BOOK = Path(__file__).with_name("best_energies.json")


class BestEnergies:
    """A file of energies in the unit box, by mesh, number of vertices and cubeness.

    Parameters
    ----------
    path : Path
        Need not exist yet.
    """

    def __init__(self, path=BOOK):
        self._path = path
        self._entries = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}

    def get(self, mesh, vertices, cubeness):
        """Return the lowest known energy, or None."""
        entry = self._entries.get(_key(mesh, vertices, cubeness))
        return entry and entry["energy"]

    def offer(self, mesh, vertices, cubeness, energy, found_by):
        """Keep an energy if it is lower than the known one; tell whether it was, and save it.

        Parameters
        ----------
        mesh : str
        vertices : int
        cubeness, energy : float
        found_by : str
            What reached it, for the reader of the file.
        """
        known = self.get(mesh, vertices, cubeness)
        if known is not None and not energy < known:
            return False
        entry = {"energy": energy, "found_by": found_by}
        self._entries[_key(mesh, vertices, cubeness)] = entry
        text = json.dumps(dict(sorted(self._entries.items(), key=_by_mesh_and_size)), indent=1)
        self._path.write_text(text + "\n", encoding="utf-8")
        return True


def _key(mesh, vertices, cubeness):
    return f"{mesh} {vertices} {cubeness:g}"


def _by_mesh_and_size(item):
    mesh, vertices, cubeness = item[0].rsplit(" ", 2)
    return mesh, int(vertices), float(cubeness)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The lowest energies ever reached, kept beside this file in ``best_energies.json``."""

import json
import math
from pathlib import Path

BOOK = Path(__file__).with_name("best_energies.json")


class BestEnergies:
    """A file of energies in the unit box, by mesh, number of vertices and cubeness."""

    def __init__(self, path=BOOK):
        self._path = path
        self._entries = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}

    def get(self, *case):
        """Return the lowest known energy of (mesh, vertices, cubeness), or None."""
        return self._entries.get(_key(*case), {}).get("energy")

    def offer(self, *case, energy, found_by):
        """Keep an energy if it is lower than the known one; return whether it was.

        `found_by` tells the reader of the file what reached it.
        """
        known = self.get(*case)
        if known is not None and not energy < known:
            return False
        self._entries[_key(*case)] = {"energy": energy, "found_by": found_by}
        entries = sorted(self._entries.items(), key=_by_mesh_and_size)
        lines = [f"{json.dumps(key)}: {json.dumps(entry)}" for key, entry in entries]
        self._path.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
        return True


def keep_lower_energies(results, best):
    """Put energies that are lower than known ones into the BestEnergies."""
    for case in results["race"] + results["scaling"]:
        name = case["mesh"], case["vertices"], case["cubeness"]
        seen = [run["energy"] for run in case["ours"]] + [case["best"] or math.inf]
        best.offer(*name, energy=min(seen), found_by="the benchmark")


def _key(mesh, vertices, cubeness):
    return f"{mesh} {vertices} {cubeness:g}"


def _by_mesh_and_size(item):
    mesh, vertices, cubeness = item[0].rsplit(" ", 2)
    return mesh, int(vertices), float(cubeness)

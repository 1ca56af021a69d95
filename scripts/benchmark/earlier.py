# SPDX-License-Identifier: GPL-3.0-or-later
"""The solver of the prototype, as the history of this repository has it."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

COMMIT = "9c85a9d"
"""the last before meshes were welded, linked and refined"""
_ROOT = Path(__file__).resolve().parents[2]
_RUN = """
import json, sys, time
import numpy as np
from solver import stylize

with np.load(sys.argv[1]) as mesh:
    V, F = mesh["V"], mesh["F"]
cubeness, runs = float(sys.argv[2]), int(sys.argv[3])
stylize(V, F, cubeness, max_iterations=3)  # imports, and cold caches
results = []
for _ in range(runs):
    curve, begin = [], time.perf_counter()

    def note(state):
        curve.append([time.perf_counter() - begin, state.energy.total])

    result = stylize(V, F, cubeness, on_iteration=note)
    seconds = time.perf_counter() - begin
    figures = {"seconds": seconds, "iterations": result.iterations, "reason": result.reason}
    results.append(figures | {"curve": curve})
print(json.dumps(results))
"""


def earlier(path, cubeness, runs):
    """Run an .npz of `meshes.keep`, each time to its own stop; return the runs.

    Returns
    -------
    list of dict
        Empty where this folder has no history, as in a shallow clone.
    """
    git = ["git", "-C", str(_ROOT), "archive", COMMIT, "solver"]
    archive = subprocess.run(git, capture_output=True, check=False)
    if archive.returncode:
        return []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["tar", "-x", "-C", folder], input=archive.stdout, check=True)
        run = [sys.executable, "-c", _RUN, str(path.resolve()), str(cubeness), str(runs)]
        printed = subprocess.run(run, cwd=folder, stdout=subprocess.PIPE, check=True).stdout
    return json.loads(printed.decode().splitlines()[-1])  # Taichi's greeting comes before

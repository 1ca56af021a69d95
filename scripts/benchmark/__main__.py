# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure the solver side by side with PyMeshLab, and its defaults, and write the page; see --help.

Results go to build/bench as JSON as well, for comparison with later ones.
"""

import argparse
import json
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

from benchmark import runs  # noqa: E402
from benchmark.meshes import known_meshes  # noqa: E402
from benchmark.page import page  # noqa: E402

BUILD = ROOT / "build" / "bench"
WITH_PYMESHLAB = ("spot", "bunny", "horse", "blob-10k")
"""meshes of which PyMeshLab does not take minutes"""
LARGE = 25_000
"""vertices from which PyMeshLab is run at one cubeness only"""


def main():
    """Measure; all of it makes the page in docs, a part one in build/bench."""
    parser = argparse.ArgumentParser(prog="benchmark", description=__doc__)
    parser.add_argument(
        "--meshes",
        type=Path,
        default=Path(os.environ.get("CUBIC_CRAFT_MESHES", ROOT / "../shared/meshes")),
        help="folder with bunny.obj, horse.ply and others; without any, bumpy spheres are used",
    )
    parser.add_argument("--quick", action="store_true", help="a part, in less than two minutes")
    options = parser.parse_args()
    count = 1 if options.quick else 3
    meshes = known_meshes(options.meshes)
    if options.quick:
        meshes = {name: mesh for name, mesh in meshes.items() if name in WITH_PYMESHLAB}
    results = {"machine": runs.machine_line(), "runs": count, "pymeshlab": [], "defaults": []}

    def measure(part, function, name, cubeness):
        print(f"{part}: {name} {cubeness}", flush=True)
        V, F = meshes[name]
        figures = runs.isolated(function, V=V, F=F, cubeness=cubeness, runs=count)
        head = {"mesh": name, "vertices": len(V), "cubeness": cubeness}
        results[part].append(head | figures)

    for name in filter(meshes.__contains__, WITH_PYMESHLAB):
        for cubeness in (0.2, 0.4) if len(meshes[name][0]) < LARGE else (0.4,):
            measure("pymeshlab", runs.beside_pymeshlab, name, cubeness)
    for name in meshes:
        measure("defaults", runs.both_settings, name, 0.4)
    BUILD.mkdir(parents=True, exist_ok=True)
    (BUILD / "results.json").write_text(json.dumps(results), encoding="utf-8")
    path = (BUILD if options.quick else ROOT / "docs") / "benchmarks.md"
    path.write_text(page(results), encoding="utf-8")
    print(f"written: {path}")


if __name__ == "__main__":
    main()

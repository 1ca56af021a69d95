# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure the solver side by side with its peers and write the page; see --help.

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
from benchmark.meshes import known_meshes, made_meshes, scaled_meshes  # noqa: E402
from benchmark.page import page  # noqa: E402

BUILD = ROOT / "build" / "bench"
WITH_PYMESHLAB = ("spot", "bunny", "horse", "blob-10k")
"""meshes of which PyMeshLab does not take minutes"""
LARGE = 50_000
"""vertices from which a size is measured only once"""


def arguments():
    """Return the parsed command line."""
    parser = argparse.ArgumentParser(prog="benchmark", description=__doc__)
    parser.add_argument(
        "--meshes",
        type=Path,
        default=Path(os.environ.get("CUBIC_CRAFT_MESHES", ROOT / "../shared/meshes")),
        help="folder with bunny.obj, horse.ply and others; without any, bumpy spheres are used",
    )
    parser.add_argument("--quick", action="store_true", help="a part, in less than two minutes")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS))
    return parser.parse_args()


def main():
    """Measure what was asked for; all of it makes the page in docs, a part one in build/bench."""
    options = arguments()
    count = 1 if options.quick else 3
    is_all = not options.quick and set(options.parts) == set(PARTS)
    meshes = known_meshes(options.meshes)
    if options.quick:
        meshes = {name: mesh for name, mesh in meshes.items() if name in WITH_PYMESHLAB}
    results = {"machine": runs.machine_line(), "runs": count}
    for part, measure in PARTS.items():
        results[part] = []
        for mesh, cubeness, figures in measure(meshes, count) if part in options.parts else ():
            print(f"{part}: {mesh.name} {cubeness}", flush=True)
            head = {"mesh": mesh.name, "vertices": mesh.vertices, "cubeness": cubeness}
            results[part].append(head | figures)
    BUILD.mkdir(parents=True, exist_ok=True)
    (BUILD / "results.json").write_text(json.dumps(results), encoding="utf-8")
    path = (ROOT / "docs" if is_all else BUILD) / "benchmarks.md"
    path.write_text(page(results), encoding="utf-8")
    print(f"written: {path}")


def _ten(meshes, count):
    for mesh in meshes.values():
        case = {"source": mesh.source, "runs": count}
        yield mesh, runs.CUBENESS, runs.isolated(runs.ten_iterations, **case)


def _pymeshlab(meshes, count):
    for mesh in (meshes[name] for name in WITH_PYMESHLAB if name in meshes):
        for cubeness in (0.2, 0.4) if mesh.vertices < LARGE / 2 else (0.4,):
            case = {"path": mesh.path, "cubeness": cubeness, "runs": count}
            yield mesh, cubeness, runs.isolated(runs.beside_pymeshlab, **case)


def _scaling(meshes, count):
    largest = 30_000 if count == 1 else 1_100_000
    for mesh in scaled_meshes(meshes.get("bunny"), largest):
        own = count if mesh.vertices < LARGE else 1
        yield mesh, runs.CUBENESS, runs.isolated(runs.one_size, path=mesh.path, runs=own)


def _defaults(meshes, count):
    for mesh in (*meshes.values(), *made_meshes(4 if count == 1 else 6)):
        case = {"path": mesh.path, "cubeness": runs.CUBENESS, "runs": count}
        yield mesh, runs.CUBENESS, runs.isolated(runs.both_settings, **case)


PARTS = {"ten": _ten, "pymeshlab": _pymeshlab, "scaling": _scaling, "defaults": _defaults}

if __name__ == "__main__":
    main()

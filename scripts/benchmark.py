# SPDX-License-Identifier: GPL-3.0-or-later
"""Time the solver side by side with PyMeshLab's filter, in one run, and write docs/benchmarks.md.

Both run to their own stop, with set-up, without reading the file and without start-up (imports, and
kernels that are compiled once per installation). The energy of both results is evaluated by the
same code: lower is the better solution of the same problem.
"""

import argparse
import os
import platform
import statistics
import sys
import time
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

import numpy as np
import pymeshlab  # pyright: ignore[reportMissingImports]

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from solver import Setup, Stylization, rest_mesh, run  # noqa: E402

CASES = (("bunny.obj", 0.2), ("bunny.obj", 0.4), ("horse.ply", 0.4))
EVALUATION_STEPS = 30
"""local steps that evaluate the energy of a given shape"""


@dataclass
class Timing:
    """One program on one mesh."""

    setup: float
    total: float
    iterations: int | None
    positions: np.ndarray


def main():
    """Run all cases and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--meshes",
        type=Path,
        default=Path(os.environ.get("CUBIC_CRAFT_MESHES", ROOT / "../shared/meshes")),
        help="folder with bunny.obj and horse.ply; without it, subdivided spheres are used",
    )
    parser.add_argument("--runs", type=int, default=3, help="of each program, alternating")
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "benchmarks.md")
    options = parser.parse_args()

    rows = []
    for name, V, F, cubeness in cases(options.meshes):
        ours, theirs = [], []
        ours_once(V, F, cubeness, max_iterations=2)  # loads the kernels
        for _ in range(options.runs):
            ours.append(ours_once(V, F, cubeness))
            theirs.append(pymeshlab_once(V, F, cubeness))
        rows.append(row(name, V, F, cubeness, ours, theirs))
        print(rows[-1], flush=True)
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text(page(rows, options.runs))
    print(f"written to {options.output.name}")


def cases(folder):
    """Yield (name, V, F, cubeness) of the meshes in the folder, or of spheres."""
    if all((folder / name).exists() for name, _ in CASES):
        for name, cubeness in CASES:
            meshes = pymeshlab.MeshSet()
            meshes.load_new_mesh(str(folder / name))
            mesh = meshes.current_mesh()
            yield Path(name).stem, mesh.vertex_matrix(), mesh.face_matrix(), cubeness
        return
    for subdivisions, cubeness in ((5, 0.2), (6, 0.4)):
        meshes = pymeshlab.MeshSet()
        meshes.create_sphere(radius=1.0, subdiv=subdivisions)
        mesh = meshes.current_mesh()
        V = mesh.vertex_matrix()
        V = V * (1 + 0.3 * np.sin(3 * V[:, :1] + 0.4) * np.cos(2 * V[:, 1:2])) * [1.0, 0.8, 1.3]
        yield f"blob of {len(V)}", V, mesh.face_matrix(), cubeness


def ours_once(V, F, cubeness, **options):
    """Time our solver."""
    begin = time.perf_counter()
    setup = Setup(rest_mesh(V, F))
    ready = time.perf_counter()
    stylization = Stylization(setup, cubeness)
    result = run(stylization, **options)
    end = time.perf_counter() - stylization.compile_seconds
    return Timing(ready - begin, end - begin, result.iterations, result.positions)


def pymeshlab_once(V, F, cubeness):
    """Time PyMeshLab's filter with its default stop."""
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(V, F))
    begin = time.perf_counter()
    meshes.apply_coord_cubic_stylization(lcubeness=cubeness, applyef=False, applycol=False)
    end = time.perf_counter()
    return Timing(0.0, end - begin, None, meshes.current_mesh().vertex_matrix())


def energy(V, F, cubeness, positions):
    """Return the energy of a shape, with the rotations that fit it best."""
    setup = Setup(rest_mesh(V, F))
    stylization = Stylization(setup, cubeness)
    return stylization.energy_of(positions, EVALUATION_STEPS).total


def row(name, V, F, cubeness, ours, theirs):
    """Return the line of the table."""
    setup = statistics.median(t.setup for t in ours)
    us = statistics.median(t.total for t in ours)
    them = statistics.median(t.total for t in theirs)
    energies = [energy(V, F, cubeness, timings[-1].positions) for timings in (ours, theirs)]
    return (
        f"| {name} | {len(V):,} | {cubeness} | {us:.2f} s ({setup:.2f} s, {ours[-1].iterations})"
        f" | {energies[0]:.5f} | {them:.2f} s | {energies[1]:.5f} | {them / us:.1f} |"
    )


def page(rows, runs):
    """Return the page."""
    packages = ("numpy", "scipy", "taichi", "cholespy", "pymeshlab")
    versions = ", ".join(f"{name} {metadata.version(name)}" for name in packages)
    return "\n".join(
        [
            "# Benchmarks",
            "",
            "Written by `make bench`. Both programs run to their own stop (relative displacement",
            "below 1e-3; ours asks in addition that the energy no longer falls), with set-up, in",
            f"alternation in one run; medians of {runs}. Times on a shared machine: trust the",
            "ratio, not the seconds. The energy of both results is evaluated by the same code, in",
            "the unit box; lower is better.",
            "",
            f"{os.cpu_count()} cores, {platform.machine()}, {platform.system()},"
            f" Python {platform.python_version()}; {versions}.",
            "",
            "| mesh | vertices | cubeness | CubicCraft (of it set-up; iterations) | energy"
            " | PyMeshLab | energy | times faster |",
            "|---|---|---|---|---|---|---|---|",
            *rows,
            "",
        ]
    )


if __name__ == "__main__":
    main()

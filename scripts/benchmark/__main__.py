# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure the solver side by side with its peers and write the page; see --help.

Results go to build/bench as JSON as well, for comparison with later ones.
"""

import argparse
import json
import os
import sys
from functools import partial
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

from benchmark import page, plots  # noqa: E402
from benchmark.best_energies import BestEnergies, keep_lower_energies  # noqa: E402
from benchmark.suite import FULL, PARTS, QUICK, measure  # noqa: E402
from benchmark.targets import targets  # noqa: E402

BUILD = ROOT / "build" / "bench"


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
    parser.add_argument("--runs", type=int, help="of each program, alternating; default 3, quick 1")
    parser.add_argument("--max-vertices", type=int, help="largest mesh of the scaling run")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS))
    parser.add_argument(
        "--output",
        type=Path,
        help="folder of the page and its images; default docs if all is measured, else build/bench",
    )
    return parser.parse_args()


def main():
    """Run what was asked for."""
    options = arguments()
    plan = QUICK if options.quick else FULL
    given = {"runs": options.runs, "max_vertices": options.max_vertices}
    plan = plan._replace(**{name: value for name, value in given.items() if value})
    is_all = plan == FULL and set(options.parts) == set(PARTS)
    results = measure(plan, options.meshes, options.parts, partial(print, flush=True))
    file = BUILD / ("results.json" if is_all else "results-part.json")
    file.write_text(json.dumps(results), encoding="utf-8")
    if is_all:
        keep_lower_energies(results, BestEnergies())
    print(f"written: {write(results, options.output or (ROOT / 'docs' if is_all else BUILD))}")
    for row in targets(results):
        verdict = "pass" if row["met"] == "yes" else "FAIL"
        print(f"{verdict}  {row['target']}: {row['measured']} ({row['bound']})")


def write(results, folder):
    """Write the page and its images into a folder; return the path of the page."""
    (folder / "images").mkdir(parents=True, exist_ok=True)
    if results["race"]:
        plots.plot_gaps(results["race"], folder / page.GAPS_IMAGE)
    if results["scaling"]:
        plots.plot_scaling(results["scaling"], folder / page.SCALING_IMAGE)
    path = folder / "benchmarks.md"
    path.write_text(page.page(results), encoding="utf-8")
    return path


if __name__ == "__main__":
    main()

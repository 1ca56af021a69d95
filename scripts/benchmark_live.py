# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure the ticks of Live in a real window: a slider is dragged.

Runs tests/gui/bench_live.py in the Blender of the window tests (root, on Debian), and writes
docs/benchmarks_live.md.
"""

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MESHES = ("bunny.obj", "horse.ply")


def main():
    """Run the benchmark and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("zip", type=Path, help="the built extension")
    parser.add_argument(
        "--meshes",
        type=Path,
        default=Path(os.environ.get("CUBIC_CRAFT_MESHES", ROOT / "../shared/meshes")),
        help="folder with bunny.obj and horse.ply; without it, finer monkeys are used",
    )
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "benchmarks_live.md")
    options = parser.parse_args()
    kit = ROOT / "tests" / "gui" / "kit"
    subprocess.run([kit / "setup_blender_gui.sh"], check=True)
    with tempfile.TemporaryDirectory(prefix="cubic_craft_bench_") as folder:
        for name in MESHES:
            if (options.meshes / name).exists():
                shutil.copy(options.meshes / name, folder)
        command = [kit / "run_in_gui.sh", "-p", "-e", options.zip, "-d", folder]
        subprocess.run([*command, ROOT / "tests" / "gui" / "bench_live.py"], check=True)
        text = page(json.loads((Path(folder) / "ticks.json").read_text()))
    options.output.write_text(text)
    sys.stdout.write(text)


def page(rows):
    """Return the page."""
    lines = [
        "# How fluid Live is",
        "",
        "Written by `make bench-live`: ten seconds of dragging the cubeness slider back and",
        "forth in a real window of Blender 4.3 with Taichi, so that the run restarts all the",
        "time. All settings but cubeness are the artist's defaults: solidity 0.1, parts kept",
        "together, coarse meshes refined, rotation kept. The monkey, subdivided once, is a mesh",
        "that is refined.",
        "",
        "A tick is the work of Live between two turns of Blender's main loop. The delay is what",
        "the ticks take from a change of the slider until the mesh shows it, without Blender's own",
        "drawing. The set-up at the start is left out. Times on a shared machine with"
        f" {os.cpu_count()} cores,",
        "without a GPU.",
        "",
        "| mesh | vertices | ticks | per second | median | 95 % | worst | delay: median | worst |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        ticks, delays = sorted(row["ticks"]), row["delays"]
        values = (
            statistics.median(ticks),
            ticks[int(0.95 * len(ticks))],
            ticks[-1],
            statistics.median(delays),
            max(delays),
        )
        cells = " | ".join(f"{1000 * value:.0f} ms" for value in values)
        counts = f"{row['vertices']:,} | {len(ticks)} | {len(ticks) / row['seconds']:.0f}"
        lines.append(f"| {row['mesh']} | {counts} | {cells} |")
    return "\n".join([*lines, ""])


if __name__ == "__main__":
    main()

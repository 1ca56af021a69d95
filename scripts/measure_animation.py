# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how steady the frames of an animation are, and what one costs: docs/steadiness.md.

It prints the tables of that page and draws its plot, ``--plot FILE.png``.
"""

import argparse
import statistics
import sys
import time
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure  # pyright: ignore[reportMissingImports]

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmark.shapes import blob

from solver import (
    Frames,
    FrameSequence,
    ProxyOptions,
    Setup,
    SolverOptions,
    Stylization,
    frame_of,
    least_width,
    rest_mesh,
    run,
)
from solver.frames.steadiness import Jumps, Motion
from solver.mesh.rest_measures import areas_and_normals

CUBENESS = 0.4
COUNT = 60
"""frames"""
LEVELS, LEVELS_OF_COST = 4, 6
"""subdivisions of an icosahedron: 2,562 and 40,962 vertices"""
COSTS = 9
"""frames of which the median cost is taken"""


def main():
    """Print both tables, and draw the plot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plot", type=Path, metavar="FILE.png")
    options = parser.parse_args()
    V, F = blob(LEVELS)
    print(
        f"{len(V):,} vertices, {COUNT} frames, cubeness {CUBENESS}:"
        " jumps over those of the input, angle to axes"
    )
    curves = {}
    for name, frames in movements(V).items():
        found = recorded(frames, F)
        width, ratios = least_width(lambda found=found: [found])
        inputs = Motion()
        inputs.add(frames)
        curves[name] = {
            "each frame alone": alone(frames, F),
            "from the frame before": found.results(0.0),
            f"and smoothed over {width:g} frames": found.results(width),
        }
        for label, results in curves[name].items():
            largest, common = jumps_of(results).over(inputs)
            angle = statistics.median(angle_to_axes(positions, F) for positions in results[::6])
            print(f"| {name} | {label} | {largest:.1f} | {common:.1f} | {angle:.1f}° |")
        assert max(ratios) <= 3.0
        curves[name]["the input"] = frames
    print_costs()
    if options.plot:
        plot(curves, options.plot)


def movements(V):
    """Return the frames (f,n,3) of some movements, by name."""
    times = np.arange(COUNT)
    angles = np.radians(1.0) * times
    turning = [_turned(V, angle) for angle in angles]
    bending = [_bent(V, angle) for angle in np.sin(np.pi * times / COUNT)]
    return {"turns by 1 degree a frame": np.array(turning), "bends and back": np.array(bending)}


def _turned(V, angle):
    cos, sin = np.cos(angle), np.sin(angle)
    return V @ np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])


def _bent(V, angle):
    z = V[:, 2] - V[:, 2].min()
    radius = z.max() / max(angle, 1e-6)
    turn = z / radius
    return np.column_stack(
        [radius - np.cos(turn) * (radius - V[:, 0]), V[:, 1], np.sin(turn) * (radius - V[:, 0])]
    )


def stylization(setup):
    """Return the Stylization of a frame."""
    return Stylization(setup, CUBENESS, options=SolverOptions(keep_rotation=True))


def recorded(frames, F):
    """Solve each frame from the one before."""
    setup = Setup(rest_mesh(frames[0], F, ProxyOptions()))
    sequence, found = FrameSequence(setup.rest), []
    for V in frames:
        result = sequence.solve(stylization(setup.posed(V)))
        found.append(frame_of(V, sequence.turns, result.positions))
    return Frames(*(np.concatenate(part) for part in zip(*found, strict=True)))


def alone(frames, F):
    """Solve each frame as if it were the only one."""
    setups = (Setup(rest_mesh(V, F, ProxyOptions())) for V in frames)
    return np.array([run(stylization(setup)).positions for setup in setups])


def angle_to_axes(V, F):
    """Return the mean angle in degrees of a surface to the sides of the cube, over its area."""
    areas, normals = areas_and_normals(V, F)
    nearest = np.clip(np.abs(normals).max(axis=1), 0.0, 1.0)
    return float(np.degrees(np.average(np.arccos(nearest), weights=areas)))


def jumps_of(positions):
    """Return the Jumps of an animation (f,n,3)."""
    jumps = Jumps()
    jumps.add(positions)
    return jumps


def print_costs():
    """Print what a frame costs beside a Cubify of its own, in turns."""
    V, F = blob(LEVELS_OF_COST)
    setup = Setup(rest_mesh(V, F, ProxyOptions()))
    sequence = FrameSequence(setup.rest)
    sequence.solve(stylization(setup))
    single, frame = [], []
    for number in range(COSTS):
        posed = _bent(V, 0.02 * (number + 1))
        begin = time.perf_counter()
        of_frame = sequence.solve(stylization(setup.posed(posed)))
        frame.append(time.perf_counter() - begin)
        begin = time.perf_counter()
        of_single = run(stylization(Setup(rest_mesh(posed, F, ProxyOptions()))))
        single.append(time.perf_counter() - begin)
    one, other = statistics.median(frame), statistics.median(single)
    print(f"{len(V):,} vertices: a frame {one:.2f} s, a Cubify {other:.2f} s, {one / other:.0%}")
    angles = (angle_to_axes(result.positions, F) for result in (of_frame, of_single))
    print("angles to axes of the last frame and a Cubify of it: {:.1f}°, {:.1f}°".format(*angles))


def plot(curves, path):
    """Draw the largest jump of each frame."""
    figure = Figure(figsize=(9.0, 3.6), layout="constrained")
    panels = figure.subplots(1, len(curves), sharey=True)
    colors = ["tab:red", "tab:orange", "tab:blue", "black"]
    for (name, found), axes in zip(curves.items(), panels, strict=True):
        for (label, positions), color in zip(found.items(), colors, strict=True):
            second = positions[2:] - 2.0 * positions[1:-1] + positions[:-2]
            axes.semilogy(np.linalg.norm(second, axis=2).max(axis=1), color=color, label=label)
        axes.set_title(name, fontsize=10)
        axes.set_xlabel("frame")
        axes.legend(fontsize=7)
        axes.spines[["top", "right"]].set_visible(False)
    panels[0].set_ylabel("largest jump of a vertex")
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    main()

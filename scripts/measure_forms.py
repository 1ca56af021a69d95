# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure what a ball becomes with each form: the table of docs/forms.md.

It prints, in the columns of that table, the number of sides, the share of the area within 6 degrees
of a side before and after, the iterations and the seconds of a run to its end, with its setup, and
in how many of 60 steps of the plain iteration the energy rose.
"""

import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmark.shapes import ball
from figures.forms import HALF_LENGTH, HOUSE

from solver import PAPER, Setup, SolverOptions, Style, Stylization, rest_mesh, stylize
from solver.mesh.rest_measures import triangle_areas_and_normals
from solver.styles import forms
from solver.styles.hulls import simple_hull, spiral
from solver.styles.polytope import from_directions

CUBENESS, NEAR, STEPS = 0.6, np.cos(np.radians(6.0)), 60
LEVELS = 5
"""subdivisions of an icosahedron, which make 10,242 vertices"""
ROUNDING = 1e-12


def main():
    """Print a row for each form."""
    V, F = ball(LEVELS)
    print(f"{len(V):,} vertices, cubeness {CUBENESS}")
    for name, form in bodies().items():
        stylize(V, F, CUBENESS, form=form, max_iterations=2, proxy=PAPER)  # compiles
        begin = time.perf_counter()
        result = stylize(V, F, CUBENESS, form=form, proxy=PAPER)
        seconds = time.perf_counter() - begin
        before, after = (share(U, F, form.normals) for U in (V, result.positions))
        print(
            f"| {name} | {len(form.normals)} | {before:.0%} | {after:.0%} | {result.iterations} |"
            f" {seconds:.1f} | {rises(V, F, form)} |"
        )


def bodies():
    """Return the forms by their names, cube first."""
    house = np.array([(x, y, z) for y in (-HALF_LENGTH, HALF_LENGTH) for x, z in HOUSE])
    return {
        "cube": forms.cube(),
        "octahedron": forms.octahedron(),
        "pyramid, 4 sides": forms.pyramid(4),
        "prism, 6 sides": forms.prism(6),
        "rounded cube": forms.rounded_cube(),
        "12 directions": forms.dodecahedron(),
        "64 directions": from_directions(spiral(64)),
        "hull of a house": simple_hull(house, 64),
        "tetrahedron": forms.tetrahedron(),
        "icosahedron": forms.icosahedron(),
        "rhombic dodecahedron": forms.rhombic_dodecahedron(),
        "cylinder": forms.cylinder(),
        "cone": forms.cone(),
    }


def share(U, F, directions):
    """Return the share of the area that faces one of the directions."""
    areas, normals = triangle_areas_and_normals(U, F)
    return areas[(normals @ directions.T).max(axis=1) > NEAR].sum() / areas.sum()


def rises(V, F, form):
    """Return in how many steps of the plain iteration the energy rises."""
    options = SolverOptions(is_accelerated=False)
    run = Stylization(Setup(rest_mesh(V, F, PAPER)), Style(CUBENESS, form=form), options=options)
    energies = []
    for _ in range(STEPS):
        run.step()
        energies.append(run.energy.total)
    return int((np.diff(energies) > ROUNDING * energies[0]).sum())


if __name__ == "__main__":
    main()

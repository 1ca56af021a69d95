# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured, in which order, how often."""

from typing import NamedTuple

from . import defaults, solver_alone
from .best_energies import BestEnergies
from .machine import isolated, machine_line
from .meshes import known_meshes, made_meshes, scaled_meshes
from .race import race
from .targets import FIFTY_THOUSAND

LARGE = 10_000
"""vertices from which PyMeshLab runs only once"""
LARGE_SCALING = 50_000
"""vertices from which a size is measured only once"""
CUBENESS = solver_alone.CUBENESS
"""of all parts but the race"""
COARSE = 2000
"""vertices up to which Live is measured with the defaults"""
JUDGED_AT = (0.2, CUBENESS, 1.0)
"""cubeness of the meshes that the defaults are judged by: a single case is a matter of luck"""


class Plan(NamedTuple):
    """How much is measured."""

    runs: int
    max_vertices: int
    fineness: int
    """of the meshes that are made"""
    cases: tuple
    """(mesh, cubeness, whether PyMeshLab takes part: the others take it minutes)"""


FULL = Plan(
    runs=3,
    max_vertices=1_100_000,
    fineness=6,
    cases=(
        *[(mesh, value, True) for mesh in ("spot", "bunny", "blob-10k") for value in (0.2, 0.4)],
        *[("homer", 0.2, False), ("homer", 0.4, False), ("owl", 0.4, False), ("horse", 0.2, False)],
        *[("horse", 0.4, True), ("armadillo", 0.2, False), ("armadillo", 0.4, False)],
        ("blob-41k", 0.4, False),
    ),
)
QUICK = Plan(
    runs=1,
    max_vertices=30_000,
    fineness=4,
    cases=(("bunny", 0.2, True), ("horse", 0.4, False), ("blob-10k", 0.2, True)),
)


def measure(plan, folder, parts, say):
    """Measure and return the results by part; those that are left out are empty.

    Meshes of the plan that are not in the folder are left out, too. `say` is told what is being
    measured, in one line.
    """
    meshes = known_meshes(folder)
    results = {"machine": machine_line(), "runs": plan.runs}
    for part, measured in PARTS.items():
        results[part] = list(measured(plan, meshes, say)) if part in parts else []
    return results


def _ten(plan, meshes, say):
    for mesh in _meshes(plan, meshes):
        say(f"ten iterations: {mesh.name}")
        figures = isolated(solver_alone.ten_iterations, source=mesh.source, runs=plan.runs)
        yield _head(mesh) | figures


def _race(plan, meshes, say):
    best = BestEnergies()
    for mesh, cubeness, with_pymeshlab in _cases(plan, meshes):
        say(f"to the best shape: {mesh.name} {cubeness}")
        peer_runs = (plan.runs if mesh.vertices < LARGE else 1) if with_pymeshlab else 0
        head = _head(mesh, cubeness)
        yield head | isolated(
            race,
            path=mesh.path,
            cubeness=cubeness,
            best=best.get(*head.values()),
            runs=plan.runs,
            pymeshlab_runs=peer_runs,
        )


def _scaling(plan, meshes, say):
    best = BestEnergies()
    for mesh in scaled_meshes(meshes.get("bunny"), plan.max_vertices):
        say(f"scaling: {mesh.vertices:,} vertices")
        runs = plan.runs if mesh.vertices < LARGE_SCALING else 1
        head = _head(mesh)
        figures = isolated(solver_alone.one_size, path=mesh.path, runs=runs)
        yield head | {"best": best.get(*head.values())} | figures


def _defaults(plan, meshes, say):
    for mesh in (*_meshes(plan, meshes), *made_meshes(plan.fineness)):
        for cubeness in JUDGED_AT if mesh.vertices in FIFTY_THOUSAND else (CUBENESS,):
            say(f"with the defaults: {mesh.name} {cubeness}")
            case = {"path": mesh.path, "cubeness": cubeness}
            figures = isolated(defaults.side_by_side, **case, runs=plan.runs)
            ticks = isolated(defaults.ticks, **case) if mesh.vertices <= COARSE else []
            yield _head(mesh, cubeness) | figures | {"ticks": ticks}


PARTS = {"ten": _ten, "race": _race, "scaling": _scaling, "defaults": _defaults}


def _cases(plan, meshes):
    return [(meshes[name], *others) for name, *others in plan.cases if name in meshes]


def _meshes(plan, meshes):
    return dict.fromkeys(mesh for mesh, *_ in _cases(plan, meshes))


def _head(mesh, cubeness=CUBENESS):
    return {"mesh": mesh.name, "vertices": mesh.vertices, "cubeness": cubeness}

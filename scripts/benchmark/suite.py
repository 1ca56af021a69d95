# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured, in which order, how often."""

from dataclasses import dataclass

from . import defaults, solver_alone
from .best_energies import BestEnergies
from .find_best import find_best
from .machine import isolated, machine_line
from .meshes import known_meshes, made_meshes, scaled_meshes
from .phases import phases
from .race import race
from .startup import startup

LARGE = 10_000
"""vertices from which the peers run only once"""
LARGE_SCALING = 50_000
"""vertices from which a size is measured only once"""
CUBENESS = solver_alone.CUBENESS
"""of all parts but the race"""
COARSE = 2000
"""vertices up to which Live is measured with the defaults"""


@dataclass(frozen=True)
class Plan:
    """How much is measured."""

    runs: int
    max_vertices: int
    cases: tuple
    """(mesh, cubeness)"""
    pymeshlab: tuple
    """those of the cases that PyMeshLab takes part in: the others take it minutes"""
    ten: tuple
    """meshes"""
    defaults: tuple
    """meshes, the made ones left aside"""
    fineness: int
    """of the made ones"""


FULL = Plan(
    runs=3,
    max_vertices=1_100_000,
    cases=(
        *[(mesh, cubeness) for mesh in ("spot", "bunny", "homer") for cubeness in (0.2, 0.4)],
        *[("owl", 0.4), ("horse", 0.2), ("horse", 0.4), ("armadillo", 0.2), ("armadillo", 0.4)],
        *[("blob-10k", 0.2), ("blob-10k", 0.4), ("blob-41k", 0.4)],
    ),
    pymeshlab=(
        *[(mesh, cubeness) for mesh in ("spot", "bunny") for cubeness in (0.2, 0.4)],
        *[("horse", 0.4), ("blob-10k", 0.2), ("blob-10k", 0.4)],
    ),
    ten=("homer", "bunny", "owl", "horse", "armadillo", "blob-10k", "blob-41k"),
    defaults=("bunny", "owl", "horse", "armadillo", "blob-10k", "blob-41k"),
    fineness=6,
)
QUICK = Plan(
    runs=1,
    max_vertices=30_000,
    cases=(("bunny", 0.2), ("horse", 0.4), ("blob-10k", 0.2)),
    pymeshlab=(("bunny", 0.2), ("blob-10k", 0.2)),
    ten=("bunny", "horse", "blob-10k"),
    defaults=("bunny", "blob-10k"),
    fineness=4,
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
    for mesh in _there(plan.ten, meshes):
        say(f"ten iterations: {mesh.name}")
        figures = isolated(solver_alone.ten_iterations, source=mesh.source, runs=plan.runs)
        yield {"mesh": mesh.name, "vertices": mesh.vertices, **figures}


def _race(plan, meshes, say):
    best = BestEnergies()
    for mesh, cubeness in _cases(plan, meshes):
        say(f"to the best shape: {mesh.name} {cubeness}")
        peer_runs = plan.runs if mesh.vertices < LARGE else 1
        head = _head(mesh, cubeness)
        yield head | isolated(
            race,
            path=mesh.path,
            cubeness=cubeness,
            best=best.get(*head.values()),
            runs=plan.runs,
            plain_runs=peer_runs,
            pymeshlab_runs=peer_runs if (mesh.name, cubeness) in plan.pymeshlab else 0,
        )


def _phases(plan, meshes, say):
    for mesh in dict.fromkeys(mesh for mesh, _ in _cases(plan, meshes)):
        say(f"phases: {mesh.name}")
        yield _head(mesh) | isolated(phases, path=mesh.path, cubeness=CUBENESS)


def _scaling(plan, meshes, say):
    best = BestEnergies()
    for mesh in scaled_meshes(meshes.get("bunny"), plan.max_vertices):
        say(f"scaling: {mesh.vertices:,} vertices")
        runs = plan.runs if mesh.vertices < LARGE_SCALING else 1
        head = _head(mesh)
        figures = isolated(solver_alone.one_size, path=mesh.path, runs=runs)
        yield head | {"best": best.get(*head.values())} | figures


def _defaults(plan, meshes, say):
    for mesh in (*_there(plan.defaults, meshes), *made_meshes(plan.fineness)):
        say(f"with the defaults: {mesh.name}")
        case = {"path": mesh.path, "cubeness": CUBENESS}
        figures = isolated(defaults.side_by_side, **case, runs=plan.runs)
        ticks = isolated(defaults.ticks, **case) if mesh.vertices <= COARSE else []
        yield _head(mesh) | figures | {"ticks": ticks}
    largest = scaled_meshes(meshes.get("bunny"), plan.max_vertices)[-1]
    say(f"with the defaults: {largest.name}, {largest.vertices:,} vertices")
    case = {"path": largest.path, "cubeness": CUBENESS}
    alone = {name: [isolated(defaults.alone, **case, name=name)] for name in defaults.SETTINGS}
    yield _head(largest) | alone | {"ticks": []}


def _startup(plan, meshes, say):
    say("start-up")
    yield startup(plan.runs)


PARTS = {
    "ten": _ten,
    "race": _race,
    "phases": _phases,
    "scaling": _scaling,
    "defaults": _defaults,
    "startup": _startup,
}


def renew_best_energies(plan, folder, seconds, only, say):
    """Look long for lower energies than those known, and keep them; see `find_best`.

    Parameters
    ----------
    only : sequence of str
        If there are any, cases whose "mesh vertices cubeness" begins with one of them.
    """
    meshes = known_meshes(folder)
    sizes = scaled_meshes(meshes.get("bunny"), plan.max_vertices)
    best, known = BestEnergies(), {mesh.vertices for mesh, _ in _cases(plan, meshes)}
    cases = _cases(plan, meshes) + [(m, CUBENESS) for m in sizes if m.vertices not in known]
    for mesh, cubeness in cases:
        case = mesh.name, mesh.vertices, cubeness
        name = f"{mesh.name} {mesh.vertices} {cubeness:g}"
        if mesh.vertices > plan.max_vertices or not name.startswith(tuple(only) or ""):
            continue
        before = best.get(*case)
        energy, found_by = isolated(find_best, path=mesh.path, cubeness=cubeness, seconds=seconds)
        is_new = best.offer(*case, energy=energy, found_by=found_by)
        end = f"new, {found_by}" if is_new else "no better"
        say(f"{name}: known {before}, found {energy:.7f}: {end}")


def _there(names, meshes):
    return [meshes[name] for name in names if name in meshes]


def _cases(plan, meshes):
    return [(meshes[name], cubeness) for name, cubeness in plan.cases if name in meshes]


def _head(mesh, cubeness=CUBENESS):
    return {"mesh": mesh.name, "vertices": mesh.vertices, "cubeness": cubeness}

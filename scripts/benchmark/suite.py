# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured, in which order, how often."""

from typing import NamedTuple

from . import defaults, solver_alone, without_taichi
from .best_energies import BestEnergies
from .cores import on_one_and_all
from .earlier import earlier
from .find_best import find_best
from .machine import isolated, machine_line
from .meshes import known_meshes, made_meshes, scaled_meshes
from .phases import phases
from .race import race
from .startup import startup
from .targets import FIFTY_THOUSAND

LARGE = 10_000
"""vertices from which the peers run only once"""
LARGE_SCALING = 50_000
"""vertices from which a size is measured only once"""
CUBENESS = solver_alone.CUBENESS
"""of all parts but the race"""
MULTIGRID = 100_000
"""vertices of the largest mesh without Taichi: more than are factorised"""
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
        peer_runs = plan.runs if mesh.vertices < LARGE else 1
        head = _head(mesh, cubeness)
        yield head | isolated(
            race,
            path=mesh.path,
            cubeness=cubeness,
            best=best.get(*head.values()),
            runs=plan.runs,
            plain_runs=peer_runs,
            pymeshlab_runs=peer_runs if with_pymeshlab else 0,
        )


def _phases(plan, meshes, say):
    for mesh in _meshes(plan, meshes):
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
    for mesh in (*_meshes(plan, meshes), *made_meshes(plan.fineness)):
        for cubeness in JUDGED_AT if mesh.vertices in FIFTY_THOUSAND else (CUBENESS,):
            say(f"with the defaults: {mesh.name} {cubeness}")
            case = {"path": mesh.path, "cubeness": cubeness}
            figures = isolated(defaults.side_by_side, **case, runs=plan.runs)
            ticks = isolated(defaults.ticks, **case) if mesh.vertices <= COARSE else []
            before = earlier(**case, runs=plan.runs)
            yield _head(mesh, cubeness) | figures | {"ticks": ticks, "earlier": before}
    largest = scaled_meshes(meshes.get("bunny"), plan.max_vertices)[-1]
    say(f"with the defaults: {largest.name}, {largest.vertices:,} vertices")
    case = {"path": largest.path, "cubeness": CUBENESS}
    alone = {name: [isolated(defaults.alone, **case, name=name)] for name in defaults.SETTINGS}
    yield _head(largest) | alone | {"ticks": [], "earlier": []}


def _numpy(plan, meshes, say):
    largest = scaled_meshes(meshes.get("bunny"), min(plan.max_vertices, MULTIGRID))[-1:]
    for mesh in (*_meshes(plan, meshes), *largest):
        say(f"without Taichi: {mesh.name}, {mesh.vertices:,} vertices")
        case = {"path": mesh.path, "cubeness": CUBENESS, "runs": plan.runs}
        yield _head(mesh) | isolated(without_taichi.side_by_side, **case)


def _cores(plan, meshes, say):
    for mesh in _meshes(plan, meshes):
        if mesh.vertices >= LARGE:
            say(f"cores: {mesh.name}")
            found = on_one_and_all(mesh.path, CUBENESS)
            if found is not None:
                yield _head(mesh) | found


def _startup(plan, meshes, say):
    say("start-up")
    yield startup(plan.runs)


PARTS = {
    "ten": _ten,
    "race": _race,
    "phases": _phases,
    "scaling": _scaling,
    "defaults": _defaults,
    "numpy": _numpy,
    "cores": _cores,
    "startup": _startup,
}


def renew_best_energies(plan, folder, seconds, only, say):
    """Look long for lower energies than those known, and keep them; see `find_best`.

    If `only` names any, only cases are looked at whose "mesh vertices cubeness" begins so.
    """
    meshes, best = known_meshes(folder), BestEnergies()
    cases = [(mesh, cubeness) for mesh, cubeness, _ in _cases(plan, meshes)]
    known = {mesh.vertices for mesh, _ in cases}
    sizes = scaled_meshes(meshes.get("bunny"), plan.max_vertices)
    for mesh, cubeness in cases + [(m, CUBENESS) for m in sizes if m.vertices not in known]:
        case = mesh.name, mesh.vertices, cubeness
        name = " ".join(map(str, case))
        if mesh.vertices > plan.max_vertices or not name.startswith(tuple(only) or ""):
            continue
        before = best.get(*case)
        energy, found_by = isolated(find_best, path=mesh.path, cubeness=cubeness, seconds=seconds)
        is_new = best.offer(*case, energy=energy, found_by=found_by)
        end = f"new, {found_by}" if is_new else "no better"
        say(f"{name}: known {before}, found {energy:.7f}: {end}")


def _cases(plan, meshes):
    return [(meshes[name], *others) for name, *others in plan.cases if name in meshes]


def _meshes(plan, meshes):
    return dict.fromkeys(mesh for mesh, *_ in _cases(plan, meshes))


def _head(mesh, cubeness=CUBENESS):
    return {"mesh": mesh.name, "vertices": mesh.vertices, "cubeness": cubeness}

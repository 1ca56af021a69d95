# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured, in which order, how often."""

from dataclasses import dataclass

from . import scaling, startup
from .best_energies import BestEnergies
from .defaults import SETTINGS
from .isolated import call
from .machine import machine_line
from .made_meshes import made_meshes
from .meshes import known_meshes
from .scaled_meshes import scaled_meshes

PARTS = ("ten", "race", "phases", "scaling", "defaults", "startup")
LARGE = 10_000
"""vertices from which the peers run only once"""
LARGE_SCALING = 50_000
"""vertices from which a size is measured only once"""
PHASES_CUBENESS = DEFAULTS_CUBENESS = 0.4
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


def measure(plan, folder, cache, parts, say):
    """Measure and return the results by part; parts that are left out are empty.

    Parameters
    ----------
    plan : Plan
        Meshes that are not there are left out.
    folder, cache : Path
        Of the meshes as they are, and as they are kept.
    parts : collection of str
        Some of PARTS.
    say : callable
        Is told what is being measured, in one line.
    """
    meshes = known_meshes(folder, cache)
    best = BestEnergies()
    cases = [(meshes[name], cubeness) for name, cubeness in plan.cases if name in meshes]
    results = {"machine": machine_line(), "runs": plan.runs}
    results |= {part: [] for part in PARTS} | {"startup": {}}
    if "ten" in parts:
        for name in plan.ten:
            if name in meshes:
                say(f"ten iterations: {name}")
                results["ten"].append(_ten(meshes[name], plan.runs))
    if "race" in parts:
        for mesh, cubeness in cases:
            say(f"to the best shape: {mesh.name} {cubeness}")
            results["race"].append(_race(mesh, cubeness, plan, best))
    if "phases" in parts:
        for mesh in dict.fromkeys(mesh for mesh, _ in cases):
            say(f"phases: {mesh.name}")
            figures = call("phases", "phases", path=str(mesh.path), cubeness=PHASES_CUBENESS)
            results["phases"].append(_head(mesh, PHASES_CUBENESS) | figures)
    if "scaling" in parts:
        for mesh in scaled_meshes(meshes.get("bunny"), cache, plan.max_vertices):
            say(f"scaling: {mesh.vertices:,} vertices")
            results["scaling"].append(_one_size(mesh, plan, best))
    if "defaults" in parts:
        results["defaults"] = _all_defaults(plan, meshes, cache, say)
    if "startup" in parts:
        say("start-up")
        results["startup"] = startup.startup(plan.runs)
    return results


def renew_best_energies(plan, folder, cache, seconds, only, say):
    """Look long for lower energies than those known, and keep them.

    Parameters
    ----------
    plan, folder, cache, say
        As in `measure`; meshes above the plan's ``max_vertices`` are left out.
    seconds : float
        See `find_best`.
    only : sequence of str
        If there are any, cases whose "mesh vertices cubeness" begins with one of them.
    """
    meshes = known_meshes(folder, cache)
    cases = [(meshes[name], cubeness) for name, cubeness in plan.cases if name in meshes]
    for mesh in scaled_meshes(meshes.get("bunny"), cache, plan.max_vertices):
        if all(mesh.vertices != known.vertices for known, _ in cases):
            cases.append((mesh, scaling.CUBENESS))
    best = BestEnergies()
    for mesh, cubeness in cases:
        name = f"{mesh.name} {mesh.vertices} {cubeness:g}"
        is_wanted = not only or name.startswith(tuple(only))
        if mesh.vertices > plan.max_vertices or not is_wanted:
            continue
        known = best.get(mesh.name, mesh.vertices, cubeness)
        arguments = {"path": str(mesh.path), "cubeness": cubeness, "seconds": seconds}
        energy, found_by = call("find_best", "find_best", **arguments)
        is_new = best.offer(mesh.name, mesh.vertices, cubeness, energy, found_by)
        end = f"new, {found_by}" if is_new else "no better"
        say(f"{name}: known {known}, found {energy:.7f}: {end}")


def keep_lower_energies(results, best):
    """Put energies that are lower than known ones into the BestEnergies.

    A first one comes from `renew_best_energies` alone: the end of one run says too little.
    """
    for case in results["race"] + results["scaling"]:
        name = case["mesh"], case["vertices"], case["cubeness"]
        energy = min(run["energy"] for run in case["ours"])
        if best.get(*name) is not None:
            best.offer(*name, min(energy, case["best"]), "the benchmark")


def _head(mesh, cubeness):
    return {"mesh": mesh.name, "vertices": mesh.vertices, "cubeness": cubeness}


def _ten(mesh, runs):
    figures = call("ten_iterations", "ten_iterations", source=str(mesh.source), runs=runs)
    return {"mesh": mesh.name, "vertices": mesh.vertices, **figures}


def _race(mesh, cubeness, plan, best):
    peer_runs = plan.runs if mesh.vertices < LARGE else 1
    figures = call(
        "race",
        "race",
        path=str(mesh.path),
        cubeness=cubeness,
        best=best.get(mesh.name, mesh.vertices, cubeness),
        runs=plan.runs,
        plain_runs=peer_runs,
        pymeshlab_runs=peer_runs if (mesh.name, cubeness) in plan.pymeshlab else 0,
    )
    return _head(mesh, cubeness) | figures


def _one_size(mesh, plan, best):
    runs = plan.runs if mesh.vertices < LARGE_SCALING else 1
    figures = call("scaling", "one_size", path=str(mesh.path), runs=runs)
    known = best.get(mesh.name, mesh.vertices, scaling.CUBENESS)
    return _head(mesh, scaling.CUBENESS) | {"best": known} | figures


def _all_defaults(plan, meshes, cache, say):
    """Return the cases of the part "defaults": the largest mesh last, for its memory."""
    known = [meshes[name] for name in plan.defaults if name in meshes]
    cases = []
    for mesh in (*known, *made_meshes(cache, plan.fineness).values()):
        say(f"with the defaults: {mesh.name}")
        cases.append(_defaults(mesh, plan.runs))
    largest = scaled_meshes(meshes.get("bunny"), cache, plan.max_vertices)[-1]
    say(f"with the defaults: {largest.name}, {largest.vertices:,} vertices")
    return [*cases, _defaults_alone(largest)]


def _defaults(mesh, runs):
    arguments = {"path": str(mesh.path), "cubeness": DEFAULTS_CUBENESS}
    figures = call("defaults", "side_by_side", **arguments, runs=runs)
    ticks = call("defaults", "ticks", **arguments) if mesh.vertices <= COARSE else []
    return _head(mesh, DEFAULTS_CUBENESS) | figures | {"ticks": ticks}


def _defaults_alone(mesh):
    """Measure a large mesh once with each, in processes of their own, for the memory."""
    arguments = {"path": str(mesh.path), "cubeness": DEFAULTS_CUBENESS}
    figures = {name: [call("defaults", "alone", **arguments, name=name)] for name in SETTINGS}
    return _head(mesh, DEFAULTS_CUBENESS) | figures | {"ticks": []}

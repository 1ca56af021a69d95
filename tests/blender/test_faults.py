# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever function fails: nothing has changed, one line says why, and Cubify works again.

The functions are those that run (see `faults`), so that none is forgotten. With
``CUBIC_CRAFT_FAULTS=1`` every function fails in every scenario, at its first and at its last call,
with every exception; without it one of `SHARE` of these cases is tried.
"""

import os
import re
from pathlib import Path

import bpy
import pytest
from faults import failing, places
from posing import follow
from rich_mesh import add_rich_monkey
from scene import cubify, select
from snapshot import differences
from world import snapshot_world

IS_THOROUGH = bool(os.environ.get("CUBIC_CRAFT_FAULTS"))
SHARE = 1500
ERRORS = (RuntimeError, MemoryError, KeyboardInterrupt)
WORDS = {RuntimeError: "disk on fire", MemoryError: "memory", KeyboardInterrupt: "interrupted"}
OPTIONS = {"max_iterations": 2, "device": "NUMPY", "refine": "OFF", "keep_apart": False}
FINER = {"refine": "AUTO", "keep_apart": True}
"""in scenarios that are to reach the functions for a finer copy and for further rounds, each of
which takes long"""

# All is done when it is called, and has its undo step; to report that cannot be taken back.
AFTERWARDS = "report_all"

# Texts and times of the last run.
TIMES = ("*/settings/status", "*custom/custom cubic_craft")


def run_cubify(result, **options):
    return lambda: cubify(result=result, **{**OPTIONS, **options})


def run_flatten(**options):
    return lambda: bpy.ops.cubic_craft.flatten(angle=0.7, tolerance=0.1, **options)


def bake_normal_map():
    """Bake to a file of the same name each time."""
    for path in Path(bpy.data.filepath).parent.glob("*.png"):
        path.unlink()
    return bpy.ops.cubic_craft.bake_normal_map(triangles=300, resolution=64)


# What was done before, what fails, and what is there once it does not.
SCENARIOS = {
    "mesh after a key": ("SHAPE_KEY", run_cubify("MESH")),
    "mesh": (None, run_cubify("MESH", **FINER)),
    "mesh with Taichi": (None, run_cubify("MESH", device="CPU", **FINER)),
    "key after what was edited": ("edited", run_cubify("SHAPE_KEY")),
    "new object after a mesh": ("MESH", run_cubify("NEW_OBJECT")),
    "edited since": ("edited", run_cubify("MESH")),
    "from here": ("edited", run_cubify("MESH", start="HERE")),
    "restore a mesh": ("MESH", lambda: bpy.ops.cubic_craft.restore()),
    "restore a key": ("SHAPE_KEY", lambda: bpy.ops.cubic_craft.restore()),
    "restore the first": ("replaced", lambda: bpy.ops.cubic_craft.restore_first()),
    "apply": ("MESH", lambda: bpy.ops.cubic_craft.apply()),
    "flatten a mesh": ("MESH", run_flatten()),
    "flatten a key to n-gons": ("SHAPE_KEY", run_flatten(dissolve=True)),
    "flatten what was edited to n-gons": ("edited", run_flatten(dissolve=True)),
    "bake a normal map": ("MESH", bake_normal_map),
}


def build(before):
    """Make a posed monkey with everything on it, as a file that was worked on."""
    obj = add_rich_monkey(keys=True)
    follow(obj, "Pin").location.z += 0.3
    select(obj)
    bpy.context.view_layer.update()
    if before is not None:
        cubify(result="MESH" if before in ("edited", "replaced") else before, **OPTIONS)
    if before in ("edited", "replaced"):
        # All shape keys, else carrying them would be what takes the edit back.
        for key in obj.data.shape_keys.key_blocks:
            key.points[3].co.x += 0.1
        obj.data.update()
    if before == "replaced":
        cubify(start="HERE", **OPTIONS)


def open_file(path):
    bpy.ops.wm.open_mainfile(filepath=path)
    bpy.context.view_layer.update()


def outcome(run):
    """Return what an operator said: "" when it has finished, or its error."""
    try:
        assert run() == {"FINISHED"}
    except RuntimeError as error:
        return str(error)
    return ""


def problem_of(place, error_class, call, path, folder, run, before, done):
    """Let a place fail; return what is wrong then as a text, empty for nothing."""
    open_file(path)
    error = error_class(WORDS[error_class])
    with failing(place, error, folder, call) as raised:
        try:
            message = outcome(run)
        except BaseException as escaped:
            return f"{escaped!r} has escaped"
    if not raised:
        return "was not called this time"
    after = snapshot_world()
    if message == "":  # tolerated: then the result is that of any other run
        changed = differences(done, after, TIMES)
        if changed:
            return f"finished, but differs in {changed[:5]}"
    else:
        changed = differences(before, after, TIMES)
        if changed:
            return f"has changed {changed[:5]}"
        lines = message.removeprefix("Error: ").strip().splitlines()
        if len(lines) != 1 or re.search("Traceback|Python:", lines[0]):
            return f"is not one clear line: {message!r}"
        if WORDS[error_class] not in lines[0].lower():
            return f"does not say what is wrong: {lines[0]!r}"
        if outcome(run) != "" or (changed := differences(done, snapshot_world(), TIMES)):
            return f"has broken the next run: {changed[:5]}"
    return ""


@pytest.mark.thorough(2)
@pytest.mark.parametrize("name", SCENARIOS)
def test_any_function_may_fail(extension, tmp_path, name, capfd):
    before_it, run = SCENARIOS[name]
    folder = str(Path(extension.__file__).parent)
    build(before_it)
    path = str(tmp_path / "before.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    open_file(path)
    run()  # what is done once only, such as imports and compiling, is over
    open_file(path)
    before = snapshot_world()
    found = places(run, folder)
    done = snapshot_world()
    assert differences(before, done, TIMES), "the scenario does nothing"
    cases = []
    assert AFTERWARDS in {place.name for place in found}
    for place, calls in found.items():
        if place.name != AFTERWARDS:
            cases += [(place, call, error) for call in {1, calls} for error in ERRORS]
    if not IS_THOROUGH:
        cases = cases[list(SCENARIOS).index(name) % SHARE :: SHARE]
    problems = []
    for place, call, error in cases:
        problem = problem_of(place, error, call, path, folder, run, before, done)
        if problem:
            problems.append(f"{place} (call {call}, {error.__name__}) {problem}")
    with capfd.disabled():
        print(f"\n{name}: {len(cases)} faults in {len(found)} functions")
    assert not problems, "\n".join([f"{len(problems)} of {len(cases)}:", *problems])

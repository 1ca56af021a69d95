# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that cross: they are counted beside the last run, and Select Crossing Faces shows them."""

import dataclasses
import importlib
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from scene import add_monkey, cubify, given, select

APART, INTO = 3.0, 1.6  # from the first cube to the second: beside it, and with a corner in it


def add_cubes(*places, name="Cubes"):
    """Add a mesh of cubes of size 2 whose faces are quads, and select it alone."""
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    points = np.concatenate([corners + place for place in places])
    faces = [tuple(8 * k + i for i in side) for k in range(len(places)) for side in sides]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points.tolist(), [], faces)
    mesh.update(calc_edges=True)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    select(obj)
    return obj


def move(obj, first, by):
    """Move the vertices of a mesh from one on, as an artist would in Edit Mode."""
    for vertex in obj.data.vertices[first:]:
        vertex.co += type(vertex.co)(by)
    obj.data.update()


def selected_faces():
    """Leave Edit Mode, and return the numbers of the selected faces by the name of the object."""
    objects = bpy.context.objects_in_mode
    assert bpy.context.mode == "EDIT_MESH"
    assert tuple(bpy.context.tool_settings.mesh_select_mode) == (False, False, True)
    bpy.ops.object.mode_set(mode="OBJECT")
    return {o.name: [face.index for face in o.data.polygons if face.select] for o in objects}


@pytest.fixture
def module(extension):
    """Return a function that imports a module of the add-on."""
    return lambda name: importlib.import_module(f"{extension.__name__}.cubic_craft_addon.{name}")


def test_new_crossings_are_selected_in_edit_mode():
    obj = add_cubes((0, 0, 0), (APART, 0.3, 0.2), (9, 0, 0), (10, 0.4, 0.3))
    cubify(cubeness=0.0)
    move(obj, 8, (INTO - APART, 0, 0))
    for vertex in obj.data.vertices[16:]:
        vertex.co.x += 9 - INTO  # the last two, which crossed before, stay together
    obj.data.update()
    obj.data.polygons[14].select = True
    assert bpy.ops.cubic_craft.select_crossing() == {"FINISHED"}
    # The right side of the first cube with four of the second, and its left side with four.
    found = selected_faces()["Cubes"]
    assert {face // 6 for face in found} == {0, 1}
    assert 1 in found and 6 in found and 0 not in found and 7 not in found


def test_what_crossed_before_is_not_selected():
    obj = add_cubes((0, 0, 0), (INTO, 0.3, 0.2))
    cubify(cubeness=0.0)
    with pytest.raises(RuntimeError, match="No face crosses one that it did not cross"):
        bpy.ops.cubic_craft.select_crossing()
    assert bpy.context.mode == "OBJECT" and obj.select_get()


def test_objects_that_cross_each_other_are_edited_together_and_others_are_not():
    one, other = add_cubes((0, 0, 0), name="One"), add_cubes((9, 0, 0), (0, 0, 0), name="Other")
    far = add_cubes((0, 0, 9), name="Far")
    other.location = (APART, 0.3, 0.2)
    select(far, one, other)
    cubify(cubeness=0.0)
    move(other, 8, (INTO - APART, 0, 0))
    assert bpy.ops.cubic_craft.select_crossing() == {"FINISHED"}
    found = selected_faces()
    assert set(found) == {"One", "Other"} and 1 in found["One"] and 6 in found["Other"]
    assert not far.select_get() and bpy.context.object in (one, other)


def test_of_a_shape_key_the_result_counts():
    obj = add_cubes((0, 0, 0), (APART, 0.3, 0.2))
    obj.vertex_groups.new(name="Second").add(range(8, 16), 1.0, "REPLACE")
    moved = given("Second", Matrix.Translation((INTO - APART, 0, 0)))
    cubify(cubeness=0.0, result="SHAPE_KEY", keep_apart=False, handles=[moved])
    assert bpy.ops.cubic_craft.select_crossing() == {"FINISHED"}
    assert {1, 6} <= set(selected_faces()["Cubes"])


def test_faces_that_are_hidden_stay_so():
    obj = add_cubes((0, 0, 0), (APART, 0.3, 0.2))
    cubify(cubeness=0.0)
    move(obj, 8, (INTO - APART, 0, 0))
    obj.data.polygons.foreach_set("hide", np.ones(12, dtype=bool))
    with pytest.raises(RuntimeError, match="are hidden; reveal them in Edit Mode"):
        bpy.ops.cubic_craft.select_crossing()
    assert bpy.context.mode == "OBJECT"


def test_it_needs_a_result():
    add_cubes((0, 0, 0))
    assert not bpy.ops.cubic_craft.select_crossing.poll()
    cubify(cubeness=0.0)
    assert bpy.ops.cubic_craft.select_crossing.poll()
    bpy.ops.cubic_craft.restore()
    assert not bpy.ops.cubic_craft.select_crossing.poll()


@pytest.mark.parametrize("count", [None, 0, 12])
def test_the_count_of_the_solver_is_kept_on_the_mesh(module, monkeypatch, reopen, count):
    tasks, last_run = module("run.tasks"), module("mesh_bridge").last_run
    run_of = tasks.run_of

    def with_count(solution, settings):
        found = solution.result
        result = SimpleNamespace(
            iterations=found.iterations,
            energy=found.energy,
            converged=found.converged,
            device=found.device,
            solve_seconds=found.solve_seconds,
            compile_seconds=found.compile_seconds,
            crossings=count,
            pressed=count and 0,
        )
        return run_of(dataclasses.replace(solution, result=result), settings)

    monkeypatch.setattr(tasks, "run_of", with_count)
    obj = add_monkey()
    assert cubify() == {"FINISHED"}
    assert last_run(obj).crossings == count
    assert ("12 faces still cross" in obj.cubic_craft.status) == (count == 12)
    assert last_run(reopen("Suzanne")).crossings == count


def test_the_button_stands_beside_the_count(module, monkeypatch):
    panel, shown = module("ui.status_panel"), []

    class Layout:
        alert = active = False

        def label(self, **_):
            pass

        def operator(self, name, **_):
            shown.append(name)

    obj = add_monkey()
    cubify()
    run = module("mesh_bridge").last_run(obj)
    monkeypatch.setattr(panel, "room_for_text", lambda *_: 1000.0)
    for count in (None, 0, 12):
        panel._draw_line(bpy.context, Layout(), obj, dataclasses.replace(run, crossings=count), [])
    assert shown == ["cubic_craft.select_crossing"]

# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of a result comes from its mesh, and tells whether the settings have changed."""

import importlib
from dataclasses import replace

import bpy
import pytest
from live_steps import add_monkey
from posing import LEFT, add_posable, follow, pin
from scene import add_empty, add_triangles, cubify, select
from worth_trying import values

from solver.method import SETTINGS


@pytest.fixture
def changes(extension):
    """Return a function that lists what has changed since the run of an object's mesh."""
    addon = f"{extension.__name__}.cubic_craft_addon"
    last_run = importlib.import_module(f"{addon}.mesh_bridge").last_run
    changes_since = importlib.import_module(f"{addon}.run.up_to_date").changes_since

    def list_changes(obj):
        bpy.context.view_layer.update()
        return changes_since(obj, last_run(obj))

    return list_changes


@pytest.fixture
def last_run(part):
    return part("mesh_bridge").last_run


def copy_of(obj, *, linked):
    select(obj)
    bpy.ops.object.duplicate(linked=linked)
    return bpy.context.object


OTHER = {
    name: (values(each), each.label)
    for name, each in SETTINGS.items()
    if not each.of_forms and not each.is_of_mesh
} | {"map_group": ([LEFT], "Cubeness Map"), "result": (["SHAPE_KEY"], "Write To")}
for each in ("device", "form"):
    del OTHER[each]  # which changes nothing, or more


@pytest.mark.thorough(5)
@pytest.mark.parametrize("name", OTHER)
def test_each_setting_that_matters_is_named_until_it_is_as_it_was(changes, name):
    obj, *_ = add_posable()
    cubify(cubeness=0.4)
    assert changes(obj) == []
    before, (others, label) = getattr(obj.cubic_craft, name), OTHER[name]
    before = tuple(before) if isinstance(others[0], tuple) else before
    setattr(obj.cubic_craft, name, next(x for x in others if x != pytest.approx(before)))
    assert changes(obj) == [label]
    setattr(obj.cubic_craft, name, before)
    assert changes(obj) == []


def test_several_are_listed_once_each_and_an_update_clears_them(changes):
    obj, *_ = add_posable()
    cubify()
    obj.cubic_craft.cubeness = 0.123
    obj.cubic_craft.map_group = LEFT
    obj.cubic_craft.map_invert = True
    assert changes(obj) == ["Cubeness", "Cubeness Map"]
    assert bpy.ops.cubic_craft.cubify() == {"FINISHED"}
    assert changes(obj) == []


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *(("device", "NUMPY"), ("map_invert", True), ("use_handles", False)),
        ("result", "NEW_OBJECT"),
    ],
)
def test_what_would_not_change_the_shape_does_not_count(changes, name, value):
    obj = add_monkey()
    cubify()
    setattr(obj.cubic_craft, name, value)
    assert changes(obj) == []


def test_how_a_handle_holds_its_vertices_counts(changes):
    obj, *_ = add_posable()
    pin(obj, LEFT)
    cubify()
    obj.cubic_craft.handles[0].is_cubic = True
    assert changes(obj) == ["Handles"]
    cubify()
    assert changes(obj) == []
    obj.cubic_craft.handles[0].is_cubic = False
    assert changes(obj) == ["Handles"]


def test_how_the_object_stands_does_not_count(changes):
    obj = add_monkey()
    cubify(space="WORLD")
    obj.rotation_euler = (0.3, 0.2, 0.1)
    assert changes(obj) == []


def test_a_frame_that_turns_counts_while_it_is_used(changes):
    obj = add_monkey()
    frame = add_empty("Frame")
    obj.cubic_craft.frame = frame
    cubify(space="FRAME")
    assert changes(obj) == []
    frame.location.x = 3.0
    assert changes(obj) == []
    frame.rotation_euler.z = 0.5
    assert changes(obj) == ["Frame"]
    cubify(space="OBJECT")
    assert changes(obj) == []
    frame.rotation_euler.z = 1.0
    assert changes(obj) == []


def test_a_form_counts_with_what_it_is_made_of(changes):
    obj, form = add_monkey(), add_triangles()
    select(obj)
    cubify(form="OBJECT", form_object=form.name)
    assert changes(obj) == []
    form.location.x = 4.0
    bpy.context.view_layer.update()
    assert changes(obj) == []  # about its own origin
    form.scale.z = 2.0
    bpy.context.view_layer.update()
    assert changes(obj) == ["Form Object"]
    obj.cubic_craft.form = "PRISM"
    assert set(changes(obj)) == {"Form", "Sides", "Form Object"}
    cubify()
    assert changes(obj) == []
    obj.cubic_craft.form_weights = (1, 2, 3)
    assert changes(obj) == []
    obj.cubic_craft.form_sides = 5
    assert changes(obj) == ["Sides"]


def test_handles_count_as_they_are_posed_now(changes):
    obj, *_ = add_posable()
    target = follow(obj, LEFT)
    select(obj)
    cubify()
    assert changes(obj) == []
    target.location.z += 0.1
    assert changes(obj) == ["Handles"]
    target.location.z -= 0.1
    assert changes(obj) == []
    obj.cubic_craft.use_handles = False
    assert changes(obj) == ["Handles"]


def test_settings_that_cannot_be_used_are_no_change_but_a_problem(changes):
    obj = add_monkey()
    cubify()
    obj.cubic_craft.handles.add().group = "No such group"
    assert changes(obj) == []


def test_a_linked_copy_shows_the_status_of_the_mesh_and_has_settings_of_its_own(changes, last_run):
    obj = add_monkey()
    twin = copy_of(obj, linked=True)
    select(obj)
    assert bpy.ops.cubic_craft.cubify(cubeness=0.8) == {"FINISHED"}
    assert obj.cubic_craft.status == twin.cubic_craft.status != ""
    assert last_run(twin).settings["cubeness"] == pytest.approx(0.8)
    assert (changes(obj), changes(twin)) == ([], ["Cubeness"])
    select(twin)
    assert bpy.ops.cubic_craft.cubify() == {"FINISHED"}
    assert (changes(obj), changes(twin)) == (["Cubeness"], [])
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert obj.cubic_craft.status == twin.cubic_craft.status == ""


def test_a_full_copy_takes_its_run_along_and_goes_its_own_way(changes):
    obj = add_monkey()
    cubify(cubeness=0.8)
    status = obj.cubic_craft.status
    other = copy_of(obj, linked=False)
    assert other.cubic_craft.status == status and changes(other) == []
    other.cubic_craft.cubeness = 0.1
    assert (changes(obj), changes(other)) == ([], ["Cubeness"])
    select(other)
    bpy.ops.cubic_craft.apply()
    assert (obj.cubic_craft.status, other.cubic_craft.status) == (status, "")


def test_a_shape_key_is_a_result_until_it_is_restored(changes, last_run):
    obj = add_monkey()
    cubify(result="SHAPE_KEY", cubeness=0.6)
    assert changes(obj) == []
    obj.cubic_craft.result = "MESH"
    assert changes(obj) == ["Write To"]
    cubify(result="MESH")
    assert changes(obj) == []
    bpy.ops.cubic_craft.restore()
    assert last_run(obj) is None


def test_a_new_object_is_up_to_date_and_its_source_has_no_run(changes, last_run):
    source = add_monkey()
    cubify(result="NEW_OBJECT", cubeness=0.7)
    made = bpy.context.object
    assert made != source and last_run(source) is None
    assert changes(made) == [] and last_run(made).settings["cubeness"] == pytest.approx(0.7)
    made.cubic_craft.cubeness = 0.3
    assert changes(made) == ["Cubeness"]


def test_it_is_saved_with_the_file(changes, last_run, reopen):
    obj = add_monkey()
    cubify(cubeness=0.35, orientation=(0.1, 0.2, 0.3))
    before = last_run(obj)
    obj = reopen("Suzanne")
    assert last_run(obj) == before and changes(obj) == []


def test_live_leaves_a_result_that_is_up_to_date(live, begin, changes):
    obj = add_monkey()
    session = begin(obj, cubeness=0.3)
    live.live_properties().cubeness = 0.55
    session.on(live.Event.CONFIRM)
    for _ in range(4000):
        session.tick(bpy.context)
        if session.is_ended:
            break
    assert session.written.summary and changes(obj) == []
    assert obj.cubic_craft.cubeness == pytest.approx(0.55)


def test_the_tooltip_of_cubify_names_what_has_changed(extension):
    module = importlib.import_module(f"{extension.__name__}.operators.cubify")
    operator = module.CUBIC_CRAFT_OT_cubify
    obj = add_monkey()
    plain = operator.description(bpy.context, None)
    cubify()
    assert operator.description(bpy.context, None) == plain
    obj.cubic_craft.solidity = 0.5
    assert operator.description(bpy.context, None).endswith("Changed since the last run: Solidity")


def test_a_run_that_is_not_as_we_write_it_is_not_ours(last_run):
    obj = add_monkey()
    cubify()
    note = obj.data["cubic_craft_note"]
    obj.data["cubic_craft_note"] = note.replace('"converged"', '"convergence"')
    assert last_run(obj) is None
    settings = '"orientation": "upright", "cubeness": {}, "handles": [[1]], "frame": [], "x": '
    obj.data["cubic_craft_note"] = note.replace('"orientation": ', settings)
    assert last_run(obj) is not None


@pytest.mark.parametrize("count", [None, 0, 12])
def test_the_count_of_crossing_faces_is_kept_on_the_mesh(
    part, last_run, monkeypatch, reopen, count
):
    tasks = part("run.tasks")
    run_of = tasks.run_of

    def with_count(solution, settings):
        result = replace(solution.result, crossings=count, pressed=count and 0)
        return run_of(replace(solution, result=result), settings)

    monkeypatch.setattr(tasks, "run_of", with_count)
    obj = add_monkey()
    assert cubify() == {"FINISHED"}
    assert last_run(obj).crossings == count
    assert ("12 faces still cross" in obj.cubic_craft.status) == (count == 12)
    assert last_run(reopen("Suzanne")).crossings == count

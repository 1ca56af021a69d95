# SPDX-License-Identifier: GPL-3.0-or-later
"""Live and Ctrl-Z: undo steps of Blender before and during it, and its own taking back."""

import bpy
import pytest
from live_steps import add_monkey, bits, check_gone, confirm, tick_to_rest, tick_to_sight
from mathutils import Matrix
from scene import add_triangles, select


def add_monkey_and_step():
    """Return a monkey that an undo leads back to, and its bits."""
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="Monkey")
    return obj, bits(obj)


def test_undo_goes_on_with_what_blender_has_brought_back(live, begin):
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="Monkey")
    obj.location.x = 1.0
    bpy.ops.ed.undo_push(message="Moved")
    original = bits(obj)
    session = tick_to_sight(begin(obj))
    assert bits(obj) != original
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Suzanne"]
    assert obj.location.x == 0.0
    tick_to_rest(session)
    assert not session.is_ended and not session.error
    assert bits(obj) != original
    session.on(live.Event.CANCEL)
    assert bits(obj) == original
    check_gone(live)


def test_an_undo_step_from_the_middle_comes_back_sound(live, begin):
    obj, original = add_monkey_and_step()
    session = tick_to_sight(begin(obj))
    bpy.data.objects["Suzanne"].location.x = 1.0
    bpy.ops.ed.undo_push(message="Moved in the middle of Live")
    session.tick(bpy.context)
    session.on(live.Event.CANCEL)
    bpy.ops.ed.undo_push(message="After")
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Suzanne"]
    assert obj.location.x == 1.0
    assert bits(obj) == original
    check_gone(live)


def leave_object_mode(live, session, mode):
    """Change the mode as an artist does, with an undo step, which ends Live; return the shape."""
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.ed.undo_push(message="Toggle Mode")
    tick_to_rest(session)
    assert session.is_ended and session.written.summary and session.written.has_pushed_undo
    check_gone(live)
    return shape_and_mode()[0]


def shape_and_mode():
    """Return the bits of the monkey outside Edit Mode, and the mode that it is in."""
    obj = bpy.data.objects["Suzanne"]
    mode = obj.mode
    obj.update_from_editmode()
    return bits(obj), mode


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT"])
def test_leaving_for_another_mode_is_one_step_and_a_mode(live, begin, mode):
    """Undone one by one, each step is what it was; Restore and redo know each of them."""
    obj, original = add_monkey_and_step()
    session = tick_to_rest(begin(obj))
    bpy.ops.ed.undo_push(message="Select")  # with the preview on the mesh
    cubic = leave_object_mode(live, session, mode)
    assert shape_and_mode() == (cubic, mode) and cubic != original
    bpy.ops.ed.undo()
    assert shape_and_mode() == (cubic, "OBJECT")
    select(bpy.data.objects["Suzanne"])
    assert bpy.ops.cubic_craft.restore.poll()
    bpy.ops.ed.undo()
    assert shape_and_mode() == (original, mode)
    bpy.ops.ed.undo()
    assert shape_and_mode() == (original, "OBJECT")
    assert not bpy.ops.cubic_craft.restore.poll(), "nothing is left of the preview"
    for _ in range(2):
        bpy.ops.ed.redo()
    assert shape_and_mode() == (cubic, "OBJECT")
    select(bpy.data.objects["Suzanne"])
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert shape_and_mode() == (original, "OBJECT")


def test_undo_of_the_object_ends_it(live, begin):
    bpy.ops.ed.undo_push(message="Empty")
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="Monkey")
    session = tick_to_sight(begin(obj))
    bpy.ops.ed.undo()
    assert "Suzanne" not in bpy.data.objects
    session.tick(bpy.context)
    assert session.is_ended and not session.error
    check_gone(live)


def test_undo_to_another_shape_starts_from_that(live, begin):
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="Monkey")
    obj.data.transform(Matrix.Scale(2.0, 4, (1, 0, 0)))
    bpy.ops.ed.undo_push(message="Stretched")
    session = tick_to_rest(begin(obj))
    bpy.ops.ed.undo()
    confirm(live, session)
    obj = bpy.data.objects["Suzanne"]
    shape = bits(obj)
    select(obj)
    bpy.ops.cubic_craft.restore()
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == shape


def test_taking_back_ends_live_where_blender_has_undone_all_of_it(live, begin):
    obj = add_triangles()
    frame = bpy.data.objects.new("Frame", None)
    frame.rotation_euler.x = 0.5
    bpy.context.collection.objects.link(frame)
    obj.cubic_craft.space, obj.cubic_craft.frame = "FRAME", frame
    bpy.ops.ed.undo_push(message="Before Live")
    name, original = obj.name, bits(obj)
    session = tick_to_rest(begin(obj))
    bpy.data.objects["Frame"].location.x = 1.0
    bpy.ops.ed.undo_push(message="Moved")
    bpy.ops.ed.undo()
    tick_to_rest(session)
    bpy.ops.ed.redo()
    tick_to_rest(session)
    assert not session.take_back(), "the move is Blender's to undo"
    bpy.ops.ed.undo()
    tick_to_rest(session)
    assert not session.is_ended
    assert session.take_back() and session.is_ended
    assert bits(bpy.data.objects[name]) == original
    check_gone(live)

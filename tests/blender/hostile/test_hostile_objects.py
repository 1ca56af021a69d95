# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever the object and the settings: only positions change and come back, or nothing at all."""

import bpy
import numpy as np
from budget import examples
from hostile_objects import POSES, add_object, asked, frame_object
from hypothesis import event, given
from rich_mesh import points_of, position_of
from scene import given as given_handle
from snapshot import POSITIONS, STORED, differences, snapshot_object

SETTINGS = ("rna/cubic_craft*", "*custom/custom cubic_craft*")
KEY_ADDED = ("mesh/shape_keys/*Cubic*", "mesh/shape_keys/order", "rna/active_shape_key*")
FIRST_KEY_ADDED = ("mesh/shape_keys/*", "mesh/rna/shape_keys")


@examples(10)
@given(case=asked())
def test_only_positions_change_and_come_back(case):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    obj, frame = add_object(case), frame_object()
    options = dict(case.options)
    if options["space"] == "FRAME":
        options["frame"] = frame.name
    if case.pose != "none":
        options["handles"] = [given_handle("Pin", POSES[case.pose], 0.01)]
    before, rest = everything(obj), position_of(obj.data)
    objects = len(bpy.data.objects)
    meshes = len(bpy.data.meshes)
    try:
        bpy.ops.cubic_craft.cubify(**options)
    except RuntimeError as error:
        check_refusal(str(error))
        assert differences(before, everything(obj), SETTINGS) == []
        assert (len(bpy.data.objects), len(bpy.data.meshes)) == (objects, meshes)
        event(f"refused: {str(error)[:60]}")
        return
    event("done")
    if options["result"] == "NEW_OBJECT":
        made = bpy.context.object
        assert made != obj
        if obj.hide_get():
            bpy.ops.cubic_craft.show_source()
        select_only(obj)
        assert differences(before, everything(obj), SETTINGS) == []
        check_positions(position_of(made.data), rest, case)
        return
    is_key = options["result"] == "SHAPE_KEY"
    ignored = [*POSITIONS, *STORED, *SETTINGS]
    ignored += KEY_ADDED if is_key else ["mesh/shape_keys/blocks/*/points"]
    ignored += FIRST_KEY_ADDED if is_key and not case.keys else ()
    assert differences(before, everything(obj), ignored) == []
    positions = points_of(obj.data, "Cubic") if is_key else position_of(obj.data)
    check_positions(positions, rest, case)
    assert bpy.ops.cubic_craft.cubify(**options) == {"FINISHED"}
    again = points_of(obj.data, "Cubic") if is_key else position_of(obj.data)
    assert again.tobytes() == positions.tobytes()
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert differences(before, everything(obj), SETTINGS) == []


def everything(obj):
    """Take everything of an object as texts: a NaN would not be equal to itself."""
    return {path: repr(value) for path, value in snapshot_object(obj).items()}


def check_positions(positions, rest, case):
    """Check what holds for every result."""
    assert np.isfinite(positions).all()
    loose = case.mesh.loose
    if case.pose == "none":
        assert positions[loose].tobytes() == rest[loose].tobytes()


def check_refusal(message):
    """Check that an operator's error is our sentence and no exception that went through."""
    assert "Traceback" not in message, message
    assert "Hostile" in message, message


def select_only(obj):
    """Select an object, and no other."""
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj

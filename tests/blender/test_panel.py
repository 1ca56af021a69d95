# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel says before the click; the drawing itself is tested in a window."""

import importlib
import re
from pathlib import Path

import bpy
import pytest
from scene import add_monkey


@pytest.fixture
def problem(extension):
    panel = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.panel")
    return panel._problem


def test_a_good_mesh_has_no_problem(problem):
    assert problem(add_monkey()) == ""


def test_a_missing_group_is_named(problem):
    obj = add_monkey()
    obj.cubic_craft.map_group = "Ears"
    assert problem(obj) == '"Suzanne" has no vertex group "Ears"; pick another one'
    obj.vertex_groups.new(name="Ears")
    assert problem(obj) == ""


def test_a_missing_frame_is_named(problem):
    obj = add_monkey()
    obj.cubic_craft.space = "FRAME"
    assert "No frame object is set" in problem(obj)
    obj.cubic_craft.frame = obj
    assert problem(obj) == ""


def test_a_mesh_without_faces_is_named(problem):
    obj = add_monkey()
    obj.data.clear_geometry()
    assert "Suzanne" in problem(obj)


def test_edit_mode_is_named(problem):
    obj = add_monkey()
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        assert "Edit Mode" in problem(obj)
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")


@pytest.mark.parametrize(("module", "count"), [("panel", 4), ("handles.panel", 6)])
def test_every_button_of_the_panel_is_an_operator_that_exists(extension, module, count):
    panel = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.{module}")
    text = Path(panel.__file__).read_text(encoding="utf-8")
    names = set(re.findall(r'\.operator\(\s*"([^"]+)"', text))
    assert len(names) >= count
    for name in names:
        room, verb = name.split(".")
        assert getattr(getattr(bpy.ops, room), verb).get_rna_type().name


def test_what_is_wrong_with_a_handle_is_named(problem):
    obj = add_monkey()
    handle = obj.cubic_craft.handles.add()
    assert problem(obj).startswith('handle 1 of "Suzanne" has no vertex group')
    handle.group = "Ears"
    assert problem(obj) == '"Suzanne" has no vertex group "Ears"; pick another one'
    obj.cubic_craft.use_handles = False
    assert problem(obj) == ""

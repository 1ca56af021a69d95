# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel says before the click; the drawing itself is tested in a window."""

import dataclasses
import importlib
import re
from pathlib import Path

import bpy
import pytest
from scene import add_monkey


@pytest.fixture
def problem(part):
    panel = part("ui.panel")
    return lambda obj: panel._problem(bpy.context, obj)


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
    assert "from a frame object, but none is set" in problem(obj)
    obj.cubic_craft.frame = obj
    assert problem(obj) == ""


def test_a_mesh_without_faces_is_named(problem):
    obj = add_monkey()
    obj.data.clear_geometry()
    assert "Suzanne" in problem(obj)


@pytest.mark.parametrize(
    ("mode", "is_usable"),
    [
        ("EDIT", False),
        ("SCULPT", False),
        ("VERTEX_PAINT", False),
        ("TEXTURE_PAINT", False),
        ("WEIGHT_PAINT", True),
    ],
)
def test_in_other_modes_the_way_out_takes_the_place_of_a_message(part, problem, mode, is_usable):
    modes = part("environment.modes")
    obj = add_monkey()
    bpy.ops.object.mode_set(mode=mode)
    try:
        assert problem(obj) == ""
        assert modes.is_mode_usable(bpy.context) is is_usable
        assert bpy.ops.cubic_craft.cubify.poll() is is_usable
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")


@pytest.mark.parametrize(
    ("module", "count"),
    [("ui.panel", 4), ("ui.buttons", 3), ("ui.status_panel", 1), ("handles.panel", 3)],
)
def test_every_button_of_the_panel_is_an_operator_that_exists(extension, module, count):
    panel = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.{module}")
    text = Path(panel.__file__).read_text(encoding="utf-8")
    names = set(re.findall(r'\boperator\(\s*(?:(?:row|layout),\s*)?"([^"]+)"', text))
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


def test_texts_fit_the_room_that_there_is(part):
    text_fit = part("screen.text_fit")
    text = '"Suzanne" has no vertex group "Ears"; pick another one'
    wide = text_fit.width_of(text)
    assert text_fit.wrapped(text, wide) == [text]
    for room in (0.6 * wide, 0.3 * wide):
        lines = text_fit.wrapped(text, room)
        assert " ".join(lines) == text and len(lines) >= wide / room
        assert max(map(text_fit.width_of, lines)) <= room
    assert text_fit.wrapped(text, 1.0) == text.split()
    assert text_fit.wrapped("", wide) == []
    for room, fits in ((2 * wide, text), (0.9 * wide, text[:20]), (1.0, "Ears")):
        assert text_fit.longest_that_fits((text, text[:20], "Ears"), room) == fits


def test_the_line_below_the_buttons_says_what_matters_most(part):
    panel = part("ui.status_panel")
    bridge = part("mesh_bridge")
    run = bridge.LastRun(
        settings={"cubeness": 0.4},
        vertices=12345,
        objects=3,
        iterations=40,
        energy=0.1,
        converged=True,
        seconds=1.234,
        device="numpy",
    )

    def line(run, changes=(), *, is_edited=False):
        texts, icon = panel._words(run, list(changes), is_edited=is_edited)
        assert list(texts) == sorted(texts, key=len, reverse=True)
        return texts[0], icon

    assert line(None) == ("Not cubified yet", "BLANK1")
    assert line(run) == ("Converged in 1.23 s, 12,345 vertices of 3 objects", "CHECKMARK")
    unfinished = dataclasses.replace(run, converged=False)
    assert line(unfinished) == ("Not converged after 40 iterations", "ERROR")
    assert line(unfinished, is_edited=True) == ("Edited since the last run", "INFO")
    crossing = dataclasses.replace(run, crossings=1234)
    assert line(crossing) == ("1,234 faces still cross, leave more room", "ERROR")
    assert crossing.status.endswith("converged, 1,234 faces still cross, 1.23 s on numpy")
    pressing = dataclasses.replace(crossing, pressed=1234)
    words = "1,234 faces cross: parts press into each other"
    assert line(pressing) == (f"{words}, leave more room", "INFO")
    assert pressing.status.endswith(f"converged, {words}, 1.23 s on numpy")
    failed = dataclasses.replace(pressing, pressed=1224)
    assert line(failed) == ("10 faces still cross, leave more room", "ERROR")
    assert line(dataclasses.replace(run, crossings=0)) == line(run)
    changed = line(run, ["Cubeness", "Handles"], is_edited=True)
    assert changed == ("Changed: Cubeness, Handles", "INFO")
    assert [value(run) for _, value in panel._NUMBERS] == [
        "0.4",
        "12,345 of 3 objects",
        "40",
        "-",
        "-",
        "0.10000",
        "1.23 s",
        "numpy",
    ]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Clothes that lie on a mesh without being selected are named, and nothing else is."""

import contextlib
import io
from types import SimpleNamespace

import bpy
import pytest
from recorder import Recorder
from scene import add_copy, add_monkey, cubify, select

HINT = "Shirt lies on it and is not selected"


@pytest.fixture
def worn(part):
    """Return `worn_by`, which gives the names of what lies on an object."""
    return lambda obj: [other.name for other in part("worn.found").worn_by(obj)]


def add_body():
    """Add a long body, and return it and a tube around its middle."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=16)
    body = bpy.context.object
    body.name, body.scale = "Body", (0.4, 0.3, 1.0)
    bpy.ops.mesh.primitive_cylinder_add(
        vertices=20, radius=0.42, depth=0.6, end_fill_type="NOTHING"
    )
    shirt = bpy.context.object
    shirt.name, shirt.scale.y = "Shirt", 0.75
    bpy.context.view_layer.update()
    return body, shirt


def add_cube(name, size, location, scale=(1, 1, 1)):
    bpy.ops.mesh.primitive_cube_add(size=size, location=location, scale=scale)
    bpy.context.object.name = name


def test_only_what_lies_on_it_counts(worn):
    body, _ = add_body()
    bpy.ops.mesh.primitive_plane_add(size=20, location=(0, 0, -0.98))
    add_cube("Room", 6, (0, 0, 2))
    add_cube("Sword", 1, (0.36, 0, 0.7), (0.05, 0.05, 0.6))
    add_cube("Stool", 0.6, (0, 0, -1.3))
    add_cube("Pillar", 1, (0.45, 0, 0))
    add_cube("Buckle", 0.05, (0.38, 0, 0))
    bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8, radius=0.5, location=(9, 0, 0))
    assert worn(body) == ["Shirt", "Buckle"]


def test_what_is_not_to_be_cubified_does_not_count(worn):
    body, shirt = add_body()
    assert worn(body) == ["Shirt"]
    for attribute, value in (
        ("hide_render", True),
        ("hide_select", True),
        ("display_type", "WIRE"),
    ):
        before = getattr(shirt, attribute)
        setattr(shirt, attribute, value)
        assert worn(body) == [], attribute
        setattr(shirt, attribute, before)
    shirt.hide_set(True)
    assert worn(body) == []
    shirt.hide_set(False)
    assert worn(body) == ["Shirt"]
    add_copy(body)
    bpy.context.view_layer.update()
    assert worn(body) == ["Shirt"], "a copy of the body is no clothing"


def test_it_counts_where_it_is_seen(worn):
    body, shirt = add_body()
    bpy.ops.object.empty_add()
    away = bpy.context.object
    constraint = shirt.constraints.new("COPY_LOCATION")
    constraint.target = away
    assert worn(body) == ["Shirt"]
    away.location.x = 3.0
    assert worn(body) == []


def test_no_shape_is_too_strange(worn):
    body, shirt = add_body()
    for change in (
        lambda: setattr(shirt, "scale", (0, 0, 0)),
        lambda: setattr(shirt, "scale", (float("nan"), 1, 1)),
        lambda: setattr(body, "scale", (0, 1, 1)),
        shirt.data.clear_geometry,
        body.data.clear_geometry,
    ):
        change()
        bpy.context.view_layer.update()
        assert worn(body) in ([], ["Shirt"])


def drawn(module, obj):
    context = SimpleNamespace(
        region=SimpleNamespace(
            width=400, view2d=SimpleNamespace(region_to_view=lambda x, y: (x, y))
        ),
        preferences=bpy.context.preferences,
    )
    layout = Recorder()
    module.draw(context, layout, obj)
    return " ".join(layout.labels), layout.operators


def test_the_panel_says_so_and_one_click_selects_it(part):
    module = part("worn.panel")
    body, _ = add_body()
    select(body)
    assert drawn(module, body) == ("", {}) and module._worn.is_waiting
    module._worn.find(body.session_uid)
    text, operators = drawn(module, body)
    assert text == HINT and list(operators) == ["cubic_craft.select_worn"]
    assert bpy.ops.cubic_craft.select_worn() == {"FINISHED"}
    assert {obj.name for obj in bpy.context.selected_objects} == {"Body", "Shirt"}
    assert bpy.context.view_layer.objects.active == body
    assert drawn(module, body) == ("", {})


def test_the_hint_goes_where_it_does_not_help(part, begin, live):
    module = part("worn.panel")
    body, _ = add_body()
    select(body)

    def hint():
        module._worn.find(body.session_uid)
        return drawn(module, body)[0]

    assert hint() == HINT
    body.cubic_craft.together = "PARTS"
    assert hint() == ""
    body.cubic_craft.together = "SELECTION"
    session = begin(body)
    assert hint() == ""
    session.on(live.Event.CANCEL)
    assert hint() == HINT
    cubify(max_iterations=2)
    assert hint() == HINT


def test_it_is_found_again_when_something_has_moved_and_shown_meanwhile(part):
    module = part("worn.panel")
    body, shirt = add_body()
    select(body)
    module._worn.find(body.session_uid)
    assert drawn(module, body)[0] == HINT and not module._worn.is_waiting
    shirt.location.x = 5.0
    bpy.context.view_layer.update()
    assert drawn(module, body)[0] == HINT and module._worn.is_waiting
    module._worn.find(body.session_uid)
    assert drawn(module, body)[0] == ""
    shirt.location.x = 0.0
    bpy.context.view_layer.update()
    module._worn.find(body.session_uid)
    bpy.data.objects.remove(shirt)
    assert drawn(module, body)[0] == ""


def test_nothing_to_select_is_said():
    add_monkey()
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        assert bpy.ops.cubic_craft.select_worn() == {"CANCELLED"}
    assert 'Nothing lies on "Suzanne"' in printed.getvalue()


def test_sentences(part):
    say = part("worn.panel").sentence
    assert say(["Shirt"]) == HINT
    assert say(["Shirt", "Hat"]) == "Shirt and Hat lie on it and are not selected"
    assert say(["A", "B", "C"]) == "A and 2 more meshes lie on it and are not selected"

# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's search and Quick Favorites find what is in menus; all is in Object > Cubic Craft."""

import bpy
import pytest
from recorder import Recorder
from scene import add_monkey, cubify

NAME = "VIEW3D_MT_object_cubic_craft"


@pytest.fixture
def menus(part):
    return part("ui.menus")


def _drawn(draw, owner):
    owner.layout = Recorder()
    draw(owner, bpy.context)
    return owner.layout.drawn


class Owner:
    """Stands for the menu that is drawn."""


@pytest.mark.parametrize("parent", ["VIEW3D_MT_object", "VIEW3D_MT_object_context_menu"])
def test_both_menus_of_objects_lead_to_it(menus, parent):
    draws = getattr(bpy.types, parent).draw._draw_funcs
    assert _drawn(draws[-1], Owner()) == [NAME] and draws[-1] is menus._draw_entry
    menus.unregister()
    assert menus._draw_entry not in draws and not hasattr(bpy.types, NAME)
    menus.register()
    assert menus._draw_entry in draws


@pytest.mark.parametrize("has_mesh", [False, True])
def test_each_entry_is_an_operator(menus, has_mesh):
    if has_mesh:
        add_monkey()
    drawn = _drawn(getattr(bpy.types, NAME).draw, Owner())
    operators = [name.split(".") for name in drawn if "." in name]
    assert all(hasattr(getattr(bpy.ops, module), name) for module, name in operators)
    assert ["cubic_craft", "cubify"] in operators and ["cubic_craft", "live"] in operators
    assert ("keep_pose" in drawn) == has_mesh


def test_the_first_original_has_an_entry_where_there_is_one(menus):
    obj = add_monkey()
    for start in (None, "HERE"):
        drawn = _drawn(getattr(bpy.types, NAME).draw, Owner())
        assert "cubic_craft.restore" in drawn and "cubic_craft.restore_first" not in drawn
        cubify(max_iterations=2, **({"start": start} if start else {}))
        obj.data.vertices[3].co.x += 0.5
        obj.data.update()
    assert "cubic_craft.restore_first" in _drawn(getattr(bpy.types, NAME).draw, Owner())

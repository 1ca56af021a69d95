# SPDX-License-Identifier: GPL-3.0-or-later
import importlib
from pathlib import Path

import bpy
import pytest
from scene import add_monkey


@pytest.fixture
def preset():
    assert bpy.ops.cubic_craft.preset_add(name="Tilted Block") == {"FINISHED"}
    path = bpy.utils.preset_find("Tilted_Block", "cubic_craft")
    assert path
    yield path
    if Path(path).exists():
        bpy.ops.cubic_craft.preset_add(name="Tilted_Block", remove_name=True)
        assert not Path(path).exists()


@pytest.fixture
def monkey():
    obj = add_monkey()
    obj.cubic_craft.cubeness = 0.9
    obj.cubic_craft.orientation = (0.1, 0.2, 0.3)
    obj.cubic_craft.result = "SHAPE_KEY"
    obj.cubic_craft.map_group = "Of this object"
    return obj


def test_a_preset_brings_the_settings_to_another_object(monkey, preset):
    other = add_monkey("Other")
    other.cubic_craft.map_group = "Own"
    bpy.ops.script.execute_preset(filepath=preset, menu_idname="CUBIC_PT_presets")
    assert other.cubic_craft.cubeness == pytest.approx(0.9)
    assert tuple(other.cubic_craft.orientation) == pytest.approx((0.1, 0.2, 0.3))
    assert other.cubic_craft.result == "SHAPE_KEY"
    assert other.cubic_craft.map_group == "Own"


def test_a_preset_is_plain_assignments(monkey, preset):
    lines = Path(preset).read_text().splitlines()
    assert lines[0] == "import bpy"
    assert len(lines) > 5
    assert all(line.startswith("bpy.context.object.cubic_craft.") for line in lines[1:] if line)


def test_as_in_the_paper(monkey, extension):
    monkey.cubic_craft.solidity = 0.7
    path = bpy.utils.preset_find("As in the Paper", "cubic_craft", display_name=True)
    bpy.ops.script.execute_preset(filepath=path, menu_idname="CUBIC_PT_presets")
    properties = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.properties")
    solver = importlib.import_module(f"{extension.__name__}.solver")
    settings = properties.settings_of(monkey)
    assert settings.proxy == solver.PAPER
    assert settings.rotation == "FREE"
    assert settings.cubeness == pytest.approx(0.9), "how cubic is the artist's choice"


def test_a_preset_of_ours_cannot_be_removed_and_goes_with_the_extension(extension):
    path = Path(bpy.utils.preset_find("As_in_the_Paper", "cubic_craft"))
    add_monkey()
    bpy.ops.cubic_craft.preset_add(name="As_in_the_Paper", remove_name=True)
    assert path.exists()
    bpy.ops.preferences.addon_disable(module=extension.__name__)
    assert bpy.utils.preset_find("As_in_the_Paper", "cubic_craft") is None
    bpy.ops.preferences.addon_enable(module=extension.__name__)

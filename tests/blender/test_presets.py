# SPDX-License-Identifier: GPL-3.0-or-later
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

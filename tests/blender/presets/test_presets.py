# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: ours and the artist's, in and out of Live; their pictures."""

import importlib
import re
import zipfile
from pathlib import Path

import bpy
import pytest
from scene import add_monkey

from solver.method import LOOK, SETTINGS

OURS = ["Soft", "Rounded", "Cubic", "Crisp", "Blocks", "Chunky", "Monolith", "As_in_the_Paper"]
BY_DEFAULT = {name: SETTINGS[name].default for name in LOOK}


@pytest.fixture
def rooms(extension):
    """Return a function that imports a module of the extension."""
    return lambda name: importlib.import_module(f"{extension.__name__}.{name}")


@pytest.fixture
def files(rooms):
    """Return the module of the files; presets that a test has saved are removed."""
    module = rooms("cubic_craft_addon.presets.files")
    yield module
    for preset in module.presets():
        if not preset.is_included:
            module.remove(preset)


@pytest.fixture
def monkey():
    return add_monkey()


def save(name, **settings):
    for key, value in settings.items():
        setattr(bpy.context.object.cubic_craft, key, value)
    return bpy.ops.cubic_craft.preset_add(name=name)


def shape_of(obj):
    values = {name: getattr(obj.cubic_craft, name) for name in LOOK}
    return {n: round(x, 6) if isinstance(x, float) else x for n, x in values.items()}


def test_settings_that_are_no_preset_are_custom(files, monkey):
    monkey.cubic_craft.cubeness = 0.77
    assert monkey.cubic_craft.preset == "CUSTOM"
    before = shape_of(monkey)
    monkey.cubic_craft.preset = "CUSTOM"
    assert shape_of(monkey) == before


def test_a_preset_brings_the_look_to_another_object_and_nothing_else(files, monkey):
    monkey.cubic_craft.device = "NUMPY"
    monkey.cubic_craft.orientation = (0.1, 0.2, 0.3)
    assert save("Tilted Block", cubeness=0.9, together="OFF") == {"FINISHED"}
    other = add_monkey("Other")
    other.cubic_craft.map_group = "Own"
    other.cubic_craft.preset = "Tilted_Block"
    assert shape_of(other) == shape_of(monkey)
    assert other.cubic_craft.device == "AUTO" and other.cubic_craft.map_group == "Own"
    assert not any(other.cubic_craft.orientation)


def test_a_file_that_is_opened_in_a_new_session_knows_its_preset(files, monkey, rooms):
    assert save("Mine", cubeness=0.4, solidity=0.3) == {"FINISHED"}
    assert monkey.cubic_craft.preset == "Mine", "what was just saved is shown, of two alike"
    rooms("cubic_craft_addon.presets.selector").forget()
    assert monkey.cubic_craft.preset == "Cubic"


def test_saving_again_replaces_and_removing_leaves_the_settings(files, monkey):
    assert save("Mine", cubeness=0.9) == save("Mine", cubeness=0.8) == {"FINISHED"}
    (preset,) = [preset for preset in files.presets() if not preset.is_included]
    assert preset.values["cubeness"] == 0.8
    assert bpy.ops.cubic_craft.preset_remove() == {"FINISHED"}
    assert not preset.path.exists()
    assert monkey.cubic_craft.preset == "CUSTOM"
    assert monkey.cubic_craft.cubeness == pytest.approx(0.8)


@pytest.mark.parametrize("name", ["My Look?", "my look"])
def test_another_name_replaces_no_preset_whose_file_it_shares(files, monkey, name):
    assert save("My Look", cubeness=0.9) == {"FINISHED"}
    with pytest.raises(RuntimeError, match=re.escape(f'"{name}" would replace "My Look"')):
        save(name, cubeness=0.8)
    assert save("My_Look", cubeness=0.7) == {"FINISHED"}, "it is the same name"
    (preset,) = [preset for preset in files.presets() if not preset.is_included]
    assert preset.values["cubeness"] == 0.7


def test_ours_can_neither_be_replaced_nor_removed(files, monkey):
    for name in ("Cubic", "Custom"):
        with pytest.raises(RuntimeError, match=f'"{name}" is included with CubicCraft'):
            bpy.ops.cubic_craft.preset_add(name=name)
    with pytest.raises(RuntimeError, match="Choose one of your own presets first"):
        bpy.ops.cubic_craft.preset_remove()
    assert [preset.identifier for preset in files.presets()] == OURS


@pytest.mark.parametrize("name", ["", "   ", "...", "///"])
def test_a_name_that_is_none_is_refused(files, monkey, name):
    with pytest.raises(RuntimeError, match="a preset needs a name"):
        bpy.ops.cubic_craft.preset_add(name=name)


def test_any_other_name_becomes_a_file(files, monkey):
    assert save("../Größe 2: {dick}", cubeness=0.6) == {"FINISHED"}
    (preset,) = [preset for preset in files.presets() if not preset.is_included]
    assert preset.path.parent.name == "cubic_craft"
    assert preset.name.startswith("Größe 2")


def test_a_preset_is_plain_assignments(files, monkey):
    save("Mine", cubeness=0.9)
    path = bpy.utils.preset_find("Mine", "cubic_craft")
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    assert lines[0] == "import bpy"
    assert "bpy.context.object.cubic_craft.cubeness = 0.9" in lines
    assert all(line.startswith("bpy.context.object.cubic_craft.") for line in lines[1:] if line)


def test_what_a_file_has_beside_a_look_is_neither_run_nor_set(files, monkey, tmp_path):
    save("Mine", cubeness=0.9)
    path = Path(bpy.utils.preset_find("Mine", "cubic_craft"))
    trap = tmp_path / "trap"
    path.write_text(
        f"""import bpy
open({str(trap)!r}, "w").close()
bpy.context.object.cubic_craft.cubeness = 0.7
bpy.context.object.cubic_craft.solidity = 1e400
bpy.context.object.cubic_craft.keep_pose = "OFF"
bpy.context.object.cubic_craft.detail = 5.0
bpy.context.object.cubic_craft.keep_apart = 0.0
bpy.context.object.cubic_craft.together = "EVERYTHING"
bpy.context.object.cubic_craft.refine = 3
bpy.context.object.cubic_craft.hold_rest = 0
bpy.context.object.cubic_craft.device = "GPU"
bpy.context.object.location = (1, 2, 3)
"""
    )
    (path.parent / "broken.py").write_text("cubeness = (")
    (path.parent / "empty.py").write_text("")
    files._presets_of.cache_clear()
    (preset,) = [preset for preset in files.presets() if not preset.is_included]
    assert preset.values == {"cubeness": 0.7}
    monkey.cubic_craft.preset = "Mine"
    assert shape_of(monkey) == BY_DEFAULT | {"cubeness": 0.7}
    assert monkey.cubic_craft.device == "AUTO" and not any(monkey.location) and not trap.exists()
    for name in ("broken.py", "empty.py"):
        (path.parent / name).unlink()


def test_each_setting_of_a_look_is_saved_and_brought_back(files, monkey):
    other = {
        name: SETTINGS[name].choices[by_default == SETTINGS[name].choices[0][0]][0]
        if isinstance(by_default, str)
        else (not by_default if isinstance(by_default, bool) else 0.125)
        for name, by_default in BY_DEFAULT.items()
    }
    assert save("Mine", **other) == {"FINISHED"}
    monkey.cubic_craft.preset = "Cubic"
    assert shape_of(monkey) == BY_DEFAULT
    monkey.cubic_craft.preset = "Mine"
    assert shape_of(monkey) == other


def test_each_of_ours_sets_all_of_a_look_but_the_paper_leaves_the_cubeness(files):
    for preset in files.presets():
        left = {"cubeness"} if preset.identifier == "As_in_the_Paper" else set()
        assert set(preset.values) == set(LOOK) - left


def test_reset_gives_the_defaults_but_for_what_belongs_to_the_mesh(monkey):
    settings = monkey.cubic_craft
    settings.preset, settings.device, settings.space = "Chunky", "NUMPY", "FRAME"
    settings.orientation, settings.result = (0.1, 0.2, 0.3), "SHAPE_KEY"
    settings.map_group, settings.map_invert = "Mine", True
    assert bpy.ops.cubic_craft.reset() == {"FINISHED"}
    assert settings.preset == "Cubic" and settings.device == "AUTO" and settings.space == "WORLD"
    assert not any(settings.orientation) and settings.result == "MESH"
    assert settings.map_group == "Mine" and settings.map_invert


def test_live_takes_presets_and_reset(files, live, begin, monkey):
    session = begin(monkey, cubeness=0.3)
    settings = live.live_properties()
    assert settings.preset == "CUSTOM"
    settings.preset = "Chunky"
    assert settings.cubeness == 1.0
    assert monkey.cubic_craft.cubeness == pytest.approx(0.3), "until Live is confirmed"
    session.tick(bpy.context)
    assert session.tasks[0].settings.solidity == 1.0
    settings.preset = "Monolith"
    session.tick(bpy.context)
    proxy = session.tasks[0].settings.proxy
    assert (proxy.keep_pose, proxy.detail, proxy.keep_apart) == (False, 0.0, True)
    settings.cubeness = 0.55
    assert bpy.ops.cubic_craft.preset_add(name="From Live") == {"FINISHED"}
    settings.preset = "Soft"
    settings.preset = "From_Live"
    assert settings.cubeness == pytest.approx(0.55)
    assert bpy.ops.cubic_craft.preset_remove() == {"FINISHED"}
    session.tick(bpy.context)
    assert bpy.ops.cubic_craft.reset() == {"CANCELLED"}, "no undo step"
    assert settings.preset == "Cubic"
    session.tick(bpy.context)
    assert session.take_back() and settings.cubeness == pytest.approx(0.55)


def test_pictures(files, rooms, monkey):
    pictures = rooms("cubic_craft_addon.presets.selector")
    save("Mine", cubeness=0.9)
    for preset in files.presets():
        pictures.icon_of(preset)  # without a window all are 0
    shown = dict(pictures._collection)
    assert set(shown) == {
        str(pictures._WITHOUT), *(str(p.picture) for p in files.presets() if p.is_included)
    }  # fmt: skip
    for path, picture in shown.items():
        assert tuple(picture.image_size) == (160, 160)
        assert Path(path).stat().st_size < 30_000
    pictures.forget()
    assert pictures._collection is None


def test_presets_and_pictures_go_with_the_extension(extension, rooms):
    pictures = rooms("cubic_craft_addon.presets.selector")
    add_monkey()
    assert bpy.context.object.cubic_craft.preset == "Cubic"
    assert pictures._collection is not None
    bpy.ops.preferences.addon_disable(module=extension.__name__)
    assert pictures._collection is None
    bpy.ops.preferences.addon_enable(module=extension.__name__)


def test_the_zip_has_a_picture_of_each_preset(archive):
    names = zipfile.ZipFile(archive).namelist()
    assert {f"cubic_craft_addon/assets/presets/{n}.png" for n in OURS} <= set(names)
    assert "cubic_craft_addon/assets/preset_without_picture.png" in names

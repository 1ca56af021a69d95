# SPDX-License-Identifier: GPL-3.0-or-later
"""The selector of the form: its pictures, and items that are those of files."""

import zipfile
from pathlib import Path

import bpy
import bpy.utils.previews
import pytest
from scene import add_monkey

NUMBERS = {
    "CUBE": 0,
    "BOX": 1,
    "ROUNDED": 2,
    "OCTAHEDRON": 3,
    "TETRAHEDRON": 4,
    "DODECAHEDRON": 5,
    "ICOSAHEDRON": 6,
    "RHOMBIC": 7,
    "PRISM": 8,
    "PYRAMID": 9,
    "CYLINDER": 10,
    "CONE": 11,
    "OBJECT": 12,
    "DIRECTIONS": 13,
    "FACES": 14,
}
"""as they are in files"""
FOLDER = "cubic_craft_addon/assets/forms"


@pytest.fixture
def pictures(part):
    return part("form.pictures")


def groups(live):
    """Return the types that have the property: of objects, of Live and of the operator."""
    operator = bpy.ops.cubic_craft.cubify.get_rna_type()
    return add_monkey().cubic_craft.bl_rna, live.live_properties().bl_rna, operator


def test_the_zip_has_a_small_picture_of_each_form_and_no_other(archive):
    files = [info for info in zipfile.ZipFile(archive).infolist() if FOLDER in info.filename]
    names = {info.filename for info in files if not info.is_dir()}
    assert names == {f"{FOLDER}/{form}.png" for form in NUMBERS}
    assert max(info.file_size for info in files) <= 8_000
    assert sum(info.file_size for info in files) < 90_000


def test_the_pictures_are_those_of_the_items(pictures):
    assert [item[0] for item in pictures.items] == list(pictures._collection) == list(NUMBERS)
    looks = set()
    for form, picture in pictures._collection.items():
        assert tuple(picture.image_size) == (96, 96)
        image = bpy.data.images.load(str(pictures.path_of(form)))
        alpha = list(image.pixels)[3::4]
        assert alpha[0] == 0.0 and max(alpha) == 1.0, "the corner is transparent"
        looks.add(pictures.path_of(form).read_bytes())
    assert len(looks) == len(NUMBERS)


def test_items_are_those_of_files_wherever_the_property_is(live):
    for group in groups(live):
        form = group.properties["form"]
        assert {item.identifier: item.value for item in form.enum_items} == NUMBERS
        assert form.default == "CUBE"


def test_a_driver_and_keyframes_use_the_numbers():
    obj = add_monkey()
    obj.cubic_craft.form = "CONE"
    assert obj.cubic_craft.keyframe_insert("form", frame=1)
    obj.cubic_craft.form = "PRISM"
    assert obj.cubic_craft.keyframe_insert("form", frame=5)
    for frame, form in ((1, "CONE"), (5, "PRISM")):
        bpy.context.scene.frame_set(frame)
        assert obj.cubic_craft.form == form
    other = add_monkey("Other")
    other.driver_add("cubic_craft.form").driver.expression = str(NUMBERS["OCTAHEDRON"])
    bpy.context.view_layer.update()
    assert other.evaluated_get(bpy.context.evaluated_depsgraph_get()).cubic_craft.form == (
        "OCTAHEDRON"
    )


def test_pictures_go_with_the_extension_and_come_again(extension, live, pictures):
    items, open_collections = pictures.items, set()
    for _ in range(3):
        bpy.ops.preferences.addon_disable(module=extension.__name__)
        assert pictures._collection is None
        assert not hasattr(bpy.types.Object, "cubic_craft")
        open_collections.add(len(bpy.utils.previews._uuid_open))
        bpy.ops.preferences.addon_enable(module=extension.__name__)
        assert len(pictures._collection) == len(NUMBERS)
        assert pictures.items is items, "the declared properties have this very list"
        assert len(items) == len(NUMBERS)
    assert len(open_collections) == 1, "a collection is left over each time"
    for group in groups(live):
        assert [item.identifier for item in group.properties["form"].enum_items] == list(NUMBERS)


def test_a_picture_that_is_lost_stops_nothing(extension, pictures, monkeypatch):
    monkeypatch.setattr(pictures, "_FOLDER", Path("nowhere"))
    bpy.ops.preferences.addon_disable(module=extension.__name__)
    bpy.ops.preferences.addon_enable(module=extension.__name__)
    assert add_monkey().cubic_craft.form == "CUBE"

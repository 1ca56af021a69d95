# SPDX-License-Identifier: GPL-3.0-or-later
"""What the documentation says of Blender: its examples run, and what it names is there."""

import re

import bpy
import pytest
from documents import GUIDE, PAGES, ROOT, examples, run_example

SCRIPTING = (ROOT / "docs" / "scripting.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("page", "title"), examples("bpy"), ids=lambda value: getattr(value, "name", value)
)
def test_example_runs(page, title):
    assert run_example(page, title)


def test_table_of_properties_is_complete_and_has_their_defaults():
    bpy.ops.mesh.primitive_monkey_add()
    table = SCRIPTING.split("have these in common:")[1].split("and differ in these:")[0]
    rows = dict(re.findall(r"^\| `(\w+)` \|[^|]*\| ([^|]*) \|", table, re.MULTILINE))
    operator = bpy.ops.cubic_craft.cubify.get_rna_type().properties
    common = {
        p.identifier: p
        for p in bpy.context.object.cubic_craft.bl_rna.properties
        if p.identifier in operator and p.type not in ("POINTER", "COLLECTION")
    }
    assert set(rows) == set(common) - {"name", "rna_type"}
    for name, given in rows.items():
        default = common[name].default
        if isinstance(default, bool):
            assert given == ("on" if default else "off"), name
        elif isinstance(default, int | float) and not common[name].is_array:
            assert float(given) == pytest.approx(default), name
        elif isinstance(default, str):
            assert given.strip("`") == (default or "none"), name


def test_operators_that_are_named_are_there():
    there = set(dir(bpy.ops.cubic_craft))
    named = {
        name
        for page in PAGES
        for name in re.findall(
            r"(?<![\w/])cubic_craft\.(?!zip|js)([a-z_]+)\b(?=[`(])", page.read_text("utf-8")
        )
    }
    assert {"cubify", "restore"} <= named
    assert named <= there, named - there


def test_labels_of_the_user_guide_are_those_of_the_panel(part):
    bpy.ops.mesh.primitive_monkey_add()
    groups = [bpy.context.object.cubic_craft.bl_rna]
    groups += [
        getattr(bpy.ops.cubic_craft, name).get_rna_type() for name in dir(bpy.ops.cubic_craft)
    ]
    labels = {"Show Form"} | {group.name for group in groups}
    for prop in [prop for group in groups for prop in group.properties]:
        labels |= {prop.name} | {item.name for item in getattr(prop, "enum_items", ())}
    labels |= {name.replace("_", " ") for name in part("presets.included").INCLUDED}
    named = [
        label
        for page in sorted(GUIDE.glob("*.md"))
        for label in re.findall(r"^\| \*\*(.+?)\*\* \|", page.read_text("utf-8"), re.MULTILINE)
        if page.name != "live.md"  # whose table has keys
    ]
    assert len(named) > 15
    assert set(named) <= labels, set(named) - labels

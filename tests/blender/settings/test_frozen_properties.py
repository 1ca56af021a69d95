# SPDX-License-Identifier: GPL-3.0-or-later
"""What files, scripts and artists know of the settings stays: names, numbers, limits and texts.

`frozen_properties.json` has them as they were. A line of it changes only with a setting that is new
or meant otherwise; names and numbers of enums never do, as files are full of them.
"""

import importlib
from pathlib import Path

import bpy

from tests import frozen

FROZEN = Path(__file__).with_name("frozen_properties.json")
NUMBERS = ("hard_min", "hard_max", "soft_min", "soft_max", "step", "precision", "array_length")
TEXTS = ("name", "description", "type", "subtype", "is_animatable", "is_skip_save")
OWN = ("rna_type", "bl_idname")


def plain(value):
    """Return a default as it stands in JSON; numbers have 32 bits."""
    if isinstance(value, float):
        return float(f"{value:.6g}")
    return value if isinstance(value, str | int | None) else [plain(x) for x in value]


def about(prop):
    """Return all that is declared of a property."""
    found = {name: plain(getattr(prop, name)) for name in TEXTS}
    found |= {name: plain(getattr(prop, name)) for name in NUMBERS if hasattr(prop, name)}
    if hasattr(prop, "default"):
        is_array = getattr(prop, "is_array", False)
        found["default"] = plain(prop.default_array if is_array else prop.default)
    if prop.type == "ENUM" and prop.identifier != "preset":
        items = prop.enum_items
        found["items"] = [[i.identifier, i.name, i.description, i.value] for i in items]
    if prop.type in ("POINTER", "COLLECTION"):
        found["of"] = prop.fixed_type.identifier
    return found


def declared(rna):
    return {p.identifier: about(p) for p in rna.properties if p.identifier not in OWN}


def all_declared(extension):
    """Return the properties of an object, and what others declare otherwise."""
    live = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.live.properties")
    of_object = bpy.types.Object.bl_rna.properties["cubic_craft"].fixed_type
    groups = {
        "operator": bpy.ops.cubic_craft.cubify.get_rna_type(),
        "live": live.CubicCraftLiveProperties.bl_rna,
        "region": of_object.properties["regions"].fixed_type,
    }
    known = declared(of_object)
    found = {f"object.{name}": value for name, value in known.items()}
    for group, rna in groups.items():
        for name, value in declared(rna).items():
            is_as = value == known.get(name)
            found[f"{group}.{name}"] = "as the object's" if is_as else value
    return found


def test_names_numbers_limits_and_texts_of_properties_are_as_they_were(extension):
    frozen.check(all_declared(extension), FROZEN)

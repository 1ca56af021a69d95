# SPDX-License-Identifier: GPL-3.0-or-later
"""The property of Blender for what is declared of a setting."""

from typing import Any

from bpy import props

from ...solver.setting import Setting

_KINDS = {
    (bool, False): props.BoolProperty,
    (bool, True): props.BoolVectorProperty,
    (int, False): props.IntProperty,
    (float, False): props.FloatProperty,
    (float, True): props.FloatVectorProperty,
    (str, False): props.StringProperty,
}


def declared(setting: Setting, **others: Any) -> Any:
    """Return the declaration of a property.

    `others`: further arguments, or other ones, by default it can be animated, and an operator takes
    it from the object, not from its last run (SKIP_SAVE).
    """
    how: dict[str, Any] = {"options": {"SKIP_SAVE", "ANIMATABLE"}}
    how |= {"name": setting.label, "description": setting.text, "default": setting.default}
    if setting.choices:
        return props.EnumProperty(**{**how, "items": setting.choices, **others})
    if setting.limits:
        how["min"], how["max"] = setting.limits
    if setting.soft:
        how["soft_min"], how["soft_max"] = setting.soft
    is_vector = isinstance(setting.default, tuple)
    kind = type(setting.default[0] if is_vector else setting.default)
    if kind is not bool or is_vector:
        how["subtype"] = setting.subtype
    if kind is float and not is_vector:
        how["step"], how["precision"] = 1, setting.digits
    return _KINDS[kind, is_vector](**{**how, **others})

# SPDX-License-Identifier: GPL-3.0-or-later
"""The property of Blender for what is declared of a setting, and properties of its own types."""

from collections.abc import Callable, Mapping
from typing import Any

import bpy
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


def added(
    owner: type, properties: Mapping[str, Any], group: type | None = None
) -> tuple[Callable[[], None], Callable[[], None]]:
    """Return `register` and `unregister` of properties, by name, of a type of Blender.

    `group`: the property group that one of them points to, which is registered with them.
    """

    def register():
        if group is not None:
            bpy.utils.register_class(group)
        for name, declaration in properties.items():
            setattr(owner, name, declaration)

    def unregister():
        for name in properties:
            delattr(owner, name)
        if group is not None:
            bpy.utils.unregister_class(group)

    return register, unregister

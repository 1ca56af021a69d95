# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of a scene, which an operator has by the same names."""

from typing import Any

import bpy
from bpy.props import PointerProperty

from ...solver.setting import declared as settings_of
from .declared import added, declared


def properties_of(declaration: type, **others: dict[str, Any]) -> dict[str, Any]:
    """Return properties that cannot be animated, by name, for a dataclass of settings.

    `others`: by name, what else the declaration of a property has.
    """
    return {
        name: declared(each, **{"options": set(), **others.get(name, {})})
        for name, each in settings_of(declaration).items()
    }


class SceneSettings:
    """A property group of each scene.

    `name`: of the property of scenes. `declaration`: dataclass of the settings. `group`: the class
    with the `properties_of` it.
    """

    def __init__(self, name: str, declaration: type, group: type[bpy.types.PropertyGroup]):
        self._name, self._declaration = name, declaration
        pointer = PointerProperty(type=group)
        self.register, self.unregister = added(bpy.types.Scene, {name: pointer}, group)

    def of(self, scene: bpy.types.Scene) -> Any:
        """Return the settings of a scene."""
        return getattr(scene, self._name)

    def given(self, operator: Any, scene: bpy.types.Scene) -> dict[str, Any]:
        """Return all by name: as given to an operator that has them too, else as of the scene."""
        is_given, shared = operator.properties.is_property_set, self.of(scene)
        names = settings_of(self._declaration)
        return {name: getattr(operator if is_given(name) else shared, name) for name in names}

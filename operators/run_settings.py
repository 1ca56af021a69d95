# SPDX-License-Identifier: GPL-3.0-or-later
"""From the properties of the Cubify operator to the settings of each object, and back.

What the caller has not set is taken from the active object, for all objects; so the redo panel
shows what was used. Vertex groups and handles belong to the mesh: of several objects, each keeps
its own unless the caller sets them.
"""

import math
from dataclasses import fields, replace

import bpy

from ..cubic_craft_addon.handle_pose import posed_handles
from ..cubic_craft_addon.handles import Handle
from ..cubic_craft_addon.properties import RunProperties, object_properties, settings_of
from ..cubic_craft_addon.settings import Settings
from ..solver import CubicCraftError

_ALL = tuple(RunProperties.__annotations__)
_OF_EACH_OBJECT = ("use_handles", "map_group", "map_invert")
_PLAIN = tuple(field.name for field in fields(Settings))  # the same name in the Settings


def adopt_settings(operator, objects):
    """Take what the caller has not set from the first object, which is the active one."""
    source = object_properties(objects[0])
    for name in _ALL:
        if name in _OF_EACH_OBJECT and len(objects) > 1:
            continue
        if not operator.properties.is_property_set(name):
            setattr(operator, name, getattr(source, name))
    is_framed = operator.space == "FRAME" and source.frame is not None
    if is_framed and not operator.properties.is_property_set("frame"):
        operator.frame = source.frame.name


def frame_of(operator, active):
    """Return the frame object that the operator names, None where it needs none.

    Raises
    ------
    CubicCraftError
        There is no object of that name.
    """
    if operator.space != "FRAME" or not operator.frame:
        return None
    own = object_properties(active).frame
    if own is not None and own.name == operator.frame:
        return own  # not by its name, which an object of a library may have as well
    frame = bpy.data.objects.get(operator.frame)
    if frame is None:
        raise CubicCraftError(f'there is no object "{operator.frame}"; pick another frame')
    return frame


def settings_for(operator, obj, frame):
    """Return the settings with which the operator is to cubify the object.

    Raises
    ------
    CubicCraftError
        The handles, those of the object or those given, cannot be used.
    """
    is_set = operator.properties.is_property_set
    changes = {name: getattr(operator, name) for name in _ALL if is_set(name) and name in _PLAIN}
    changes["orientation"] = tuple(operator.orientation)
    if is_set("handles"):
        handles = _given_handles(operator)
    else:
        handles = posed_handles(obj) if uses_own_handles(operator, obj) else ()
    if operator.space == "FRAME":
        changes["frame"] = frame
    return replace(settings_of(obj, handles), **changes)


def _given_handles(operator):
    return tuple(
        Handle(item.name, threshold=item.threshold, matrix=_affine(item))
        for item in operator.handles
    )


def _affine(item):
    """Return the item's matrix as 16 numbers, row by row."""
    matrix = tuple(value for row in item.matrix for value in row)
    if matrix[12:] != (0.0, 0.0, 0.0, 1.0) or not all(map(math.isfinite, matrix)):
        raise CubicCraftError(
            f'the matrix of handle "{item.name}" is no affine map; give it as a mathutils.Matrix'
            " (Blender takes a plain list by its columns)"
        )
    return matrix


def uses_own_handles(operator, obj):
    """Tell whether the operator cubifies the object with the object's own handles."""
    is_set = operator.properties.is_property_set
    settings = operator if is_set("use_handles") else object_properties(obj)
    return settings.use_handles and not is_set("handles")


def remember_settings(operator, target, settings):
    """Keep what was used on the object that was made, so that its panel shows how."""
    properties = object_properties(target)
    values = {name: getattr(operator, name) for name in _ALL if name not in _OF_EACH_OBJECT}
    for name in _OF_EACH_OBJECT:
        if operator.properties.is_property_set(name):
            values[name] = getattr(operator, name)
    if settings.space == "FRAME":
        values["frame"] = settings.frame
    if settings.result == "NEW_OBJECT":
        values["result"] = "MESH"  # a click on the new object is to change it, not to copy it again
    for name, value in values.items():
        if getattr(properties, name) != value:
            setattr(properties, name, value)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a cubic shape matches the settings."""

from dataclasses import fields
from typing import Any

import bpy
import numpy as np

from ...solver import CubicCraftError
from ...solver.styles.form_names import OF_OBJECT
from ..form.body import form_of
from ..form.settings import FORM_SETTINGS, form_settings
from ..mesh_bridge import LastRun
from ..object_properties import object_properties
from ..settings.properties import settings_of
from ..settings.values import SETTINGS, Settings

_IGNORED = {name for name, each in SETTINGS.items() if each.keeps_result}
_LABELS = {
    "handles": "Handles",
    "regions": "Regions",
    "map_group": "Cubeness Map",
    "map_invert": "Cubeness Map",
}
_ROUNDING = 1e-5  # of matrices, relative


def what_matters(settings: Settings) -> dict[str, Any]:
    """Return the settings that determine the shape as values for JSON.

    The transform of the object itself is not a setting: an artist who rotates a finished sculpture
    wants it rotated, whatever the angles are relative to.
    """
    names = (field.name for field in fields(settings) if field.name not in _IGNORED)
    values = {name: getattr(settings, name) for name in names}
    values["frame"] = _turn(settings.frame) if settings.space == "FRAME" else None
    values |= _form(settings)
    values["regions"] = [
        [region.group, {**region.own, **_form(settings.of_region(region))}]
        for region in settings.regions
    ]
    values["handles"] = [_handle(handle) for handle in settings.handles]
    values["map_invert"] = bool(settings.map_group) and settings.map_invert
    if settings.result == "NEW_OBJECT":
        values["result"] = "MESH"  # its name in the new object
    return values


def changes_since(obj: bpy.types.Object, run: LastRun) -> list[str]:
    """Return the labels of the settings of an object that differ from those of the run.

    Only settings that would change the shape count. It is cheap because it runs at every redraw, so
    it does not detect painted weights. Empty while the settings are invalid, and if
    results go to new objects, which do not change this one.
    """
    try:
        settings = settings_of(obj)
    except CubicCraftError:
        return []
    if settings.result == "NEW_OBJECT":
        return []
    now, then = what_matters(settings), run.settings
    # Older versions may not have noted a setting.
    names = [name for name in now if name in then and not _is_same(now[name], then[name])]
    return list(dict.fromkeys(_label(obj, name) for name in names))


def _label(obj, name):
    return _LABELS.get(name) or object_properties(obj).bl_rna.properties[name].name


def _turn(frame):
    return None if frame is None else _matrix(frame.matrix_world.to_quaternion().to_matrix())


def _form(settings):
    """Return those of the FORM_SETTINGS that do not stand for themselves."""
    used = form_settings(settings.form)
    values: dict[str, Any] = {name: None for name in FORM_SETTINGS if name not in used}
    if settings.form in OF_OBJECT:
        values["form_object"] = _body(settings)
    return values


def _body(settings):
    try:
        form = form_of(settings)
    except CubicCraftError:
        return None
    return form and _matrix(form.normals * form.offsets[:, None])


def _handle(handle):
    matrix = np.reshape(handle.matrix, (4, 4))
    values = [handle.group, handle.threshold, _matrix(matrix[:3, :3]), _matrix(matrix[:3, 3])]
    return [*values, True] if handle.is_cubic else values  # older notes have no such value


def _matrix(array):
    return {"matrix": np.ravel(array).astype(np.float64).tolist()}


def _is_same(now: Any, then: Any) -> bool:
    """Compare two values; single numbers in the 32 bits that Blender's properties have."""
    if isinstance(now, dict) and "matrix" in now:
        return isinstance(then, dict) and _is_near(now["matrix"], then.get("matrix"))
    if isinstance(now, dict):
        return isinstance(then, dict) and all(
            name in then and _is_same(value, then[name]) for name, value in now.items()
        )
    if isinstance(now, list | tuple):
        is_alike = isinstance(then, list) and len(then) == len(now)
        return is_alike and all(map(_is_same, now, then))
    if isinstance(now, float):
        return isinstance(then, int | float) and np.float32(now) == np.float32(then)
    return now == then


def _is_near(now: list[float], then: Any) -> bool:
    if not isinstance(then, list) or len(then) != len(now):
        return False
    if not all(isinstance(value, int | float) for value in then):
        return False
    size = max(map(abs, (*now, *then)))
    return all(abs(a - b) <= _ROUNDING * size for a, b in zip(now, then, strict=True))

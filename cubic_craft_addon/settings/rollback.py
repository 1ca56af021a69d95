# SPDX-License-Identifier: GPL-3.0-or-later
"""Restore the settings of objects if the work that they belong to fails, or copy them."""

from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from typing import Any

import bpy

from .. import mesh_bridge
from ..object_properties import PROPERTY, has_properties, object_properties, users_of
from ..screen import glimpse

_DERIVED = ("preset",)  # derived from the others: setting it would set them


def settings_kept(meshes: Iterable[bpy.types.Mesh]) -> AbstractContextManager[None]:
    """Restore the settings of all objects that use the meshes if the block raises.

    Handles and regions may change in it, but none may be added or removed.
    """
    return mesh_bridge.after_errors(partial(_put_all_back, _read_all(meshes)))


@contextmanager
def settings_untouched(meshes: Iterable[bpy.types.Mesh]) -> Iterator[None]:
    """Restore them in any case, as `settings_kept` does."""
    before = _read_all(meshes)
    try:
        yield
    finally:
        _put_all_back(before)


@glimpse.quiet()
def copy_settings(source: bpy.types.Object, target: bpy.types.Object) -> None:
    """Give an object all settings of another, with its handles and regions."""
    one, other = object_properties(source), object_properties(target)
    for name in ("handles", "regions"):
        there, new = getattr(one, name), getattr(other, name)
        new.clear()
        for _ in there:
            new.add()
    for group, copy in zip(_groups(source), _groups(target), strict=True):
        _put_back(copy, _read(group))


def _read_all(meshes: Iterable[bpy.types.Mesh]) -> list[tuple[bpy.types.Object, Any]]:
    return [
        (obj, [_read(group) for group in _groups(obj)] if has_properties(obj) else None)
        for obj in users_of(meshes)
    ]


@glimpse.quiet()
def _put_all_back(before: list[tuple[bpy.types.Object, Any]]) -> None:
    for obj, values in before:
        if values is not None:
            for group, taken in zip(_groups(obj), values, strict=True):
                _put_back(group, taken)
        elif has_properties(obj):
            obj.property_unset(PROPERTY)


def _groups(obj: bpy.types.Object) -> list[Any]:
    properties = object_properties(obj)
    return [properties, *properties.handles, *properties.regions]


def _read(group: Any) -> dict[str, Any]:
    taken = {}
    for prop in group.bl_rna.properties:
        if prop.type != "COLLECTION" and not prop.is_readonly and prop.identifier not in _DERIVED:
            value = getattr(group, prop.identifier)
            taken[prop.identifier] = _plain(value), group.is_property_set(prop.identifier)
    return taken


def _put_back(group: Any, taken: dict[str, Any]) -> None:
    for name, (value, is_set) in taken.items():
        if not is_set:
            if group.is_property_set(name):
                group.property_unset(name)
        elif _plain(getattr(group, name)) != value:
            setattr(group, name, value)


def _plain(value: Any) -> Any:
    """Copy vectors and matrices, which are views of the property and would change."""
    if isinstance(value, str | int | float | bpy.types.ID | None):
        return value
    return value.copy() if hasattr(value, "copy") else tuple(value)

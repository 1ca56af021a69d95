# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators, in files named by their verbs. All that are in such a file are registered."""

from importlib import import_module
from pkgutil import iter_modules

import bpy

_FILES = [import_module(f".{each.name}", __name__) for each in iter_modules(__path__)]

register, unregister = bpy.utils.register_classes_factory(
    [
        found
        for file in _FILES
        for found in vars(file).values()
        if isinstance(found, type)
        and issubclass(found, bpy.types.Operator)
        and found.__module__ == file.__name__
    ]
)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Levels of detail: low-poly versions of results, with normal maps."""

import contextlib
from collections.abc import Iterator
from pathlib import Path

import bpy

from ....solver.console.errors import InputError
from ....solver.errors import CubicCraftError
from ...send.normal_map import MapOptions, passing_normal_map
from ..solving.cubify_all import Sculpture

LEAST = 12
"""triangles of an object"""


@contextlib.contextmanager
def low_poly(
    sculptures: list[Sculpture], triangles: int, path: Path
) -> Iterator[tuple[list[bpy.types.Object], list[str]]]:
    """Give low-poly versions of all objects, which carry their results, during the block.

    `triangles`: of all meshes together, shared among them by the triangles that they have. `path`:
    of the file that they are for. Gives the objects, and what should be known about them, a line
    each. Raises InputError: there is no Cycles, or a mesh has no room for another UV map.
    """
    total = sum(sculpture.member.triangles for sculpture in sculptures)
    objects: list[bpy.types.Object] = []
    problems: list[str] = []
    with contextlib.ExitStack() as passing:
        for sculpture in sculptures:
            member = sculpture.member
            share = max(LEAST, triangles * member.triangles // total)
            options = MapOptions(triangles=share)
            try:
                made = passing.enter_context(
                    passing_normal_map(sculpture.object, member.alone, options)
                )
            except CubicCraftError as error:
                raise InputError(f"{path}: {error}") from error
            objects.append(made.object)
            for user in sculpture.users[1:]:
                twin = user.copy()
                passing.callback(bpy.data.objects.remove, twin)
                twin.data, twin.name = made.object.data, f"{user.name} Low"
                for modifier in [m for m in twin.modifiers if m.type != "ARMATURE"]:
                    twin.modifiers.remove(modifier)  # the low-poly mesh has them
                bpy.context.scene.collection.objects.link(twin)
                objects.append(twin)
            problems += [f"{path}: {problem}" for problem in made.problems]
        bpy.context.view_layer.update()
        yield objects, problems

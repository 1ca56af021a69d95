# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of what can happen in a step of the walk, and what its members share.

An action is a function of a ``random.Random``, a generator function where Blender has to go on
meanwhile. It returns what it has done in words, or None where it cannot be done now; another one is
then drawn.
"""

import dataclasses
from collections.abc import Callable

import bpy
import guidrive as gui
import live_scene as scene

MOST_VERTICES = 3000  # of one mesh, so that a step takes no longer than a moment
MOST_OBJECTS = 7


@dataclasses.dataclass(frozen=True)
class Action:
    """One thing that can happen."""

    do: Callable
    weight: float
    reshapes: bool  # meshes may have other shapes or faces after it: the artist wants that
    goes_back: bool  # it may bring back any earlier state: undo, redo, load

    @property
    def name(self):
        return self.do.__name__


ALL: list[Action] = []


def action(weight=1.0, reshapes=False, goes_back=False):
    """Add a function to the list."""

    def add(do):
        ALL.append(Action(do, weight, reshapes, goes_back))
        return do

    return add


def call(name, context="EXEC_DEFAULT", **options):
    """Call an operator over the viewport as a button does: with an undo step.

    Returns what it returned in words, or None where its `poll` does not allow it. A report of an
    error is an answer; a Python error is raised.
    """
    module, _, function = name.partition(".")
    operator = getattr(getattr(bpy.ops, module), function)
    with gui.in_region():
        if not operator.poll(context):
            return None
        try:
            result = ", ".join(operator(context, True, **options))
        except RuntimeError as error:
            if "Traceback" in str(error):
                raise
            result = " ".join(str(error).split())[:120]
    settings = ", ".join(f"{key}={value!r}" for key, value in options.items())
    return f"{name}({settings}): {result}"


def active():
    """Return the active object, or None."""
    return bpy.context.view_layer.objects.active


def active_mesh():
    """Return the active object if it is a mesh, else None."""
    obj = active()
    return obj if obj is not None and obj.type == "MESH" else None


def meshes_in_view():
    """Return the mesh objects that can be selected."""
    return [o for o in bpy.context.view_layer.objects if o.type == "MESH" and o.visible_get()]


def is_on():
    """Return whether the extension is switched on."""
    return hasattr(bpy.types.WindowManager, "cubic_craft_live")


def is_live():
    """Return whether Live runs."""
    return is_on() and scene.live().current() is not None


def is_cubifying():
    """Return whether a Cubify goes on beside Blender."""
    return is_on() and scene.job().current() is not None


def turns(count):
    """Let Blender's main loop turn."""
    for _ in range(count):
        yield

# SPDX-License-Identifier: GPL-3.0-or-later
"""What Restore and Apply share: both work on meshes that have an original."""

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.properties import object_properties
from ..solver import CubicCraftError
from .selection import report_all, selected_meshes


def poll_originals(operator_class, context):
    """Tell whether a selected mesh has an original."""
    if any(mesh_bridge.has_original(obj.data) for obj in selected_meshes(context)):
        return True
    operator_class.poll_message_set("The mesh has its original shape; Cubify it first")
    return False


def for_each_original(operator, context, action, done):
    """Call ``action(obj)`` once per selected mesh that has an original, and report."""
    problems, names = [], []
    meshes = set()
    for obj in selected_meshes(context):
        if obj.data in meshes or not mesh_bridge.has_original(obj.data):
            continue
        meshes.add(obj.data)
        try:
            mesh_bridge.check_editable(obj)
            action(obj)
        except CubicCraftError as error:
            problems.append(str(error))
            continue
        object_properties(obj).status = ""
        names.append(obj.name)
    return report_all(operator, f"{done} {', '.join(names)}" if names else "", problems)

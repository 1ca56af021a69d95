# SPDX-License-Identifier: GPL-3.0-or-later
"""Shared by operators that work on meshes with data of ours, such as Restore and Apply."""

import logging

from ...cubic_craft_addon import mesh_bridge
from ...cubic_craft_addon.run.failures import UNEXPECTED, in_words
from ...cubic_craft_addon.settings.rollback import settings_kept
from ...solver import CubicCraftError
from .selection import poll_any_usable, report_all, selected_meshes

_log = logging.getLogger(__name__)


def poll_originals(operator_class, context):
    """Return whether a selected mesh has data of ours and can be changed.

    It is cheap because it runs at every redraw.
    """
    objects = [obj for obj in selected_meshes(context) if mesh_bridge.has_traces(obj.data)]
    return poll_any_usable(
        operator_class, objects, "The mesh has its original shape; cubify it first"
    )


def for_each_original(operator, context, action, done, is_meant=mesh_bridge.has_traces):
    """Call ``action(obj)`` once per selected mesh with data of ours (`is_meant`), and report.

    The action changes the mesh as its last step, or not at all. It returns a remark,
    or an empty text.
    """
    problems, names, remarks = [], [], []
    meshes = set()
    for obj in selected_meshes(context):
        if obj.data in meshes or not is_meant(obj.data):
            continue
        meshes.add(obj.data)
        try:
            mesh_bridge.check_usable(obj)
            with settings_kept([obj.data]):
                remark = action(obj)
        except CubicCraftError as error:
            problems.append(str(error))
        except UNEXPECTED as error:
            # This one has been restored; the others need their undo step.
            _log.exception("%s failed", operator.bl_label)
            problems.append(f'"{obj.name}" is unchanged: {in_words(error)}')
        else:
            names.append(obj.name)
            remarks.append(remark)
    if not names:
        return report_all(operator, "", problems)
    texts = [f"{done} {', '.join(names)}", *dict.fromkeys(filter(None, remarks))]
    return report_all(operator, "; ".join(texts), problems)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that work on meshes with data of ours, such as Restore and Apply."""

import logging
from typing import Any

from ...cubic_craft_addon import mesh_bridge
from ...cubic_craft_addon.run.failures import UNEXPECTED, in_words
from ...cubic_craft_addon.settings.rollback import settings_kept
from ...solver import CubicCraftError
from .selection import poll_any_usable, poll_meshes, report_all, selected_meshes
from .unexpected_errors import reporting

_log = logging.getLogger(__name__)


class OnOriginals:
    """Mix in before `bpy.types.Operator`; it changes each selected mesh with data of ours once."""

    bl_label: str
    bl_options = {"REGISTER", "UNDO"}
    done: str
    """what is reported of meshes that were changed, before their names"""
    nothing = "The mesh has its original shape; cubify it first"
    is_meant = staticmethod(mesh_bridge.has_traces)
    """which meshes are changed; it reads no positions, as it is asked at every redraw"""

    def change(self, obj: Any) -> str:
        """Change the mesh of an object as the last step, or not at all; return a remark, or ""."""
        raise NotImplementedError

    @classmethod
    def poll(cls, context):
        if not poll_meshes(cls, context):
            return False
        objects = [obj for obj in selected_meshes(context) if cls.is_meant(obj.data)]
        return poll_any_usable(cls, objects, cls.nothing)

    @reporting
    def execute(self, context):
        problems, names, remarks = [], [], []
        meshes = set()
        for obj in selected_meshes(context):
            if obj.data in meshes or not self.is_meant(obj.data):
                continue
            meshes.add(obj.data)
            try:
                mesh_bridge.check_usable(obj)
                with settings_kept([obj.data]):
                    remark = self.change(obj)
            except CubicCraftError as error:
                problems.append(str(error))
            except UNEXPECTED as error:
                # This one has been restored; the others need their undo step.
                _log.exception("%s failed", self.bl_label)
                problems.append(f'"{obj.name}" is unchanged: {in_words(error)}')
            else:
                names.append(obj.name)
                remarks.append(remark)
        texts = [f"{self.done} {', '.join(names)}", *dict.fromkeys(filter(None, remarks))]
        return report_all(self, "; ".join(texts) if names else "", problems)

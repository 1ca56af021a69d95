# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of its own in which meshes are evaluated and baked: that of the artist never changes."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy


class Studio:
    """Objects and settings that are gone when the work is done."""

    def __init__(self, scene: bpy.types.Scene):
        self.scene = scene

    @property
    def view_layer(self) -> bpy.types.ViewLayer:
        """The only one."""
        return self.scene.view_layers[0]

    def take(self, obj: bpy.types.Object) -> bpy.types.Object:
        """Link an object to the scene. Who has made it removes it."""
        self.scene.collection.objects.link(obj)
        return obj

    def evaluated_mesh(self, obj: bpy.types.Object) -> bpy.types.Mesh:
        """Return a new mesh: that of one of its objects, with modifiers."""
        self.view_layer.update()
        depsgraph = self.view_layer.depsgraph
        assert depsgraph is not None  # after the update
        return bpy.data.meshes.new_from_object(
            obj.evaluated_get(depsgraph), preserve_all_data_layers=True, depsgraph=depsgraph
        )

    def context(self, active: bpy.types.Object, *others: bpy.types.Object, **more: Any) -> Any:
        """Return a context manager in which operators see these objects as the selected ones."""
        objects = [active, *others]
        for obj in self.scene.objects:
            obj.select_set(obj in objects, view_layer=self.view_layer)
        self.view_layer.objects.active = active
        return bpy.context.temp_override(
            scene=self.scene,
            view_layer=self.view_layer,
            object=active,
            active_object=active,
            selected_objects=objects,
            selected_editable_objects=objects,
            **more,
        )


@contextmanager
def studio() -> Iterator[Studio]:
    """Make a scene for the duration of the block, at the frame of the present one."""
    now = bpy.context.scene
    scene = bpy.data.scenes.new("CubicCraft")
    try:
        scene.frame_current = now.frame_current
        yield Studio(scene)
    finally:
        bpy.data.scenes.remove(scene)

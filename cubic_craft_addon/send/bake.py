# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles bakes the normals of one surface to the UV map of another near it."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from ...solver import CubicCraftError
from ..mesh_bridge import read_values

_SLACK = 1.05  # rays start this much farther out than the surfaces are apart
_LEAST = 1e-4  # of the largest extent
_SAMPLES = 50_000  # points on each surface at most that are measured


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


def check_cycles() -> None:
    """Raise a CubicCraftError if there is no Cycles."""
    if not hasattr(bpy.types.Scene, "cycles") or not bpy.app.build_options.cycles:
        raise CubicCraftError(
            "normal maps are baked by Cycles: enable the add-on Cycles Render Engine first"
        )


def bake_normals(
    studio: Studio, high: bpy.types.Object, low: bpy.types.Object, image: bpy.types.Image
) -> float:
    """Bake the normals of an object to the tangent space of another.

    `high`, `low`: objects in the studio, the second with a single UV map. `image`: the active image
    of all materials of `low`. Returns how far apart the surfaces are. Raises CubicCraftError:
    Cycles has failed.
    """
    apart = distance(high, low)
    texels: Any = image.size
    scene: Any = studio.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"  # no time is spent on kernels for rays that Blender casts itself
    scene.cycles.samples = 1
    size = max(*high.dimensions)
    extrusion = apart * _SLACK + _LEAST * size
    with studio.context(low, high):
        try:
            done = bpy.ops.object.bake(
                type="NORMAL",
                normal_space="TANGENT",
                target="IMAGE_TEXTURES",
                use_selected_to_active=True,
                use_cage=True,  # of smooth normals: no gaps at hard edges
                cage_extrusion=extrusion,
                max_ray_distance=2 * extrusion,
                margin=max(4, texels[0] // 64),
                use_clear=True,
            )
        except RuntimeError as error:
            reason = str(error).strip().splitlines()[-1].removeprefix("Error: ")
            raise CubicCraftError(f"Cycles cannot bake the normal map: {reason}") from error
    if "FINISHED" not in done:
        raise CubicCraftError("Cycles has not baked the normal map")
    return apart


def distance(high: bpy.types.Object, low: bpy.types.Object) -> float:
    """Return the largest distance of a point of one surface from the other, in the world.

    Vertices, centers of faces of the low-poly one, and at most some thousands of each are measured.
    """
    surfaces = [_surface(obj) for obj in (high, low)]
    trees = [BVHTree.FromPolygons(V.tolist(), F.tolist()) for V, F in surfaces]
    (V_high, _), (V_low, F_low) = surfaces
    points = np.concatenate([V_low, V_low[F_low].mean(axis=1)])
    return max(_farthest(points, trees[0]), _farthest(V_high, trees[1]))


def _surface(obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    mesh: Any = obj.data
    V = read_values(mesh.vertices, "co", width=3)
    mesh.calc_loop_triangles()
    F = read_values(mesh.loop_triangles, "vertices", np.int32, 3)
    matrix = np.array(obj.matrix_world)
    used = np.unique(F)  # loose vertices have no surface
    place = np.zeros(len(V), np.int32)
    place[used] = np.arange(len(used))
    return V[used] @ matrix[:3, :3].T + matrix[:3, 3], place[F]


def _farthest(points: np.ndarray, tree: BVHTree) -> float:
    step = -(-len(points) // _SAMPLES)
    found = (tree.find_nearest(point)[3] for point in points[::step].tolist())
    return max((one for one in found if one is not None), default=0.0)

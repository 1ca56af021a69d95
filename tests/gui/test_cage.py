# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""A half cage under Mirror and Subdivision in Live: what is seen becomes cubic."""

import bmesh
import bpy
import guidrive as gui
import live_scene as scene
import numpy as np


def add_half_cage():
    scene.add_monkey(is_refined=True)
    obj = bpy.context.object
    with gui.in_region():
        bm = bmesh.new()
        bm.from_mesh(obj.data)
        geometry = [*bm.verts, *bm.edges, *bm.faces]
        bmesh.ops.bisect_plane(
            bm, geom=geometry, plane_co=(0, 0, 0), plane_no=(1, 0, 0), clear_outer=True
        )
        bm.to_mesh(obj.data)
        bm.free()
        obj.modifiers.new("Mirror", "MIRROR").use_clip = True
        obj.modifiers.new("Subdivision", "SUBSURF").levels = 2
        bpy.ops.ed.undo_push(message="Halve it")


def share_of_sides():
    """Return the share of what is seen that faces an axis within 8 degrees."""
    mesh = bpy.data.objects[scene.NAME].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    normals, areas = np.empty(3 * len(mesh.polygons)), np.empty(len(mesh.polygons))
    mesh.polygons.foreach_get("normal", normals)
    mesh.polygons.foreach_get("area", areas)
    facing = np.abs(normals.reshape(-1, 3)).max(axis=1) > np.cos(np.radians(8))
    return areas[facing].sum() / areas.sum()


def test():
    gui.simplify_viewport()
    add_half_cage()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    count, before = len(bpy.context.object.data.vertices), share_of_sides()
    yield from gui.screenshot("cage_1_before.png")
    yield from scene.start_live()
    yield from scene.wait_idle()
    assert share_of_sides() > max(0.45, before + 0.2)
    yield from gui.screenshot("cage_2_live.png")
    yield from scene.end_by("RET")
    obj = bpy.data.objects[scene.NAME]
    assert len(obj.data.vertices) == count
    assert [each.type for each in obj.modifiers] == ["MIRROR", "SUBSURF"]
    scene.check_bits_of_cubify()


gui.run(test)

# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""The film of the user guide: a head is sculpted, and its cubic version beside it follows."""

import bpy
import guidrive as gui
import live_scene as scene
import open_sections
from filming import become_cubic, cut, drag, film
from mathutils import Vector

FOLLOWER = f"{scene.NAME} Cubic"
BRUSH = "brushes/essentials_brushes-mesh_sculpt.blend/Brush/Grab"
STEPS = 10
PULLS = (
    ((-0.35, -0.3, 0.9), (-30, 80)),
    ((0.35, -0.3, 0.9), (30, 80)),
    ((0.0, -0.6, -0.95), (0, -60)),
)
"""where the brush grabs, in object space, and how far it goes, in pixels"""


def set_the_stage():
    bpy.context.preferences.system.use_region_overlap = False  # the view ends at the sidebar
    scene.add_monkey(levels=2)
    scene.settings().result = "NEW_OBJECT"
    view = gui.area().spaces.active
    view.shading.light = "MATCAP"
    view.shading.show_cavity = True
    view.overlay.show_overlays = False
    with gui.in_region():
        bpy.ops.object.shade_smooth()
    scene.show_front()
    yield from scene.start_live_beside()
    yield from scene.wait_idle()
    with gui.in_region():
        bpy.ops.view3d.view_all()
        bpy.ops.object.mode_set(mode="SCULPT")
        bpy.ops.brush.asset_activate(
            asset_library_type="ESSENTIALS", relative_asset_identifier=BRUSH
        )
    view.region_3d.view_distance *= 0.62
    yield from scene.wait_idle()


def pull(begin, move):
    """Grab the original, and see the cubic version go along."""
    matrix = bpy.data.objects[scene.NAME].matrix_world
    x, y = map(round, scene.screen_point(matrix @ Vector(begin)))
    steps = range(STEPS + 1)
    yield from drag([(x + move[0] * i // STEPS, y + move[1] * i // STEPS) for i in steps])
    yield from become_cubic()
    yield from film(6)


def test():
    open_sections.as_shipped()
    yield from gui.open_sidebar("Cubic Craft")
    yield from set_the_stage()
    before = scene.positions(FOLLOWER)
    yield from film(6)
    for begin, move in PULLS:
        yield from pull(begin, move)
    assert scene.positions(FOLLOWER) != before
    cut("follow.gif")


gui.run(test)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of docs/user_guide.md: each section of the panel as the artist sees it.

All sections but one are closed by their headers, and the picture is cut out around that one. The
texts that the guide quotes are checked here, too.
"""

import pathlib
import subprocess

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np
from mathutils import Euler

SCALE = 1.5  # of Blender's interface: sharper pictures
HEADER = 20 * SCALE  # pixels from the first row of a section to the middle of its header
PITCH = 25 * SCALE  # pixels between the headers of two closed sections
MARGIN = 8 * SCALE
SECTIONS = {  # in their order: first and last button of each
    "orientation": ("cubic_craft_overlay", "cubic_craft.rotation"),
    "handles": ("cubic_craft.handle_add", "cubic_craft.handle_reset_pose"),
    "map": ("cubic_craft.map_group", "cubic_craft.map_invert"),
    "result": ("cubic_craft.result", "cubic_craft.result"),
    "solver": ("cubic_craft.device", "cubic_craft.tolerance"),
}
CLOSED_AT_FIRST = "solver"


def cut(picture, name, left, bottom, right, top):
    """Save a part of a screenshot; window pixels from the bottom left."""
    width, height = round(right - left), round(top - bottom)
    corner = f"+{round(left)}+{round(gui.window().height - top)}"
    target = pathlib.Path(picture).with_name(name)
    subprocess.run(
        ["convert", picture, "-crop", f"{width}x{height}{corner}", "+repage", str(target)],
        check=True,
    )


def add_monkey():
    """Leave a monkey with two parts to hold and a painted map, all selected and in view."""
    scene.add_monkey(levels=2)
    obj = bpy.data.objects[scene.NAME]
    places = np.frombuffer(scene.positions(), dtype=np.float32).reshape(-1, 3)
    for group, held in (("Chin", places[:, 2] < -0.75), ("Ear", places[:, 0] > 1.05)):
        obj.vertex_groups.new(name=group).add(np.flatnonzero(held).tolist(), 1.0, "REPLACE")
    weights = np.clip((places[:, 2] + 0.6) / 1.2, 0.0, 1.0)
    upper = obj.vertex_groups.new(name="Upper Half")
    for number, weight in enumerate(weights.tolist()):
        upper.add([number], weight, "REPLACE")
    with gui.in_region():
        bpy.ops.object.shade_smooth()
        bpy.ops.ed.undo_push(message="Paint")


def set_the_stage():
    preferences = bpy.context.preferences
    preferences.system.use_region_overlap = False  # the view ends at the sidebar
    preferences.view.ui_scale = SCALE
    with gui.in_region():
        bpy.ops.screen.screen_full_area()
    yield
    add_monkey()
    view = gui.area().spaces.active
    view.shading.light = "MATCAP"
    view.region_3d.view_rotation = Euler((1.25, 0.0, 0.45)).to_quaternion()
    with gui.in_region():
        bpy.ops.view3d.view_selected()
    yield from gui.open_sidebar("Cubic Craft")
    yield from gui.wait_redraw()


def header_of(first):
    """Return the middle of the header above a section's first button."""
    return gui.region("UI").x + round(0.6 * gui.region("UI").width), round(first.top + HEADER)


def close_sections():
    """Close all, from the last on; return where the first header is."""
    point = None
    for name in reversed(SECTIONS):
        if name != CLOSED_AT_FIRST:
            point = header_of((yield from gui.find_button(SECTIONS[name][0])))
            yield from gui.click(point)
            yield from gui.wait_redraw("UI")
    return point


def picture_of(name, first_header):
    """Open a section, take its picture, and close it."""
    x, y = first_header
    header = (x, round(y - list(SECTIONS).index(name) * PITCH))
    yield from gui.click(header)
    yield from gui.wait_redraw("UI")
    first, last = SECTIONS[name]
    top = (yield from gui.find_button(first)).top + HEADER + MARGIN
    bottom = (yield from gui.find_button(last)).bottom - MARGIN
    yield from gui.move_mouse(gui.viewport_point())  # nothing is lit up under it
    picture = yield from gui.screenshot(f"{name}_window.png")
    panel = gui.region("UI")
    cut(picture, f"user_guide_{name}.png", panel.x, bottom, tabs(), top)
    yield from gui.click(header)
    yield from gui.wait_redraw("UI")


def tabs():
    """Return where the tabs begin, to the right of the panels."""
    panel = gui.region("UI")
    return panel.x + panel.width - 21 * SCALE


def picture_of_top(name, first_header):
    """Take a picture of what is above the first header: the section Cubify."""
    yield from gui.move_mouse(gui.viewport_point())
    picture = yield from gui.screenshot(f"{name}_window.png")
    panel = gui.region("UI")
    bottom, top = first_header[1] + PITCH / 2, panel.y + panel.height
    cut(picture, f"user_guide_{name}.png", panel.x, bottom, tabs(), top)


def test():
    yield from set_the_stage()
    header = yield from close_sections()
    yield from picture_of_top("cubify_before", header)
    for name in SECTIONS:
        yield from picture_of(name, header)


gui.run(test)

# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""The pictures of the user guide: each section of the panel as the artist sees it.

`make docs-images` takes them; what is clicked here is clicked by tests in smaller windows as well.
The window is so high that all sections are open at once; each is cut out of a picture of it.
"""
# Window: 1300x3240

import contextlib
import math
import os
import pathlib

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np
from guidrive.pictures import save_screen
from mathutils import Euler
from preset_menu import choose_preset, keep_and_remove

SCALE = 1.5  # of Blender's interface: sharper pictures
MARGIN = 12 * SCALE
PADDING = 4 * SCALE
TABS = 24 * SCALE  # pixels at the right of the sidebar
SECTIONS = {
    # first button of each, and pixels from there to the upper edge of the header
    "shape": ("keep_pose", 94 * SCALE),  # also while Live runs; the form is above
    "orientation": ("cubic_craft_overlay", 33 * SCALE),
    "handles": ("cubic_craft.handle_add", 33 * SCALE),
    "regions": ("cubic_craft.region_add", 33 * SCALE),
    "map": ("cubic_craft.map_group", 38 * SCALE),
    "result": ("cubic_craft.result", 33 * SCALE),
    "animation": ("cubic_craft_animation.use_range", 33 * SCALE),
    "send": ("cubic_craft.send_to", 33 * SCALE),
    "solver": ("cubic_craft.device", 33 * SCALE),
}
LAST = "cubic_craft.tolerance"


def share(name):
    return pathlib.Path(os.environ["GUIDRIVE_SHARE"]) / name


def cut(picture, name, left, bottom, right, top):
    """Save a part of a screenshot; window pixels from the bottom left."""
    whole = bpy.data.images.load(str(picture))
    width, height = whole.size
    pixels = np.empty((height, width, 4), dtype=np.float32)  # from the bottom row up
    whole.pixels.foreach_get(pixels.ravel())
    kept = pixels[max(round(bottom), 0) : round(top), max(round(left), 0) : round(right)]
    part = bpy.data.images.new(name, kept.shape[1], kept.shape[0])
    part.pixels.foreach_set(kept.ravel())
    part.file_format, part.filepath_raw = "PNG", str(share(f"user_guide_{name}.png"))
    part.save()
    for image in (whole, part):
        bpy.data.images.remove(image)


def add_monkey():
    """Leave a monkey with two parts to hold and a painted map."""
    scene.add_monkey(levels=2, is_refined=True)
    obj = bpy.data.objects[scene.NAME]
    places = np.frombuffer(scene.positions(), dtype=np.float32).reshape(-1, 3)
    for group, held in (("Chin", places[:, 2] < -0.75), ("Ear", places[:, 0] > 1.05)):
        obj.vertex_groups.new(name=group).add(np.flatnonzero(held).tolist(), 1.0, "REPLACE")
    upper = obj.vertex_groups.new(name="Upper Half")
    for number, height in enumerate(places[:, 2].tolist()):
        upper.add([number], min(max(height + 0.5, 0.0), 1.0), "REPLACE")
    with gui.in_region():
        bpy.ops.object.shade_smooth()
        bpy.ops.ed.undo_push(message="Paint")


@contextlib.contextmanager
def all_of_the_view():
    """Draw all that an artist sees in the viewport, which most of these pictures do not show.

    In a window of this size, each redraw then takes the better part of a second.
    """
    view = gui.area().spaces.active

    def switch(is_on):
        view.overlay.show_overlays = view.show_gizmo = is_on
        view.shading.show_object_outline = is_on

    switch(True)
    try:
        yield
    finally:
        switch(False)


def set_the_stage():
    preferences = bpy.context.preferences
    preferences.system.use_region_overlap = False  # the view ends at the sidebar
    preferences.view.ui_scale = SCALE
    with gui.in_region():
        bpy.ops.screen.screen_full_area()
    yield from gui.wait_redraw()
    gui.simplify_viewport()
    add_monkey()
    view = gui.area().spaces.active
    view.shading.light = "MATCAP"
    yield from gui.open_sidebar("Cubic Craft")
    view.region_3d.view_rotation = Euler((1.25, 0.0, 0.45)).to_quaternion()
    with gui.in_region():
        bpy.ops.view3d.view_selected()
    yield from gui.wait_redraw()


def open_last():
    """Click on the headers of the last sections, each below the last button that is open."""
    buttons = ("sharp_edges", "bake_animation", "bake_normal_map")
    for button in (f"cubic_craft.{name}" for name in buttons):
        above = yield from gui.find_button(button)
        yield from gui.click((above.at(0.5)[0], round(above.bottom - 20 * SCALE)))
        yield from gui.wait_redraw("UI")


def open_regions():
    """Click on the header between the handles and the map."""
    above = yield from gui.find_button("cubic_craft.handle_reset_pose")
    yield from gui.click((above.at(0.5)[0], round(above.bottom - 22 * SCALE)))
    yield from gui.wait_redraw("UI")


def add_region():
    """Make an octahedron of the upper half."""
    with gui.in_region():
        bpy.ops.cubic_craft.region_add(group="Upper Half")
        bpy.ops.ed.undo_push(message="Region")
    scene.settings().regions[0].form = "OCTAHEDRON"
    yield from gui.wait_redraw("UI")


def whole(name, shows_view=False):
    """Take a picture of the window, with nothing lit up under the mouse."""
    yield from gui.move_mouse(gui.viewport_point(0.1, 0.02))
    if not shows_view:
        return (yield from gui.screenshot(f"{name}_window.png"))
    with all_of_the_view():
        return (yield from gui.smooth_screenshot(f"{name}_window.png"))


def panels():
    """Return the left and the right end of the panels in the sidebar."""
    place = gui.region("UI")
    return place.x, place.x + place.width - TABS


def edge_of(section):
    """Return where the header of a section begins."""
    first, distance = SECTIONS[section]
    return (yield from gui.find_button(first)).top + distance


def pictures_of_sections():
    """Cut each section with its header out of one picture."""
    turn_cube()
    edges = []
    for section in SECTIONS:
        edges.append((yield from edge_of(section)))
    edges.append((yield from gui.find_button(LAST)).bottom - MARGIN)
    left, right = panels()
    picture = yield from whole("sections")
    for name, top, bottom in zip(SECTIONS, edges, edges[1:], strict=False):
        cut(picture, name, left, bottom - PADDING, right, top)


def turn_cube():
    setattr(bpy.context.window_manager, "cubic_craft_overlay", True)  # noqa: B010
    scene.settings().orientation[2] = math.radians(30)


def picture_of_top(name):
    """Take a picture of what is above all sections that can be closed."""
    bottom = (yield from edge_of(next(iter(SECTIONS)))) - PADDING
    left, right = panels()
    place = gui.region("UI")
    cut((yield from whole(name)), name, left, bottom, right, place.y + place.height)


def picture_of_changed():
    """Change a setting since Cubify, and unfold the line on the last run."""
    apply = yield from gui.find_button("cubic_craft.apply")
    line = apply.at(0.5)[0], round(apply.bottom - 16 * SCALE)
    scene.settings().cubeness = 0.25
    yield from gui.click(line)
    yield from gui.wait_redraw("UI")
    yield from picture_of_top("changed")
    yield from gui.click(line)
    yield from gui.wait_redraw("UI")
    scene.settings().cubeness = 0.4


def picture_of_presets():
    """Keep a look under a name, and choose it by its picture."""
    scene.settings().cubeness = 0.6
    yield from keep_and_remove("My_Look", seen_with_all_of_the_view("My_Look"))


def seen_with_all_of_the_view(name):
    """Choose a preset, and cut its menu out of the picture."""
    with all_of_the_view():
        yield from choose_preset(name, SCALE)
    left, _ = panels()
    place = gui.region("UI")
    top = place.y + place.height
    cut(
        share(f"{name}.png"),
        "presets",
        left - 560 * SCALE,
        top - 280 * SCALE,
        gui.window().width,
        top,
    )


def picture_of_redo():
    """Cubify, and open the panel of the last operator by its header."""
    before = scene.positions()
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != before, what="Cubify")
    panel = gui.region("HUD")
    yield from gui.click((panel.x + panel.width // 2, round(panel.y + panel.height - 14 * SCALE)))
    yield from gui.wait_until(lambda: gui.region("HUD").height > 200, what="the open panel")
    picture = yield from whole("redo")
    panel = gui.region("HUD")
    right, top = panel.x + panel.width, panel.y + panel.height
    cut(picture, "redo", panel.x, panel.y, right, top)


def picture_of_live():
    """Take pictures of Live at rest: the section, and its keys in the status bar."""
    yield from scene.start_live()
    yield from scene.wait_idle()
    yield from picture_of_top("live")
    cut(share("live_window.png"), "live_keys", 0, 0, 460 * SCALE, 24 * SCALE)
    yield from scene.end_by("ESC")


def picture_of_map():
    """Cubify with the map, and show its weights."""
    obj = bpy.data.objects[scene.NAME]
    scene.settings().map_group = "Upper Half"
    obj.vertex_groups.active = obj.vertex_groups["Upper Half"]
    with gui.in_region():
        bpy.ops.cubic_craft.cubify(cubeness=0.8)
        bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    picture = yield from whole("map_view", shows_view=True)
    view = gui.region()
    middle, half = view.y + view.height / 2, 0.4 * view.width
    cut(picture, "map_view", view.x, middle - half, view.x + view.width, middle + half)
    with gui.in_region():
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.cubic_craft.restore()


def add_handles():
    """Pin the chin, let the ear follow an empty, and go back to the monkey."""
    monkey = bpy.data.objects[scene.NAME]
    with gui.in_region():
        bpy.ops.cubic_craft.handle_add(group="Chin")
        bpy.ops.cubic_craft.handle_add(group="Ear")
        bpy.ops.cubic_craft.handle_follow()
        bpy.ops.object.select_all(action="DESELECT")
        monkey.select_set(True)
        bpy.context.view_layer.objects.active = monkey
        bpy.ops.ed.undo_push(message="Handles")
    yield from gui.wait_redraw("UI")


def picture_of_message():
    """Make an object active that has no faces."""
    with gui.in_region():
        bpy.ops.object.select_all(action="DESELECT")
        bpy.ops.mesh.primitive_circle_add()
    yield from gui.wait_redraw("UI")
    yield from picture_of_top("message")


def picture_of_preferences():
    """Show the add-ons in the place of the viewport, with ours unfolded."""
    gui.area().ui_type = "PREFERENCES"
    bpy.context.preferences.active_section = "ADDONS"
    bpy.context.window_manager.addon_search = "CubicCraft"
    bpy.ops.preferences.addon_expand(module=scene.EXTENSION)
    yield 2.0
    save_screen("preferences_window.png")
    place = gui.region("WINDOW", "PREFERENCES")
    top = place.y + place.height
    picture = share("preferences_window.png")
    cut(picture, "preferences", place.x, top - 300 * SCALE, place.x + place.width, top)


def test():
    yield from set_the_stage()
    yield from open_last()
    yield from picture_of_redo()
    yield from picture_of_top("cubify")
    yield from picture_of_changed()
    yield from picture_of_presets()
    yield from picture_of_live()
    yield from picture_of_map()
    yield from add_handles()
    yield from add_region()
    yield from open_regions()
    yield from pictures_of_sections()
    yield from picture_of_message()
    yield from picture_of_preferences()


gui.run(test)

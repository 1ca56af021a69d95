# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Bake a normal map by a click, and send the low-poly mesh to a file by the dialog."""
# Window: 1000x1750

import os
import pathlib

import bpy
import guidrive as gui
import live_scene as scene
from guidrive.pictures import save_screen

TRIANGLE, HEADER = 18, 31  # pixels from the lower left corner of the button above
DISTANCE = 21  # pixels from one closed section to the next
LOW, IMAGE = "Suzanne Low", "Suzanne Normal"


def folder():
    return pathlib.Path(os.environ["GUIDRIVE_SHARE"])


def open_section():
    """Click on the header of the section, below those of the result and of the animation."""
    above = yield from gui.find_button("cubic_craft.flatten")
    yield from gui.click((above.left + TRIANGLE, round(above.bottom - HEADER - DISTANCE)))
    yield from gui.wait_redraw("UI")


def by_click():
    """Bake, check what is shown, and take it back by one Ctrl-Z."""
    yield from gui.click((yield from gui.find_button("cubic_craft.bake_normal_map")))
    yield from gui.wait_until(lambda: LOW in bpy.data.objects, what="the normal map")
    low = bpy.data.objects[LOW]
    assert bpy.context.view_layer.objects.active == low
    assert bpy.data.objects[scene.NAME].hide_get() and not low.hide_get()
    assert bpy.data.images[IMAGE].size[0] > 0


def send_by_dialog():
    """Click on the first of the three buttons, and accept the name in the dialog."""
    path = folder() / f"{LOW.replace(' ', '_')}.glb"
    path.unlink(missing_ok=True)
    windows = len(bpy.context.window_manager.windows)
    yield from gui.find_button("cubic_craft.send_to(target='STL'")  # of three with that operator
    yield from gui.click((yield from gui.find_button("cubic_craft.send_to(target='GLTF'")))
    yield from gui.wait_until(
        lambda: any(area.type == "FILE_BROWSER" for area in gui.window().screen.areas),
        what="the file dialog",
    )
    assert len(bpy.context.window_manager.windows) == windows
    browser = gui.area("FILE_BROWSER")
    yield from gui.wait_until(lambda: browser.spaces.active.params is not None, what="the dialog")
    browser.spaces.active.params.directory = str(folder()).encode()
    save_screen("dialog.png")
    with gui.in_region("WINDOW", "FILE_BROWSER"):
        bpy.ops.file.execute("INVOKE_DEFAULT")
    yield from gui.wait_until(path.exists, what="the file")
    assert path.read_bytes()[:4] == b"glTF"
    path.unlink()


def test():
    bpy.context.preferences.view.filebrowser_display_type = "SCREEN"
    gui.simplify_viewport()
    scene.add_monkey(levels=1)
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != original, what="Cubify")
    cubic = scene.positions()
    yield from open_section()
    yield from gui.screenshot("opened.png")
    yield from by_click()
    yield from send_by_dialog()
    yield from gui.screenshot("sent.png")
    yield from gui.undo()
    assert LOW not in bpy.data.objects, "one step of undo takes back the whole bake"
    assert not bpy.data.objects[scene.NAME].hide_get() and scene.positions() == cubic
    yield from gui.screenshot("undone.png")


gui.run(test)

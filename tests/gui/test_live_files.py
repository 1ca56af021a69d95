# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Files saved, loaded and begun while Live runs, and the extension switched off and on."""

import os
import pathlib
import shutil

import bpy
import guidrive as gui
import live_scene as scene

FOLDER = pathlib.Path(os.environ["GUIDRIVE_SHARE"])
PATH, COPY, OTHER = (str(FOLDER / f"{name}.blend") for name in ("saved", "copy", "other"))


def saved_at():
    return pathlib.Path(PATH).stat().st_mtime_ns


def goes_on():
    assert scene.live().current() is not None
    assert "CUBIC_CRAFT_OT_live" in gui.running_operators()


def open_file(path):
    bpy.ops.wm.open_mainfile(filepath=path)
    yield from gui.wait_until(lambda: bpy.data.filepath == path, what=path)
    yield from gui.wait_redraw()


def saved(original):
    """Ctrl-S: the file holds what is seen, and Live goes on with that."""
    for is_at_rest in (False, True):
        yield from scene.start_live()
        if is_at_rest:
            yield from scene.wait_idle()
        shown = scene.positions()
        before = saved_at()
        yield from scene.press("CTRL+S")
        yield from gui.wait_until(lambda b=before: saved_at() != b, what="the file")
        goes_on()
        yield from scene.wait_idle_with(lambda: scene.positions() != original, "the preview")
        if is_at_rest:
            assert scene.positions() == shown
        shutil.copy(PATH, COPY)  # Blender crashes when it loads from the file that is open
        with bpy.data.libraries.load(COPY) as (_, wanted):
            wanted.meshes = [scene.NAME]
        read = wanted.meshes[0]
        obj = bpy.data.objects.new("Read", read)
        assert scene.positions("Read") != original, "what was seen is not in the file"
        assert scene.positions("Read") == shown or not is_at_rest
        assert not [a.name for a in read.attributes if a.name.startswith("cubic_craft_live")]
        bpy.data.objects.remove(obj)
        bpy.data.meshes.remove(read)
        goes_on()
        yield from scene.end_by("RET" if is_at_rest else "ESC")
    assert scene.positions() != original
    scene.check_bits_of_cubify()


def saved_and_opened(original):
    """Open the file while Live runs: it ends, and the artist has what was saved."""
    for is_at_rest in (False, True):
        yield from open_file(PATH)
        yield from gui.open_sidebar("Cubic Craft")
        yield from scene.start_live()
        if is_at_rest:
            yield from scene.wait_idle()
        shown = scene.positions()
        before = saved_at()
        yield from scene.press("CTRL+S")
        yield from gui.wait_until(lambda b=before: saved_at() != b, what="the file")
        yield from open_file(PATH)
        scene.check_clean()
        assert scene.positions() != original
        assert scene.positions() == shown or not is_at_rest
        yield from gui.screenshot("opened.png")
        with gui.in_region():
            bpy.ops.cubic_craft.restore()
        assert scene.positions() == original
        bpy.ops.wm.save_as_mainfile(filepath=PATH)


def another_file(original):
    """Another file, also one that was written behind the back of Live, as by a crash."""
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live()
    yield from scene.wait_idle()
    shown = scene.positions()
    bpy.data.libraries.write(OTHER, {bpy.context.scene}, fake_user=True)
    goes_on()
    yield from open_file(OTHER)
    scene.check_clean()
    assert scene.positions() == shown != original, "what a crash has left is not what was seen"
    with gui.in_region():
        bpy.ops.cubic_craft.restore()
    assert scene.positions() == original, "nor is its original there"
    yield from open_file(PATH)
    scene.check_clean()
    assert scene.positions() == original


def new_file(_original):
    """Ctrl-N, and a click on General."""
    yield from gui.open_sidebar("Cubic Craft")
    for is_at_rest in (False, True):
        scene.add_monkey()
        yield from scene.start_live()
        if is_at_rest:
            yield from scene.wait_idle()
        yield from scene.press("CTRL+N")
        yield from gui.screenshot("new_file.png")
        yield from gui.keys("RET")
        yield from gui.wait_until(lambda: "Cube" in bpy.data.objects, what="the new file")
        yield from gui.wait_redraw()
        scene.check_clean()
        assert scene.NAME not in bpy.data.objects
        yield from gui.open_sidebar("Cubic Craft")


def switched_off(_original):
    """Live ends at once, and works again once the extension is back."""
    scene.add_monkey()
    original = scene.positions()
    for is_at_rest in (False, True):
        yield from scene.start_live()
        if is_at_rest:
            yield from scene.wait_idle()
        bpy.ops.preferences.addon_disable(module=scene.EXTENSION)
        assert scene.positions() != original
        assert not hasattr(bpy.types.WindowManager, "cubic_craft_live")
        header = bpy.types.STATUSBAR_HT_header
        assert header.draw is getattr(header, "_draw_orig", header.draw), "a status text is left"
        for _ in range(10):
            yield
        yield from scene.press("RET", "ESC")
        yield from gui.wait_redraw()
        assert "CUBIC_CRAFT_OT_live" not in gui.running_operators()
        yield from gui.screenshot("switched_off.png")
        bpy.ops.preferences.addon_enable(module=scene.EXTENSION)
        yield from gui.wait_redraw()
        yield from gui.open_sidebar("Cubic Craft")
        scene.check_clean()
        with gui.in_region():
            bpy.ops.cubic_craft.restore()
        assert scene.positions() == original
    yield from scene.start_live()
    yield from scene.end_by("RET")
    scene.check_bits_of_cubify()


def test():
    gui.simplify_viewport()
    scene.add_monkey()
    original = scene.positions()
    bpy.ops.wm.save_as_mainfile(filepath=PATH)
    yield from gui.open_sidebar("Cubic Craft")
    for moment in (saved, saved_and_opened, another_file, new_file, switched_off):
        gui.log(moment.__name__)
        yield from moment(original)
        scene.check_clean()


gui.run(test)

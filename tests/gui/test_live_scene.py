# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""What the artist does to the live object and around it ends Live cleanly or lets it go on."""

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np


def goes_on():
    assert scene.live().current() is not None
    assert "CUBIC_CRAFT_OT_live" in gui.running_operators()


def deleted(original):
    """By X and Return, which must not confirm; undo brings the object back as it was."""
    for is_at_rest in (False, True):
        yield from scene.start_live()
        if is_at_rest:
            yield from scene.wait_idle()
        yield from scene.press("X")
        yield from gui.screenshot("delete.png")
        yield from gui.keys("RET")
        yield from scene.wait_over()
        assert scene.NAME not in bpy.data.objects
        yield from gui.undo()
        assert scene.positions() == original
        scene.check_clean()


def renamed(original):
    """F2, a name, Return: Live goes on with the object of that name."""
    yield from scene.start_live()
    yield from scene.press("F2")
    yield from gui.keys("CTRL+A")
    yield from gui.type_text("other")
    yield from gui.screenshot("rename.png")
    yield from gui.keys("RET")
    yield from gui.wait_until(lambda: "other" in bpy.data.objects, what="the new name")
    goes_on()
    bpy.data.objects["other"].data.name = "Mesh"
    yield from scene.wait_idle()
    goes_on()
    yield from scene.end_by("RET")
    assert scene.positions("other") != original
    scene.check_bits_of_cubify("other")
    with gui.in_region():
        bpy.ops.cubic_craft.restore()
        bpy.data.objects["other"].name = scene.NAME
        bpy.ops.ed.undo_push(message="Name it as before")
    assert scene.positions() == original


def hidden(original):
    """H and Alt-H: Live goes on, and Esc works as ever."""
    for end in ("ESC", "RET"):
        yield from scene.start_live()
        yield from scene.wait_idle()
        yield from scene.press("H")
        yield from gui.wait_until(
            lambda: bpy.data.objects[scene.NAME].hide_get(), what="the object to be hidden"
        )
        yield from scene.wait_settled()
        yield from gui.screenshot(f"hidden_{end}.png")
        yield from scene.press(end)
        for _ in range(10):
            yield
        yield from scene.wait_settled()
        assert scene.is_over()
        scene.check_clean()
        yield from scene.press("ALT+H")
        yield from gui.wait_until(
            lambda: not bpy.data.objects[scene.NAME].hide_get(), what="the object to be shown"
        )
        assert (scene.positions() == original) == (end == "ESC")
        with gui.in_region():
            if end == "RET":
                scene.check_bits_of_cubify()
                bpy.ops.cubic_craft.restore()
            bpy.data.objects[scene.NAME].select_set(True)
            bpy.context.view_layer.objects.active = bpy.data.objects[scene.NAME]
            bpy.ops.ed.undo_push(message="As before")
        assert scene.positions() == original


def last_report():
    """Return the last line that Blender has for the artist, as its Info editor copies it."""
    area = max(bpy.context.screen.areas, key=lambda area: area.type == "OUTLINER")
    before = area.ui_type
    area.ui_type = "INFO"
    try:
        with bpy.context.temp_override(area=area, region=area.regions[-1]):
            bpy.ops.info.select_all(action="SELECT")
            bpy.ops.info.report_copy()
    finally:
        area.ui_type = before
    lines = [line for line in bpy.context.window_manager.clipboard.splitlines() if line.strip()]
    return lines[-1] if lines else ""


def edited(original):
    """Tab into Edit Mode and back, once while it works and once at rest: as Enter and then Tab."""
    confirmed = set()
    for is_at_rest in (False, True):
        yield from scene.start_live()
        if is_at_rest:
            yield from scene.wait_idle()
        yield from scene.press("TAB")
        yield from gui.wait_until(lambda: bpy.context.mode == "EDIT_MESH", what="Edit Mode")
        yield from scene.wait_over()
        yield from gui.wait_until(lambda: "Live has ended" in last_report(), what="a word of it")
        assert "the mode was changed" in last_report()
        yield from gui.screenshot("edit_mode.png")
        yield from scene.press("TAB")
        yield from gui.wait_until(lambda: bpy.context.mode == "OBJECT", what="Object Mode")
        confirmed.add(scene.positions())
        assert original not in confirmed
        scene.check_clean()
        yield from gui.undo()  # the two modes
        yield from gui.undo()
        assert {scene.positions()} == confirmed and bpy.context.mode == "OBJECT"
        yield from gui.undo()  # Live, into Edit Mode, where it has ended
        yield from gui.undo()
        assert scene.positions() == original and bpy.context.mode == "OBJECT"
        scene.check_clean()
    assert len(confirmed) == 1, "not finished as after Enter"


def selected_another(original):
    """Click another mesh: Live ends as after Enter, and that mesh is selected."""
    with gui.in_region():
        bpy.ops.mesh.primitive_cube_add(size=0.8, location=(-2.0, 0, 0))
        cube = bpy.context.object
        cube.select_set(False)
        bpy.data.objects[scene.NAME].select_set(True)
        bpy.context.view_layer.objects.active = bpy.data.objects[scene.NAME]
        bpy.ops.ed.undo_push(message="Add a cube")
        bpy.ops.view3d.view_all()
    name = cube.name
    yield from gui.wait_redraw()
    yield from scene.start_live()
    yield from scene.wait_idle()
    shown = scene.positions()
    yield from gui.click(scene.screen_point(bpy.data.objects[name].location))
    yield from scene.wait_over()
    assert bpy.context.view_layer.objects.active == bpy.data.objects[name]
    assert scene.positions() == shown != original
    assert "another mesh" in last_report()
    yield from gui.screenshot("another_mesh.png")
    yield from gui.undo()
    assert scene.positions() == original
    with gui.in_region():
        bpy.data.objects.remove(bpy.data.objects[name])
        bpy.data.objects[scene.NAME].select_set(True)
        bpy.context.view_layer.objects.active = bpy.data.objects[scene.NAME]
        bpy.ops.ed.undo_push(message="As before")
    scene.show_front()


def sculpted(original):
    """Go to Sculpt Mode, which ends Live: the strokes are on the shape that was seen."""
    yield from scene.start_live()
    with gui.in_region():
        bpy.ops.object.mode_set(mode="SCULPT")
        bpy.ops.ed.undo_push(message="Sculpt Mode")
    yield from scene.wait_over()
    cubic = scene.positions()
    assert cubic != original and bpy.context.mode == "SCULPT"
    yield from gui.screenshot("sculpt_mode.png")
    with gui.in_region():
        has_brush = bpy.ops.sculpt.brush_stroke.poll()
    if has_brush:  # there is none in Debian's Blender 4.3
        x, y = scene.screen_point((0, -1, 0.6))
        yield from gui.drag((x - 20, y), (x + 20, y))
        yield from gui.wait_until(lambda: scene.positions() != cubic, what="a stroke")
        yield from gui.screenshot("sculpted.png")
        moved = np.frombuffer(scene.positions(), np.float32) != np.frombuffer(cubic, np.float32)
        assert moved.mean() < 0.4, "the stroke has moved more than what is near it"
        yield from gui.undo()
        assert scene.positions() == cubic
    with gui.in_region():
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.ed.undo_push(message="Object Mode")
    # In Blender a button that the mouse is on stays grey until the mouse has left it.
    yield from gui.move_mouse(gui.viewport_point())
    yield from gui.wait_redraw("UI")
    assert scene.positions() == cubic
    restore(original)


def restore(original):
    with gui.in_region():
        bpy.ops.cubic_craft.restore()
        bpy.ops.ed.undo_push(message="Restore")
    assert scene.positions() == original
    scene.check_clean()


def other_scene(original):
    """Live ends as after Enter where its object is not in the scene that is shown."""
    other = bpy.data.scenes.new("Other")
    first = gui.window().scene
    for is_at_rest in (False, True):
        yield from scene.start_live()
        if is_at_rest:
            yield from scene.wait_idle()
        gui.window().scene = other
        yield from scene.wait_over()
        yield from gui.screenshot("other_scene.png")
        gui.window().scene = first
        yield from gui.wait_redraw()
        assert scene.positions() != original
        restore(original)
    bpy.data.scenes.remove(other)


def other_workspace(original):
    """Live ends as after Enter, also where Blender changes the mode along."""
    first = gui.window().workspace.name
    for name, mode in (("Scripting", "OBJECT"), ("Modeling", "EDIT_MESH")):
        yield from scene.start_live()
        gui.window().workspace = bpy.data.workspaces[name]
        yield from gui.wait_until(lambda n=name: gui.window().workspace.name == n)
        yield from scene.wait_over()
        assert bpy.context.mode == mode
        yield from gui.screenshot(f"{name}.png")
        gui.window().workspace = bpy.data.workspaces[first]
        yield from gui.wait_until(lambda: bpy.context.mode == "OBJECT", what="Object Mode")
        yield from gui.wait_redraw()
        assert scene.positions() != original
        scene.check_bits_of_cubify()
        restore(original)


def test():
    gui.simplify_viewport()
    scene.add_monkey()
    scene.show_front()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    moments = (
        deleted,
        renamed,
        hidden,
        edited,
        selected_another,
        sculpted,
        other_scene,
        other_workspace,
    )
    for moment in moments:
        gui.log(moment.__name__)
        yield from moment(original)
        scene.check_clean()


gui.run(test)

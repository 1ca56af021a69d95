# SPDX-License-Identifier: GPL-3.0-or-later
"""Live: watch, drag the slider, confirm as one undo step that equals Cubify; cancel."""

import bpy
import guidrive as gui
import live_scene as scene


def test():
    scene.add_monkey(is_refined=True)
    before = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live()
    yield from gui.screenshot("live.png")
    slider = yield from gui.find_button("cubic_craft_live.cubeness")
    yield from gui.drag_slider(slider, 0.3, 0.8)
    cubeness = bpy.context.window_manager.cubic_craft_live.cubeness
    assert cubeness > 0.45, cubeness
    yield from scene.wait_idle()
    yield from gui.screenshot("live_converged.png")

    yield from scene.press("RET")
    yield from gui.wait_until(scene.is_over, what="the end")
    scene.check_clean()
    confirmed = scene.positions()
    assert confirmed != before
    yield from gui.screenshot("confirmed.png")

    yield from gui.undo()
    assert scene.positions() == before, "one undo step takes Live back"
    assert scene.settings().cubeness != cubeness

    scene.settings().cubeness = cubeness
    button = yield from gui.find_button("cubic_craft.cubify")
    yield from gui.click(button)
    yield from gui.wait_until(lambda: scene.positions() != before, what="Cubify")
    assert scene.positions() == confirmed, "Live leaves other bits than Cubify"

    yield from scene.start_live()
    # Whatever is active, the panel stays that of Live, with its buttons.
    bpy.context.view_layer.objects.active = None
    yield from gui.click((yield from gui.find_button("cubic_craft.live_cancel")))
    yield from gui.wait_until(scene.is_over, what="the end")
    assert scene.positions() == confirmed, "cancelling leaves other bits than before"
    scene.check_clean()


gui.run(test)

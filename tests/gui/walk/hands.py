# SPDX-License-Identifier: GPL-3.0-or-later
"""What hands do without looking: keys, clicks and drags anywhere."""

import bpy
import guidrive as gui
import live_scene as scene

from .actions import action, call, is_live, is_on

_TAB = "Cubic Craft"
_MARGIN = 12  # pixels from the edge of a region, which would be dragged itself
_CLOSED_PANEL = 60  # pixels; the panel of the last operator is lower while only its header shows


def close_popups():
    """Leave menus, fields and reports, without the Esc that cancels Live: that is a viewport's."""
    place = gui.region("WINDOW", "OUTLINER")
    yield from gui.move_mouse((place.x + place.width // 2, place.y + 20))
    yield from gui.keys("ESC")


@action(10, goes_back=True)
def undo(rng):
    count = rng.choice([1, 1, 2, 5])
    yield from scene.press(*["CTRL+Z"] * count)
    return str(count)


@action(5, goes_back=True)
def redo(rng):
    count = rng.choice([1, 1, 3])
    yield from scene.press(*["CTRL+SHIFT+Z"] * count)
    return str(count)


@action(3)
def confirm_live(rng):
    if not is_live():
        return None
    key = rng.choice(["RET", "NUMPAD_ENTER"])
    yield from scene.press(key)
    session = scene.live().current()
    if session is not None:
        yield from gui.wait_until(
            lambda: not (is_live() and session.is_finishing), what="the end of Live"
        )
        assert not is_live() or session.all_problems, "Live goes on and does not say why"
    return key


@action(1.5)
def escape(_rng):
    if not is_live():
        return None
    yield from scene.press("ESC")
    return "Esc"


@action(3)
def tab_key(_rng):
    yield from scene.press("TAB")
    return "pressed"


@action(1)
def arrow_key(rng):
    key = rng.choice(["LEFT_ARROW", "RIGHT_ARROW", "UP_ARROW"])
    yield from scene.press(key)
    return key


@action(2, reshapes=True)
def grab(rng):
    """Press G, move, and click, or think better of it."""
    yield from scene.press("G")
    yield from gui.move_mouse(gui.viewport_point(rng.uniform(0.3, 0.5), rng.uniform(0.3, 0.6)))
    if rng.random() < 0.3:
        yield from gui.keys("ESC")
        return "moved and cancelled"
    yield from gui.click(gui.viewport_point(rng.uniform(0.3, 0.5), rng.uniform(0.3, 0.6)))
    return "moved"


@action(2)
def click_viewport(rng):
    x, y = gui.viewport_point(rng.uniform(0.1, 0.6), rng.uniform(0.1, 0.9))
    panel = gui.region("HUD")  # of the last operator, such as Add Grid, which may make other faces
    if 0 <= x - panel.x < panel.width and 0 <= y - panel.y < panel.height:
        return None
    yield from gui.click((x, y))
    return str((x, y))


@action(2, reshapes=True)
def drag_viewport(rng):
    """Drag: a selection box, or a stroke in the modes that paint and sculpt."""
    start, end = (
        gui.viewport_point(rng.uniform(0.15, 0.6), rng.uniform(0.15, 0.8)) for _ in range(2)
    )
    yield from gui.drag(start, end, 4)
    return f"{start} to {end}"


@action(1)
def orbit(rng):
    start = gui.viewport_point()
    end = (start[0] + rng.randrange(-80, 80), start[1] + rng.randrange(-60, 60))
    yield from gui.drag(start, end, 4, "MIDDLEMOUSE")
    return "orbited"


def _point_in(region, rng):
    return (
        rng.randrange(region.x + _MARGIN, region.x + region.width - _MARGIN),
        rng.randrange(region.y + _MARGIN, region.y + region.height - _MARGIN),
    )


def _show_sidebar():
    side = gui.region("UI")
    if side.width <= 1 or side.active_panel_category != _TAB:
        yield from gui.open_sidebar(_TAB)
    return gui.region("UI")


@action(8)
def click_panel(rng):
    """Click somewhere in the panel: buttons, menus, fields, headers, tabs."""
    if not is_on() or not bpy.data.objects:
        return None
    side = yield from _show_sidebar()
    point = _point_in(side, rng)
    yield from gui.move_mouse(point)
    text = gui.button_under_mouse()
    yield from gui.click(point, rng.choice(["LEFTMOUSE", "LEFTMOUSE", "LEFTMOUSE", "RIGHTMOUSE"]))
    return f"{point} {text}"


@action(5)
def drag_panel(rng):
    """Drag somewhere in the panel: sliders."""
    if not is_on() or not bpy.data.objects:
        return None
    side = yield from _show_sidebar()
    start = _point_in(side, rng)
    yield from gui.move_mouse(start)
    text = gui.button_under_mouse()
    yield from gui.drag(start, (_point_in(side, rng)[0], start[1]), 4)
    return f"{start} {text}"


@action(2)
def scroll_panel(rng):
    if not is_on():
        return None
    side = yield from _show_sidebar()
    yield from gui.move_mouse((side.x + side.width // 2, side.y + side.height // 2))
    yield from gui.turn_wheel(rng.choice(["WHEELUPMOUSE", "WHEELDOWNMOUSE"]), 3)
    return "scrolled"


@action(4, goes_back=True)
def redo_panel(rng):
    """Cubify, then click or drag somewhere in the panel of the last operator."""
    if not is_on() or (done := call("cubic_craft.cubify", "INVOKE_DEFAULT")) is None:
        return None
    yield from gui.wait_redraw()
    place = gui.region("HUD")
    if not done.endswith("FINISHED") or place.width <= 1:
        return f"{done}, no panel"
    if place.height < _CLOSED_PANEL:
        header = (place.x + place.width // 2, place.y + place.height - _MARGIN)
        yield from gui.click(header)
        yield from gui.wait_redraw()
        place = gui.region("HUD")
    for _ in range(2):
        start = _point_in(place, rng)
        yield from gui.drag(start, (_point_in(place, rng)[0], start[1]), rng.choice([1, 4]))
        yield from close_popups()
    return f"{start} of {place.width} x {place.height}"

# SPDX-License-Identifier: GPL-3.0-or-later
"""Finding buttons: Blender tells no script where they are, so the mouse feels its way."""

import dataclasses

import bpy

from . import places
from .events import events
from .pointing import move_mouse, turn_wheel
from .screen import Button, area, in_region, region
from .waiting import wait_redraw, wait_until

SCAN_STEP = 12  # pixels; a row of buttons is 20 high
_ASIDE = 3  # pixels; beyond the edge of a button, where the mouse has left it
_TRIES = 5
_CUT_OFF = 8  # pixels; what is lower is cut off by the edge of the region, and is scrolled to
_NEAR = 160  # pixels; what the panel gains or loses above a button moves it by less

_passed = {}  # text of a button: region, a point on it, how far the region was scrolled then


def open_sidebar(tab):
    """Open the viewport's sidebar at a tab (a panel's bl_category) and wait until it is drawn."""
    area().spaces.active.show_region_ui = True
    yield from wait_until(lambda: region("UI").width > 1, what="the sidebar")

    def tab_is_active():
        try:
            region("UI").active_panel_category = tab
        except (AttributeError, TypeError):  # no such tab: not drawn yet
            return False
        return region("UI").active_panel_category == tab

    area().tag_redraw()
    yield from wait_until(tab_is_active, what=f"sidebar tab {tab!r}")
    yield from wait_redraw("UI")


def button_under_mouse(region_type="UI", area_type="VIEW_3D"):
    """Return the text of the button under the mouse, as Blender's context menu would copy it.

    That is "bpy.ops.my_extension.run()" for an operator, for a property its full data path such as
    'bpy.data.scenes["Scene"].my_extension.strength', and "" where there is no such button.
    Overwrites Blender's clipboard.
    """
    manager = bpy.context.window_manager
    with in_region(region_type, area_type):
        manager.clipboard = ""
        copy_call = bpy.ops.ui.copy_python_command_button
        copy_path = bpy.ops.ui.copy_data_path_button
        if copy_call.poll():  # pyright: ignore[reportCallIssue] - the stubs take it for unbound
            copy_call()
        if not manager.clipboard and copy_path.poll():  # pyright: ignore[reportCallIssue]
            copy_path(full_path=True)
    return manager.clipboard


def find_button(target, region_type="UI", area_type="VIEW_3D"):
    """Find a button by operator id ("my_extension.run") or end of its data path ("obj.strength").

    Of an operator that has several buttons, an argument tells which: "my_extension.run(mode='A'".
    The mouse looks where it was found before, then where it was passed in search of others, then
    above and below the former, then it walks over the region, which is scrolled if need be.
    Returns a Button; raises LookupError with the buttons that were met. Closed panels and pop-ups
    are not searched.
    """
    met = {}
    where = region(region_type, area_type)
    key = f"{area_type} {region_type} {where.width}x{where.height} {target}"

    def matches(text):
        return _is_of(text, target)

    def found(button):
        return dataclasses.replace(
            button, target=target, region_type=region_type, area_type=area_type
        )

    for place in places.known(key):
        button = yield from _look_at(place, matches, region_type, area_type)
        if button:
            return found(button)
    button = yield from _look_where_passed(matches, region_type, area_type)
    for place in places.known(key)[:2]:
        button = button or (yield from _look_near(place, matches, region_type, area_type))
    for thorough in (False, True):
        if not button:
            button = yield from _scan(matches, met, region_type, area_type, thorough)
        for wheel in ("WHEELUPMOUSE", "WHEELDOWNMOUSE"):
            while not button and (yield from _scroll(wheel, region_type, area_type)):
                button = yield from _scan(matches, met, region_type, area_type, thorough)
        if button:
            edges = button.left, button.bottom, button.right, button.top
            places.remember(key, [*edges, _scrolled(region_type, area_type)])
            return found(button)
    raise LookupError(f"no button {target!r}; met: {list(met)}")


def reach(button, across=0.5):
    """Move the mouse onto a Button, at this fraction of its width, until Blender says it is there.

    A press anywhere else would be lost: the panel may have moved since the button was found, and
    what has been grey under the mouse takes no press before the mouse has left it. Returns the
    Button where it is now.
    """
    for _ in range(_TRIES):
        x, y = button.at(across)
        if button.has(events().x, events().y):
            yield from move_mouse((x, button.top + _ASIDE))
        yield from move_mouse((x, y))
        if not button.target:
            return button
        text = button_under_mouse(button.region_type, button.area_type)
        if _is_of(text, button.target):
            return button
        if button.area_type == "VIEW_3D":
            yield from wait_redraw()
        where = button.region_type, button.area_type
        button = yield from find_button(button.target, *where)
    raise LookupError(f"no button {button.target!r} stays under the mouse, but {text!r}")


def _is_of(text, target):
    """Return whether a button is the one that find_button is asked for."""
    operator, _, argument = target.partition("(")
    is_call = text.startswith(f"bpy.ops.{operator}(") and argument in text
    return is_call or f".{text}".endswith(f".{target}")


def _hover(x, y, region_type, area_type):
    """Move the mouse and return the text of the button there."""
    yield from move_mouse((x, y))
    return button_under_mouse(region_type, area_type)


def _look_at(place, matches, region_type, area_type):
    """Return the Button at a place where it was before; None if it is not there, or narrower."""
    *edges, height = place
    button = Button("", *edges)
    if button.top - button.bottom < _CUT_OFF:
        return None
    if not (yield from _scroll_to(height, region_type, area_type)):
        return None
    texts = []
    for across in (0.5, 0.02, 0.98):
        texts.append((yield from _hover(*button.at(across), region_type, area_type)))
        if not matches(texts[-1]):
            return None
    x = button.at()[0]
    for y in (button.bottom - 3, button.top + 3):  # or the panel has moved by some pixels
        if (yield from _hover(x, y, region_type, area_type)) == texts[0]:
            return None
    return Button(texts[0], *edges)


def _look_near(place, matches, region_type, area_type):
    """Return the Button if it is somewhat above or below a place where it was before, or None."""
    left, bottom, right, top, height = place
    yield from _scroll_to(height, region_type, area_type)
    where, x = region(region_type, area_type), (left + right) // 2
    for distance in range(SCAN_STEP, _NEAR, SCAN_STEP):
        for y in ((bottom + top) // 2 + distance, (bottom + top) // 2 - distance):
            if not where.y < y < where.y + where.height:
                continue
            text = yield from _hover(x, y, region_type, area_type)
            if matches(text):
                button = yield from _measure(text, x, y, region_type, area_type)
                return button if button.top - button.bottom >= _CUT_OFF else None
    return None


def _look_where_passed(matches, region_type, area_type):
    """Return the Button if the mouse has passed it before and it is still there, or None."""
    for passed, (where, x, y, height) in list(_passed.items()):
        if matches(passed) and where == (region_type, area_type):
            yield from _scroll_to(height, region_type, area_type)
            text = yield from _hover(x, y, region_type, area_type)
            if matches(text):
                return (yield from _measure(text, x, y, region_type, area_type))
    return None


def _scroll_to(height, region_type, area_type):
    """Scroll the region as it was; return whether that is possible."""
    upwards = height > _scrolled(region_type, area_type)
    wheel, sign = ("WHEELUPMOUSE", 1) if upwards else ("WHEELDOWNMOUSE", -1)
    while sign * (height - _scrolled(region_type, area_type)) > 0:
        if not (yield from _scroll(wheel, region_type, area_type, steps=1)):
            return False
    return True


def _scan(matches, met, region_type, area_type, thorough):
    """Walk the mouse down the region until it meets the button.

    Unless thorough, it looks to the left and right only in rows that have a button on the way.
    """
    place = region(region_type, area_type)
    columns = [place.x + int(across * place.width) for across in (0.52, 0.37, 0.75, 0.12, 0.83)]
    rows = range(place.y + place.height - 4, place.y, -SCAN_STEP)
    if place.width > 4 * place.height:  # a header: one row of small buttons
        columns = range(place.x + SCAN_STEP, place.x + place.width, SCAN_STEP)
        rows = [place.y + place.height // 2]
        thorough = True
    last = ""
    for y in rows:
        for x in columns:
            text = yield from _hover(x, y, region_type, area_type)
            if text:
                met[text] = True
                height = _scrolled(region_type, area_type)
                _passed[text] = ((region_type, area_type), x, y, height)
            if matches(text):
                button = yield from _measure(text, x, y, region_type, area_type)
                return button if button.top - button.bottom >= _CUT_OFF else None
            if x == columns[0]:
                is_new_row, last = text not in ("", last), text
                if not (is_new_row or thorough):
                    break
    return None


def _measure(text, x, y, region_type, area_type):
    """Return the Button with this text around a point."""

    def edge(inside, outside, hover_at):
        while abs(outside - inside) > 1:
            middle = (inside + outside) // 2
            if (yield from hover_at(middle)) == text:
                inside = middle
            else:
                outside = middle
        return inside

    def row(hover_x):
        return _hover(hover_x, y, region_type, area_type)

    def column(hover_y):
        return _hover(x, hover_y, region_type, area_type)

    place = region(region_type, area_type)
    left = yield from edge(x, place.x - 1, row)
    right = yield from edge(x, place.x + place.width, row)
    bottom = yield from edge(y, place.y - 1, column)
    top = yield from edge(y, place.y + place.height, column)
    return Button(text, left, bottom, right, top)


def _scrolled(region_type, area_type):
    """Return how high up the region has been scrolled."""
    return region(region_type, area_type).view2d.region_to_view(0, 0)[1]


def _scroll(wheel, region_type, area_type, steps=8):
    """Turn the mouse wheel some steps; tell whether the region has scrolled."""
    place = region(region_type, area_type)
    before = _scrolled(region_type, area_type)
    yield from move_mouse((place.x + place.width // 2, place.y + place.height // 2))
    yield from turn_wheel(wheel, steps)
    yield from wait_redraw()
    return _scrolled(region_type, area_type) != before

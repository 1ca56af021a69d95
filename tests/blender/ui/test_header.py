# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify and Live are in the header while the panel is scrolled; a window shows that it follows."""

from types import SimpleNamespace

import bpy
import pytest
from recorder import Recorder
from scene import add_monkey, cubify

TAB = "Cubic Craft"


class View:
    """A sidebar's view, scrolled down by some pixels."""

    def __init__(self, scrolled):
        self.scrolled = scrolled

    def region_to_view(self, x, y):
        return x, y - 600 - self.scrolled


def viewport(scrolled=500, width=300, tab=TAB, header="TOOL_HEADER", has_tool_header=True):
    """Return a context of a viewport's header."""
    sidebar = SimpleNamespace(
        type="UI", width=width, height=600, active_panel_category=tab, view2d=View(scrolled)
    )
    return SimpleNamespace(
        area=SimpleNamespace(regions=[sidebar], as_pointer=lambda: 1),
        region=SimpleNamespace(type=header),
        space_data=SimpleNamespace(show_region_tool_header=has_tool_header),
        preferences=bpy.context.preferences,
        active_object=bpy.context.active_object,
        view_layer=bpy.context.view_layer,
    )


@pytest.fixture
def header(part, monkeypatch):
    module = part("ui.header")
    monkeypatch.setattr(module, "_tab", TAB)
    yield module
    module._drawn.clear()


@pytest.fixture
def drawn(header):
    """Return a function that draws a header and returns its operators with their texts."""

    def draw(**where):
        owner = SimpleNamespace(layout=Recorder())
        header._draw(owner, viewport(**where))
        return owner.layout.operators

    return draw


BUTTONS = {"cubic_craft.cubify": "Cubify", "cubic_craft.live": "Live"}


def test_they_are_in_the_header_while_the_panel_is_scrolled(drawn):
    assert drawn() == {}, "there is no mesh"
    obj = add_monkey()
    assert drawn() == BUTTONS
    assert drawn(scrolled=0) == drawn(width=1) == drawn(tab="Item") == {}
    cubify(max_iterations=2)
    obj.cubic_craft.cubeness = 0.7
    assert drawn()["cubic_craft.cubify"] == "Update"


def test_where_the_tool_header_is_hidden_they_are_in_the_other(drawn):
    add_monkey()
    assert drawn(header="HEADER") == {}
    assert drawn(header="HEADER", has_tool_header=False) == BUTTONS
    assert drawn(has_tool_header=False) == {}


def test_while_live_runs_they_end_it(drawn, begin, live):
    session = begin(add_monkey(), refine="OFF")
    assert drawn()["cubic_craft.live"] == "Confirm" and "cubic_craft.live_cancel" in drawn()
    session.on(live.Event.CANCEL)
    assert drawn() == BUTTONS


def test_the_header_is_drawn_anew_only_when_it_changes(header, drawn, monkeypatch):
    asked = []
    monkeypatch.setattr(header.bpy.app.timers, "register", lambda call, **_: asked.append(call))

    def is_drawn_anew(**where):
        asked.clear()
        header.look_at(viewport(**where), TAB)
        drawn(**where)
        return bool(asked)

    obj = add_monkey()
    assert not is_drawn_anew(scrolled=0)
    assert is_drawn_anew() and not is_drawn_anew()
    cubify(max_iterations=2)
    obj.cubic_craft.cubeness = 0.7
    assert is_drawn_anew() and not is_drawn_anew()
    assert is_drawn_anew(tab="Item") and not is_drawn_anew(tab="Item")

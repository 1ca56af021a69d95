# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""The film at the top of the README: a character in Live, as an artist sees it."""

import itertools
import pathlib
import sys

import bpy
import guidrive as gui
import live_scene as scene
import open_sections
from filming import become_cubic, cut, drag, film
from mathutils import Euler, Quaternion

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "art"))  # before what is in it

import art_character
from art_objects import select

NAME = "Character"
STEPS = 12  # of the slider each way, and of the turn


def set_the_stage():
    bpy.context.preferences.system.use_region_overlap = False  # the view ends at the sidebar
    view = gui.area().spaces.active
    view.shading.light = "MATCAP"
    view.shading.show_cavity = True
    view.overlay.show_overlays = False
    view.region_3d.view_rotation = Euler((1.35, 0.0, 0.35)).to_quaternion()
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        select(art_character.character())
        bpy.ops.object.shade_smooth()
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="Add it")
    yield from gui.wait_redraw()


def places_along(slider, *stops):
    """Return points on a slider, in steps from stop to stop, which are fractions of its width."""
    places = [stops[0]]
    for begin, end in itertools.pairwise(stops):
        places += [begin + (end - begin) * step / STEPS for step in range(1, STEPS + 1)]
    return [slider.at(place) for place in places]


def turn():
    """Turn the view to one side and back."""
    view = gui.area().spaces.active.region_3d
    for step in range(STEPS):
        angle = 0.16 if step < STEPS / 2 else -0.16
        view.view_rotation = Quaternion((0, 0, 1), angle) @ view.view_rotation
        yield from film()


def test():
    open_sections.as_shipped()
    yield from gui.open_sidebar("Cubic Craft")
    yield from set_the_stage()
    original = scene.positions(NAME)
    yield from film(6)
    yield from gui.click((yield from gui.find_button("cubic_craft.live")))
    yield from gui.wait_until(scene.will_have_changed(NAME), what="a change")
    yield from become_cubic()
    slider = yield from gui.find_button("cubic_craft_live.cubeness")
    yield from drag(places_along(slider, 0.4, 0.08, 0.6))
    yield from become_cubic()
    yield from turn()
    strong = scene.positions(NAME)
    yield from scene.end_by("RET")
    assert scene.positions(NAME) == strong != original
    yield from film()
    cut("live.gif")


gui.run(test)

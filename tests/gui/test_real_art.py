# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""A character of many parts, cubified by hand: they hold together.

The meshes and the measures are those of tests/art. Nothing but what is named is changed from its
default.
"""

import pathlib
import sys

import bpy
import guidrive as gui
import live_scene as scene
from mathutils import Euler

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "art"))  # before what is in it

import art_character
import measures
from art_objects import select, surface_of

CHARACTER = "Character"
MAX_DRIFT = 0.01  # of the size, of neighbours of different parts
MAX_TURN = 1.0  # degrees
HEADER_ABOVE = 92  # pixels from the row to the middle of the header; the form is between


def set_the_stage():
    bpy.context.preferences.system.use_region_overlap = False  # the view ends at the sidebar
    view = gui.area().spaces.active
    view.shading.color_type = "MATERIAL"
    view.shading.show_cavity = True
    view.overlay.show_outline_selected = False  # it would hide small gaps
    view.region_3d.view_rotation = Euler((1.3, 0.0, 0.45)).to_quaternion()
    yield from gui.open_sidebar("Cubic Craft")


def put(make, *names):
    """Leave in the scene what a function of tests/art makes, selected and in view."""
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        objects = make()
        assert [obj.name for obj in objects] == list(names)
        select(objects)
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="Add them")
    yield from gui.wait_redraw()


def surface(*names):
    return surface_of([bpy.data.objects[name] for name in names])


def shapes(*names):
    return [scene.positions(name) for name in names]


def click_cubify(*names):
    """Click Cubify, wait until all have changed, and return how they are then."""
    before = shapes(*names)
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(
        lambda: all(a != b for a, b in zip(shapes(*names), before, strict=True)),
        what="all of them to change",
    )
    gui.log(scene.settings(names[0]).status)
    return shapes(*names)


def holds_together(rest, after, what):
    """Check that no part has left the others, and that the whole stands as before."""
    drift = measures.drift(rest.V, after.V, rest.F)
    turn = measures.turn(rest.V, after.V)
    before, now = (measures.angle_to_axes(one.V, rest.F) for one in (rest, after))
    gui.log(f"{what}: drift {drift:.4f}, turn {turn:.2f}, angle to the axes {before:.1f} {now:.1f}")
    assert drift <= MAX_DRIFT, what
    assert turn <= MAX_TURN, what
    assert now < 0.75 * before, what


def character():
    """Cubify it, take it back, do the same in Live, and go on with other settings."""
    yield from put(art_character.character, CHARACTER)
    rest, (original,) = surface(CHARACTER), shapes(CHARACTER)
    yield from gui.screenshot("character_1_before.png")
    (cubic,) = yield from click_cubify(CHARACTER)
    cubified = surface(CHARACTER)
    holds_together(rest, cubified, "Cubify")
    yield from gui.screenshot("character_2_cubify.png")
    yield from gui.undo()
    assert scene.positions(CHARACTER) == original, "Ctrl-Z has not brought the original back"

    yield from scene.start_live()
    yield from scene.wait_idle()
    holds_together(rest, surface(CHARACTER), "Live")
    yield from gui.screenshot("character_3_live.png")
    assert scene.positions(CHARACTER) == cubic, "Live shows another shape than Cubify makes"
    yield from scene.end_by("RET")
    assert scene.positions(CHARACTER) == cubic, "Live leaves another shape than Cubify makes"
    yield from gui.undo()
    assert scene.positions(CHARACTER) == original
    yield from settings(rest, cubified)


def choose(name, letter, owner, value):
    """Click on a menu of the panel, and press the letter underlined in an item, for a value."""
    yield from gui.click((yield from gui.find_button(f"cubic_craft.{name}")))
    yield from gui.screenshot(f"menu_{name}.png")
    yield from gui.keys(letter)
    # the menu closes later
    yield from gui.wait_until(
        lambda: getattr(scene.settings(owner), name) == value, what=f"{name} {value}"
    )


def settings(rest, cubified):
    """Change in the panel what holds things together; each takes effect.

    Parameters
    ----------
    rest, cubified : Surface of the character, as it was and with the default settings
    """
    yield from close_and_open_section()
    yield from gui.enter_value((yield from gui.find_button("cubic_craft.solidity")), 1)
    assert scene.settings(CHARACTER).solidity == 1
    yield from click_cubify(CHARACTER)
    volumes = [measures.volume(X.V, rest.F) for X in (rest, cubified, surface(CHARACTER))]
    gui.log("volume at rest, and with Solidity 0.1 and 1:", *volumes)
    assert abs(volumes[0] - volumes[2]) < 0.85 * abs(volumes[0] - volumes[1])
    yield from gui.screenshot("settings_1_solid.png")

    yield from choose("together", "O", CHARACTER, "OFF")
    yield from click_cubify(CHARACTER)
    drift = measures.drift(rest.V, surface(CHARACTER).V, rest.F)
    gui.log("drift with Keep Together: Off:", drift)
    assert drift > MAX_DRIFT, "Keep Together: Off has not let the parts go"
    yield from gui.screenshot("settings_2_apart.png")


def close_and_open_section():
    """Click twice on the header of the section that the settings are in."""
    first = yield from gui.find_button("cubic_craft.keep_pose")
    header = first.at(0.5)[0], first.top + HEADER_ABOVE
    for is_open in (False, True):
        yield from gui.click(header)
        yield from gui.move_mouse(first.at())
        yield from gui.wait_redraw("UI")
        assert (gui.button_under_mouse() == first.text) == is_open
        yield from gui.screenshot(f"section_{'open' if is_open else 'closed'}.png")


def test():
    yield from set_the_stage()
    yield from character()
    scene.check_clean()


gui.run(test)

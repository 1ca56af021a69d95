# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Grab a handle in the viewport while Live runs: move, turn and scale it, take back, confirm."""

import math

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np
from bpy_extras.view3d_utils import region_2d_to_location_3d
from mathutils import Euler

CHIN, EAR = "Chin", "Ear"  # the order of the handles
RADIUS = 75  # pixels; of the rings
ARROW, BOX = 1.24 * RADIUS, 0.75 * RADIUS


def array():
    return np.frombuffer(scene.positions(), np.float32).reshape(-1, 3)


def active():
    return scene.settings().active_handle


def add_handles():
    """Add two pinned handles, of which the chin is active; return the vertices of the ear."""
    scene.add_monkey(levels=1)
    at_rest = array()
    parts = {CHIN: np.flatnonzero(at_rest[:, 2] < -0.75), EAR: np.flatnonzero(at_rest[:, 0] > 1.05)}
    for name, part in parts.items():
        group = bpy.data.objects[scene.NAME].vertex_groups.new(name=name)
        group.add(part.tolist(), 1.0, "REPLACE")
        scene.settings().handles.add().group = name
    scene.show_front()
    view = gui.area().spaces.active.region_3d
    view.view_location.x += 1.0  # the navigation gizmos cover the right
    view.view_distance *= 1.5
    with gui.in_region():
        bpy.ops.ed.undo_push(message="Add the handles")
    return parts[EAR]


class Ear:
    """The ear, by the mouse."""

    def __init__(self, vertices):
        self.vertices = vertices

    @property
    def points(self):
        return array()[self.vertices]

    @property
    def middle(self):
        return (self.points.min(axis=0) + self.points.max(axis=0)) / 2

    def screen_point(self, offset=(0, 0)):
        """Return where the mouse must be for a part of the gizmo, in pixels from its middle."""
        x, y = scene.screen_point(self.centre)
        return x + round(offset[0]), y + round(offset[1])

    def press(self, offset=(0, 0)):
        """Press the button on a part of the gizmo."""
        yield from gui.move_mouse(self.screen_point(offset))
        yield from gui.wait_redraw()
        gui.events().press("LEFTMOUSE")
        yield from gui.wait_until(lambda: scene.live().current().is_dragged(), what="a drag")

    def drag_to(self, way, offset=(0, 0)):
        """Move the mouse on, by pixels, and see the mesh follow before the button is released."""
        x, y = self.screen_point(offset)
        before = self.points
        for step in (0.3, 0.6, 1.0):
            yield from gui.move_mouse((x + round(way[0] * step), y + round(way[1] * step)))
        yield from gui.wait_until(lambda: (self.points != before).any(), what="the mesh to follow")
        assert scene.live().current().is_dragged()

    def drag(self, way, offset=(0, 0)):
        """Drag a part of the gizmo, and return the map (3,3) and the way (3,) of the ear."""
        before, centre = self.points - self.centre, self.centre
        yield from self.press(offset)
        yield from self.drag_to(way, offset)
        gui.events().release("LEFTMOUSE")
        yield from gui.wait_until(lambda: not scene.live().current().is_dragged(), what="its end")
        yield from scene.wait_idle()
        after = np.column_stack((self.points, np.ones(len(before))))
        found = np.linalg.lstsq(np.column_stack((before, np.ones(len(before)))), after, rcond=None)
        linear, place = found[0][:3, :3].T, found[0][3, :3]
        self.centre = place
        return linear, place - centre


def in_world(start, way):
    """Return which vector of the world a way of pixels is."""
    view = gui.region()
    places = [
        region_2d_to_location_3d(view, gui.area().spaces.active.region_3d, point, (0, 0, 0))
        for point in (start, (start[0] + way[0], start[1] + way[1]))
    ]
    return np.array(places[1] - places[0])


def start_live():
    yield from gui.click((yield from scene.button("cubic_craft.live")))
    yield from gui.wait_until(lambda: scene.live().current(), what="Live")
    yield from scene.wait_idle()
    yield from gui.wait_redraw()


def test():
    ear = Ear(add_handles())
    yield from gui.open_sidebar("Cubic Craft")
    yield from start_live()
    ear.centre = ear.middle
    yield from move_turn_and_scale(ear)
    yield from give_up_drags(ear)
    yield from take_back_and_confirm()
    yield from take_the_picture(ear)


def move_turn_and_scale(ear):
    assert active() == 0
    way = in_world(ear.screen_point(), (40, 24))
    linear, moved = yield from ear.drag((40, 24))
    yield from gui.wait_until(lambda: active() == 1, what="the handle to become active")
    np.testing.assert_allclose(moved, way, atol=1e-5)
    np.testing.assert_allclose(linear, np.eye(3), atol=1e-5)
    yield from gui.wait_redraw()

    way = in_world(ear.screen_point(), (0, -50))
    linear, moved = yield from ear.drag((13, -50), (0, ARROW))
    np.testing.assert_allclose(moved, way, atol=1e-5)  # along the axis only
    np.testing.assert_allclose(linear, np.eye(3), atol=1e-5)

    linear, moved = yield from ear.drag((0.4 * BOX, 5), (BOX, 0))
    np.testing.assert_allclose(moved, 0.0, atol=1e-5)
    np.testing.assert_allclose(linear, np.diag([1.4, 1.0, 1.0]), atol=0.03)
    yield from gui.screenshot("scaled.png")

    aslant = RADIUS * math.sqrt(0.5)
    linear, moved = yield from ear.drag((aslant - RADIUS, -aslant), (-aslant, aslant))
    np.testing.assert_allclose(moved, 0.0, atol=1e-5)
    # By 45 degrees to the left as it is seen, which is from -Y.
    wanted = np.array([[1, 0, -1], [0, math.sqrt(2), 0], [1, 0, 1]]) / math.sqrt(2)
    np.testing.assert_allclose(linear, wanted, atol=0.03)

    diagonal = BOX * math.sqrt(0.5)
    linear, moved = yield from ear.drag((0.5 * diagonal, 0.5 * diagonal), (diagonal, diagonal))
    np.testing.assert_allclose(moved, 0.0, atol=1e-5)
    np.testing.assert_allclose(linear, 1.5 * np.eye(3), atol=0.03)


def give_up_drags(ear):
    """Leave a drag by Esc and by the right button: neither is for Live."""
    at_rest = scene.positions()
    for key in ("ESC", "RIGHTMOUSE"):
        yield from ear.press()
        yield from ear.drag_to((-50, 30))
        yield from gui.keys(key)
        yield from gui.wait_until(lambda: not scene.live().current().is_dragged(), what="its end")
        gui.events().release("LEFTMOUSE")
        yield from scene.wait_idle()
        assert scene.positions() == at_rest, f"{key} has not brought the handle back"


def take_back_and_confirm():
    before = scene.positions()
    yield from scene.press("CTRL+Z")  # the last that was scaled
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "the scale taken back")
    handle = scene.settings().handles[1]
    assert np.array_equal(np.array(handle.pose), np.eye(4)), "it is kept when Live is confirmed"
    yield from scene.end_by("RET")
    handle = scene.settings().handles[1]
    assert not np.array_equal(np.array(handle.pose), np.eye(4))
    pose, confirmed = np.array(handle.pose), scene.positions()
    yield from gui.undo()
    yield from gui.wait_until(lambda: scene.positions() != confirmed, what="undo")
    assert np.array_equal(np.array(scene.settings().handles[1].pose), np.eye(4))
    yield from scene.redo()
    assert np.array_equal(np.array(scene.settings().handles[1].pose), pose)
    scene.check_bits_of_cubify()


def take_the_picture(ear):
    """Lift the ear once more, seen from aside, for docs/handles.md."""
    view = gui.area().spaces.active
    view.region_3d.view_rotation = Euler((1.25, 0.0, 0.45)).to_quaternion()
    view.shading.light = "MATCAP"
    with gui.in_region():
        bpy.ops.cubic_craft.restore()
        bpy.ops.cubic_craft.handle_reset_pose()
        bpy.ops.ed.undo_push(message="As before")
    yield from start_live()
    ear.centre = ear.middle
    yield from ear.drag((0, 50))
    yield from gui.move_mouse(gui.viewport_point(0.1, 0.02))
    yield from gui.wait_redraw()
    yield from gui.smooth_screenshot("gizmo.png")
    yield from scene.end_by("RET")
    scene.check_bits_of_cubify()


gui.run(test)

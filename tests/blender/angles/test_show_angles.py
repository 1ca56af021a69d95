# SPDX-License-Identifier: GPL-3.0-or-later
"""The angles that remain to the form: their numbers, when they are measured anew, what is drawn."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from live_steps import STEPS
from mathutils import Euler
from rich_mesh import position_of
from scene import add_empty, add_monkey, edit_mode, select

TURN = np.radians(20)
FLATTEST = {"detail": 0.0, "keep_pose": False, "keep_apart": False}
"""what makes a small mesh much flatter in few iterations"""


@pytest.fixture
def angles_now(part):
    """Return the function of that name; the scene is updated first, as before each redraw."""

    def measure(obj):
        bpy.context.view_layer.update()
        return part("angles.overlay").angles_now(obj)

    return measure


@pytest.fixture
def drawn(part):
    """Return what the overlay shows, as a function of whether viewport overlays are on."""

    def draw(show_overlays=True):
        view = next(
            area.spaces.active
            for screen in bpy.data.screens
            for area in screen.areas
            if area.type == "VIEW_3D"
        )
        view.overlay.show_overlays = show_overlays
        bpy.context.view_layer.update()
        context = SimpleNamespace(
            window_manager=bpy.context.window_manager,
            view_layer=bpy.context.view_layer,
            active_object=bpy.context.active_object,
            space_data=view,
        )
        found = part("angles.overlay").angles_to_draw(context)
        return found and found[0].name

    bpy.ops.wm.read_homefile(use_empty=False, use_factory_startup=True)
    bpy.context.window_manager.cubic_craft_angles = True
    yield draw
    bpy.context.window_manager.cubic_craft_angles = False


def add_cube(**where):
    bpy.ops.mesh.primitive_cube_add(**where)
    return bpy.context.object


@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_a_turned_cube_is_off_by_its_turn_until_the_form_is_turned_alike(angles_now, mirror):
    obj = add_cube(rotation=(0.0, 0.0, TURN))
    obj.scale.x = mirror
    angles = angles_now(obj)
    np.testing.assert_allclose(np.sort(angles.degrees), [0.0] * 4 + [20.0] * 8, atol=1e-4)
    assert angles.aligned == pytest.approx(1 / 3)
    obj.cubic_craft.orientation[2] = TURN
    assert angles_now(obj).aligned == 1.0
    np.testing.assert_allclose(angles_now(obj).degrees, 0.0, atol=1e-4)
    obj.cubic_craft.space, obj.cubic_craft.orientation = "OBJECT", (0.0, 0.0, 0.0)
    np.testing.assert_allclose(angles_now(obj).degrees, 0.0, atol=1e-4)


@pytest.mark.parametrize("space", ["OBJECT", "WORLD", "FRAME"])
@pytest.mark.parametrize("form", ["CUBE", "BOX", "TETRAHEDRON", "CONE", "DIRECTIONS"])
def test_the_angles_are_those_that_are_seen_in_the_world(angles_now, part, form, space):
    obj = add_monkey(rotation=(0.3, 0.5, 0.7), location=(4.0, 5.0, 6.0))
    obj.scale = (1.0, 2.0, -0.5)
    gem = add_monkey("Gem", rotation=(0.1, 0.2, 0.3))
    settings = obj.cubic_craft
    settings.form, settings.space, settings.orientation = form, space, (0.3, 0.1, 0.2)
    settings.frame, settings.form_object = add_empty("Frame", rotation_euler=(0.5, 0.1, 0.2)), gem
    settings.form_weights = (1.0, 0.5, 0.7)
    angles = angles_now(obj)
    plain = part("settings.properties").settings_of(obj)
    body = part("form.body").form_of(plain)
    sides = np.concatenate([np.eye(3), -np.eye(3)]) if body is None else body.normals
    sides = sides @ part("read.object_frame").world_axes(obj, plain).T
    world = np.array(obj.matrix_world)[:3, :3]
    a, b, c = (angles.corners @ world.T).astype(np.float64).swapaxes(0, 1)
    normals = np.cross(b - a, c - a) * np.sign(np.linalg.det(world))
    areas = np.linalg.norm(normals, axis=1)
    cosines = (normals / areas[:, None] @ sides.T).max(axis=1)
    np.testing.assert_allclose(np.cos(np.radians(angles.degrees)), cosines, atol=1e-5)
    np.testing.assert_allclose(angles.areas, areas / 2, rtol=1e-4)
    assert angles.degrees.max() > 10.0


def test_what_cannot_be_seen_is_left_out(angles_now):
    obj = add_cube()
    assert len(angles_now(obj).degrees) == 12
    obj.data.vertices[0].co.x = np.nan
    assert len(angles_now(obj).degrees) == 8
    for vertex in obj.data.vertices:
        vertex.co = (0.0, 0.0, 0.0)
    assert len(angles_now(obj).degrees) == 0 and angles_now(obj).aligned == 0.0


def test_the_angles_are_kept_until_the_mesh_changes(angles_now):
    other, obj = add_monkey("Other"), add_monkey()
    angles = angles_now(obj)
    assert angles_now(obj) is angles
    obj.location.x = 5.0
    obj.cubic_craft.cubeness = 0.9
    other.data.vertices[0].co.x += 1.0
    other.data.update()
    assert angles_now(obj) is angles
    obj.data.vertices[0].co.x += 0.1
    obj.data.update()
    moved = angles_now(obj)
    assert moved is not angles and not np.array_equal(moved.degrees, angles.degrees)
    with edit_mode(obj) as edited:
        edited.verts[0].co.x += 0.1
    assert angles_now(obj) is not moved


def test_the_angles_follow_the_form_and_its_orientation(angles_now):
    obj = add_monkey()
    frame = add_empty("Frame")
    frame.rotation_euler.y = 0.2

    def is_new(name, value):
        before = angles_now(obj)
        owner = obj if name == "rotation_euler" else obj.cubic_craft
        setattr(owner, name, value)
        return angles_now(obj) is not before

    assert is_new("form", "OCTAHEDRON")
    assert is_new("orientation", (0.1, 0.2, 0.3))
    assert is_new("rotation_euler", Euler((0.4, 0.0, 0.0)))
    obj.cubic_craft.frame = frame
    assert is_new("space", "FRAME")
    before = angles_now(obj)
    frame.rotation_euler.x = 0.3
    assert angles_now(obj) is not before


def test_the_angles_follow_cubify_and_undo(angles_now):
    bpy.ops.ed.undo_push(message="start")
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="monkey")
    before = angles_now(obj)
    bpy.ops.cubic_craft.cubify(cubeness=0.9, max_iterations=30, **FLATTEST)
    bpy.ops.ed.undo_push(message="cubify")
    cubic = angles_now(obj)
    assert cubic.aligned > before.aligned + 0.2
    bpy.ops.ed.undo()
    again = angles_now(bpy.data.objects["Suzanne"])
    np.testing.assert_array_equal(again.degrees, before.degrees)


def test_the_angles_follow_live(angles_now, begin, one_phase):
    obj = add_monkey()
    shares = [angles_now(obj).aligned]
    session = begin(obj, cubeness=0.9, max_iterations=30, refine="AUTO", **FLATTEST)
    for _ in range(STEPS):
        session.tick(bpy.context)
        shares.append(angles_now(obj).aligned)
        if session._timer is None:
            break
    assert len(set(shares)) > 5, "each shape has its share"
    assert shares[-1] > shares[0] + 0.2
    seen = angles_now(obj).corners.reshape(-1, 3)
    np.testing.assert_array_equal(seen.max(axis=0), position_of(obj.data).max(axis=0))


def test_angles_of_few_objects_are_kept(angles_now, part):
    for name in "ABCD":
        angles_now(add_monkey(name))
    assert len(part("angles.overlay")._known._known) == part("environment.kept").MOST
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert part("angles.overlay")._known.is_empty


def test_what_is_drawn(drawn):
    obj = bpy.data.objects["Cube"]
    select(obj)
    assert drawn() == "Cube"
    assert drawn(show_overlays=False) is None
    bpy.context.window_manager.cubic_craft_angles = False
    assert drawn() is None
    bpy.context.window_manager.cubic_craft_angles = True
    for mode in ("EDIT", "SCULPT", "WEIGHT_PAINT"):
        bpy.ops.object.mode_set(mode=mode)
        assert drawn() is None
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.hide_viewport = True
    assert drawn() is None
    obj.hide_viewport = False
    select(obj)
    obj.cubic_craft.form = "OBJECT"
    assert drawn() is None, "no object is set for the form"
    obj.cubic_craft.form = "CUBE"
    assert drawn() == "Cube"
    obj.data.clear_geometry()
    assert drawn() is None


def test_the_colors_become_brighter_with_the_angle(part):
    legend = part("angles.legend")
    colors = legend.colors_of(np.array([0.0, 6.0, 12.0, 18.0, 24.0, 30.0, 90.0]))
    assert colors.shape == (7, 4) and colors.dtype == np.float32
    gray = colors[:, :3] @ (0.2126, 0.7152, 0.0722)
    assert (np.diff(gray[:6]) > 0.05).all(), "also to those who see no colors"
    np.testing.assert_array_equal(colors[5], colors[6])


def test_the_legend_is_beside_the_sidebar_and_above_a_header(part):
    def region(kind, alignment, x, y, width, height):
        return SimpleNamespace(type=kind, alignment=alignment, x=x, y=y, width=width, height=height)

    view = region("WINDOW", "NONE", 100, 50, 900, 600)
    tools = region("TOOLS", "LEFT", 100, 50, 60, 600)
    header = region("HEADER", "TOP", 100, 620, 900, 30)
    closed = region("UI", "RIGHT", 1000, 50, 1, 600)
    corner = part("angles.legend").free_corner
    assert corner(SimpleNamespace(regions=[view, tools, header, closed]), view) == (900, 0)
    sidebar = region("UI", "RIGHT", 700, 50, 300, 600)
    shelf = region("ASSET_SHELF", "BOTTOM", 100, 50, 900, 80)
    assert corner(SimpleNamespace(regions=[view, sidebar, shelf]), view) == (600, 80)


def test_the_overlay_leaves_nothing_behind(extension, angles_now, part):
    overlay, kept = part("angles.overlay"), part("environment.kept")
    angles_now(add_monkey())
    assert len(overlay._handles) == 2

    def handlers():
        every = [getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)]
        listening = [handler for some in every if isinstance(some, list) for handler in some]
        return [h for h in listening if h.__module__ == kept.__name__]

    count = len(handlers())
    assert count == len(kept._HANDLERS)
    bpy.ops.preferences.addon_disable(module=extension.__name__)
    assert not overlay._handles and overlay._known.is_empty and not handlers()
    assert not hasattr(bpy.types.WindowManager, overlay.PROPERTY)
    bpy.ops.preferences.addon_enable(module=extension.__name__)
    assert hasattr(bpy.types.WindowManager, overlay.PROPERTY) and len(handlers()) == count

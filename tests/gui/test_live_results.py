# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Live for several objects at once, for all kinds of results, and with shape keys."""

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np


def add_monkeys(*names):
    """Add monkeys in a row, ear in ear, selected, the first one active."""
    with gui.in_region():
        bpy.data.batch_remove(bpy.data.objects[:])  # also what a new object has hidden
        for number, name in enumerate(names):
            bpy.ops.mesh.primitive_monkey_add(location=(2.5 * number, 0, 0))
            bpy.context.object.name = bpy.context.object.data.name = name
            scene.settings(name).refine = "OFF"
        for name in names:
            bpy.data.objects[name].select_set(True)
        bpy.context.view_layer.objects.active = bpy.data.objects[names[0]]
        bpy.ops.ed.undo_push(message="Add monkeys")
    scene.show_front()


def shapes(*names):
    return [scene.positions(name) for name in names]


def key_points(obj):
    points = {}
    for key in obj.data.shape_keys.key_blocks:
        values = np.empty(3 * len(key.points), np.float32)
        key.points.foreach_get("co", values)
        points[key.name] = values.tobytes()
    return points


def several():
    names = ("A", "B", "C")
    add_monkeys(*names)
    scene.settings("B").cubeness = 0.05  # the active one counts
    original = scene.positions("A")
    slider = yield from scene.cubeness_slider()
    yield from scene.start_live()
    yield from gui.wait_until(
        lambda: all(scene.positions(name) != original for name in names), what="all to change"
    )
    yield from gui.screenshot("several.png")
    yield from gui.drag_slider(slider, 0.5, 0.8)
    yield from scene.wait_idle()
    yield from gui.screenshot("several_converged.png")
    yield from scene.end_by("RET")
    assert len({scene.settings(name).cubeness for name in names}) == 1
    confirmed = shapes(*names)
    assert len(set(confirmed)) == 3, "they have not been solved as one"
    yield from gui.undo()
    assert set(shapes(*names)) == {original}
    yield from scene.redo()
    assert shapes(*names) == confirmed
    scene.check_bits_of_cubify(*names)

    # One of them is deleted while they are live.
    yield from scene.start_live()
    bpy.data.objects.remove(bpy.data.objects["B"])
    yield from scene.wait_idle()
    yield from scene.end_by("ESC")
    assert shapes("A", "C") == [confirmed[0], confirmed[2]]


def several_apart():
    """Keep nothing but their own parts together: each is as if it were alone."""
    names = ("A", "B", "C")
    add_monkeys(*names)
    original = scene.positions("A")
    scene.settings("A").together = "PARTS"
    yield from scene.start_live()
    yield from scene.wait_idle()
    yield from gui.screenshot("several_apart.png")
    yield from scene.end_by("RET")
    assert len(set(shapes(*names))) == 1
    confirmed = scene.positions("A")
    yield from gui.undo()
    assert set(shapes(*names)) == {original}
    with gui.in_region():
        bpy.ops.object.select_all(action="DESELECT")
        bpy.data.objects["A"].select_set(True)
        bpy.ops.cubic_craft.cubify()
    assert shapes(*names) == [confirmed, original, original]


def shape_key():
    """Leave the mesh as it is, and write a key."""
    add_monkeys(scene.NAME)
    original = scene.positions()
    scene.settings().result = "SHAPE_KEY"
    yield from scene.start_live()
    yield from scene.wait_idle()
    yield from gui.screenshot("shape_key_live.png")
    yield from scene.end_by("ESC")
    assert scene.positions() == original
    assert bpy.data.objects[scene.NAME].data.shape_keys is None
    yield from scene.start_live()
    yield from scene.end_by("RET")
    assert scene.positions() == original
    points = key_points(bpy.data.objects[scene.NAME])
    assert list(points) == ["Basis", "Cubic"] and points["Basis"] == original != points["Cubic"]
    yield from gui.screenshot("shape_key.png")
    yield from gui.undo()
    assert bpy.data.objects[scene.NAME].data.shape_keys is None
    with gui.in_region():
        scene.settings().result = "SHAPE_KEY"
        bpy.ops.cubic_craft.cubify()
    assert key_points(bpy.data.objects[scene.NAME]) == points

    # Once more, from the key that is there.
    yield from scene.start_live()
    yield from scene.wait_idle()
    yield from scene.end_by("RET")
    assert key_points(bpy.data.objects[scene.NAME]) == points


def new_object():
    add_monkeys(scene.NAME)
    original = scene.positions()
    scene.settings().result = "NEW_OBJECT"
    yield from scene.start_live_beside()
    yield from scene.wait_idle()
    yield from scene.end_by("RET")
    made = [obj.name for obj in bpy.data.objects if obj.name != scene.NAME]
    gui.log("made", made)
    assert len(made) == 1 and scene.positions() == original != scene.positions(made[0])
    confirmed = scene.positions(made[0])
    yield from gui.screenshot("new_object.png")
    yield from gui.undo()
    assert [obj.name for obj in bpy.data.objects] == [scene.NAME]
    assert scene.positions() == original
    with gui.in_region():
        scene.settings().result = "NEW_OBJECT"
        bpy.ops.cubic_craft.cubify()
    assert scene.positions(made[0]) == confirmed


def with_keys():
    """Carry a smile along, and bring it back with the face."""
    add_monkeys(scene.NAME)
    obj = bpy.data.objects[scene.NAME]
    obj.shape_key_add(name="Basis")
    smile = obj.shape_key_add(name="Smile", from_mix=False)
    for point in smile.points[:100]:
        point.co.z += 0.3
    smile.value = 0.7
    with gui.in_region():
        bpy.ops.ed.undo_push(message="Smile")
    before = key_points(obj)
    slider = yield from scene.cubeness_slider()
    yield from scene.start_live()
    yield from gui.drag_slider(slider, 0.4, 0.7)
    yield from scene.wait_idle()
    yield from gui.screenshot("keys_live.png")
    shown = key_points(bpy.data.objects[scene.NAME])
    assert all(shown[name] != before[name] for name in before)
    yield from scene.end_by("ESC")
    assert key_points(bpy.data.objects[scene.NAME]) == before
    yield from scene.start_live()
    yield from scene.end_by("RET")
    confirmed = key_points(bpy.data.objects[scene.NAME])
    assert bpy.data.objects[scene.NAME].data.shape_keys.key_blocks["Smile"].value > 0.69
    cubeness = scene.settings().cubeness  # Live has gone on where it was cancelled
    yield from gui.undo()
    assert key_points(bpy.data.objects[scene.NAME]) == before
    with gui.in_region():
        bpy.ops.cubic_craft.cubify(cubeness=cubeness)
    assert key_points(bpy.data.objects[scene.NAME]) == confirmed


def test():
    gui.simplify_viewport()
    scene.add_monkey()
    yield from gui.open_sidebar("Cubic Craft")
    for moment in (several, several_apart, shape_key, new_object, with_keys):
        gui.log(moment.__name__)
        yield from moment()
        scene.check_clean()


gui.run(test)

# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen becomes cubic: modifiers, texts, curves, surfaces and metaballs, in a new object."""

import bpy
import numpy as np
import pytest
from recorder import Recorder
from rich_mesh import position_of
from scene import add_monkey, cubify, select

SEEN = {"result": "NEW_OBJECT", "with_modifiers": True}


def seen_of(obj):
    """Return the positions that are seen of an object, in its coordinates."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    values = position_of(mesh)
    evaluated.to_mesh_clear()
    return values


def add_modifiers(obj, levels=0):
    """Add what makes more of a mesh; of a monkey, each level makes four times as much."""
    obj.modifiers.new("Mirror", "MIRROR")
    obj.modifiers.new("Subdivision", "SUBSURF").levels = levels
    solidify = obj.modifiers.new("Solidify", "SOLIDIFY")
    solidify.thickness = 0.05
    return obj


def check_hidden(source, new):
    """Check that the source is hidden behind the new object, and shown by a click."""
    assert source.hide_get() and source.hide_render and not source.select_get()
    assert new.visible_get() and not new.hide_render
    assert bpy.ops.cubic_craft.show_source() == {"FINISHED"}
    assert source.visible_get() and not source.hide_render
    assert bpy.context.object == new and bpy.context.selected_objects == [new]
    assert not bpy.ops.cubic_craft.show_source.poll()


def check_new(source, original):
    """Check the new object that is active: cubic, of what was seen, in the place of the source."""
    new = bpy.context.object
    assert new != source and new.name == f"{source.name} Cubic" and new.type == "MESH"
    assert not new.modifiers and new.data.shape_keys is None and new.data.users == 1
    assert np.allclose(new.matrix_world, source.matrix_world)
    assert list(new.users_collection) == list(source.users_collection)
    check_hidden(source, new)
    shape = position_of(new.data)
    assert shape.shape == original.shape and np.abs(shape - original).max() > 0.01
    assert not new.cubic_craft.with_modifiers and new.cubic_craft.result == "MESH"
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert np.allclose(position_of(new.data), original, atol=1e-6)
    return new


def test_a_cube_under_modifiers_becomes_what_is_seen():
    bpy.ops.mesh.primitive_cube_add(location=(1, 2, 3), rotation=(0.1, 0.2, 0.3))
    cube = add_modifiers(bpy.context.object, levels=2)
    cube.data.materials.append(bpy.data.materials.new("Red"))
    cube.vertex_groups.new(name="Top").add([1, 3, 5, 7], 1.0, "REPLACE")
    before, original = position_of(cube.data), seen_of(cube)
    assert cubify(**SEEN) == {"FINISHED"}
    assert (position_of(cube.data) == before).all() and len(cube.modifiers) == 3
    assert not cube.data.keys() and not [a for a in cube.data.attributes if "cubic" in a.name]
    new = check_new(cube, original)
    assert [slot.material.name for slot in new.material_slots] == ["Red"]
    assert new.data.uv_layers and [group.name for group in new.vertex_groups] == ["Top"]
    assert any(vertex.groups for vertex in new.data.vertices)


def test_the_cubeness_map_counts_on_what_is_seen():
    cube = add_modifiers(add_monkey())
    left = [v.index for v in cube.data.vertices if v.co.z < 0]
    cube.vertex_groups.new(name="Low").add(left, 1.0, "REPLACE")
    original = seen_of(cube)
    assert cubify(map_group="Low", map_invert=True, **SEEN) == {"FINISHED"}
    moved = np.abs(position_of(bpy.context.object.data) - original).max(axis=1)
    assert moved[original[:, 2] < -0.4].max() == 0.0 and moved.max() > 0.02


def add_text():
    bpy.ops.object.text_add(location=(0, 1, 0))
    text = bpy.context.object
    text.data.body, text.data.extrude = "Cube", 0.1
    return text


def add_pipe():
    bpy.ops.curve.primitive_bezier_circle_add()
    bpy.context.object.data.bevel_depth = 0.2
    return bpy.context.object


def add_surface():
    bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    return bpy.context.object


def add_metaball():
    bpy.ops.object.metaball_add()
    return bpy.context.object


def test_a_text_has_presets_and_cubeness_before_the_first_click(part):
    made = []
    for cubeness in (None, 1.5):
        text, layout = add_text(), Recorder()
        part("ui.seen").draw_other(layout, text)
        assert layout.drawn.index("preset") < layout.drawn.index("cubeness")
        assert "cubic_craft.cubify" in layout.drawn[layout.drawn.index("cubeness") :]
        if cubeness is not None:
            text.cubic_craft.cubeness = cubeness
        assert cubify(**SEEN) == {"FINISHED"}
        made.append(bpy.context.object)
    assert made[0].cubic_craft.cubeness != made[1].cubic_craft.cubeness == 1.5
    assert (position_of(made[0].data) != position_of(made[1].data)).any()


@pytest.mark.parametrize("add", [add_text, add_pipe, add_surface, add_metaball])
def test_what_is_no_mesh_becomes_one(add):
    source = add()
    had_settings = source.is_property_set("cubic_craft")
    bpy.context.view_layer.update()
    original = seen_of(source)
    assert bpy.ops.cubic_craft.cubify.poll()
    assert cubify() == {"FINISHED"}
    check_new(source, original)
    assert source.name in bpy.context.scene.objects
    assert source.is_property_set("cubic_craft") == had_settings


def test_what_shows_no_faces_is_refused_by_name():
    bpy.ops.curve.primitive_bezier_circle_add()
    with pytest.raises(RuntimeError, match='Circle" shows no faces of its own'):
        cubify()
    assert not bpy.data.meshes and len(bpy.data.objects) == 1


def test_of_an_earlier_result_nothing_is_brought_along():
    obj = add_modifiers(add_monkey())
    cubify()
    original = seen_of(obj)
    assert cubify(**SEEN) == {"FINISHED"}
    check_new(obj, original)


def test_what_was_not_written_is_removed(part):
    jobs = part("job")
    choice = part("settings.overrides")
    obj = add_modifiers(add_monkey())
    watched = jobs.WatchedJob(jobs.Job(choice.SettingsOverrides(SEEN), [obj]))
    watched.advance(0.0)
    watched.watch(bpy.context.window)
    assert len(bpy.data.objects) == 2
    watched.tick()
    bpy.data.objects.remove(obj)  # it is not needed any more
    watched.tick()
    assert watched.reason is None
    watched.cancel()
    assert not bpy.data.objects and len(bpy.data.meshes) == 1


def test_the_panel_hints_where_the_mesh_says_little(part):
    seen = part("ui.seen")
    obj = add_monkey()
    assert not seen.can_be_seen(obj)
    obj.modifiers.new("Mirror", "MIRROR")  # solved as a whole, see Symmetry
    obj.modifiers.new("Armature", "ARMATURE")
    assert not seen.can_be_seen(obj)
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    assert not seen.can_be_seen(obj), "what it shows is solved"
    obj.cubic_craft.refine = "OFF"
    assert seen.can_be_seen(obj)
    modifier.show_viewport = False
    assert not seen.can_be_seen(obj)
    nodes = obj.modifiers.new("Smooth by Angle", "NODES")
    nodes.node_group = bpy.data.node_groups.new("Smooth by Angle", "GeometryNodeTree")
    assert not seen.can_be_seen(obj)
    nodes.node_group.name = "Rocks"
    assert seen.can_be_seen(obj)


def test_the_source_of_a_copy_is_hidden_behind_it_and_its_children_are_not():
    obj = add_monkey()
    eye = add_monkey("Eye", size=0.2)
    eye.parent = obj
    select(obj)
    cubify(result="NEW_OBJECT")
    assert eye.visible_get() and not eye.hide_render
    check_hidden(obj, bpy.data.objects["Suzanne Cubic"])


def test_what_an_artist_has_hidden_from_renders_stays_so():
    obj = add_monkey()
    obj.hide_render = True
    cubify(result="NEW_OBJECT")
    assert obj.hide_get() and bpy.context.object.hide_render
    bpy.ops.cubic_craft.show_source()
    assert obj.visible_get() and obj.hide_render


@pytest.mark.parametrize("options", [{"result": "NEW_OBJECT"}, SEEN])
def test_a_source_without_its_new_object_is_rendered_again(options):
    obj = add_monkey()
    cubify(**options)
    bpy.data.objects.remove(bpy.context.object)
    obj.hide_set(False)
    select(obj)
    cubify(**options)
    assert obj.hide_render and not bpy.context.object.hide_render, "this is no copy of the source's"
    bpy.data.objects.remove(bpy.context.object)
    obj.hide_set(False)
    select(obj)
    assert obj.hide_render and bpy.ops.cubic_craft.show_source() == {"FINISHED"}
    assert not obj.hide_render


def test_what_will_be_rounded_again_is_named_and_helped_first(part):
    seen = part("ui.seen")
    bpy.ops.mesh.primitive_cube_add()
    cage = bpy.context.object
    cage.modifiers.new("Mirror", "MIRROR")  # solved as a whole: it stays cubic
    assert seen.hint_to_draw(cage) is None
    cage.modifiers.new("Array", "ARRAY")
    assert seen.hint_to_draw(cage) == seen.Hint("Modifiers are ignored", is_needed=False)
    subdivision = cage.modifiers.new("Subdivision", "SUBSURF")
    hint = seen.Hint("Subdivision will round it again", is_needed=True)
    assert seen.hint_to_draw(cage) == hint
    cubify(max_iterations=1)
    assert seen.hint_to_draw(cage) == hint
    subdivision.subdivision_type = "SIMPLE"
    assert not seen.hint_to_draw(cage).is_needed
    subdivision.subdivision_type, subdivision.levels = "CATMULL_CLARK", 0
    assert not seen.hint_to_draw(cage).is_needed
    subdivision.levels = 1
    cage.cubic_craft.result, cage.cubic_craft.with_modifiers = "NEW_OBJECT", True
    assert seen.hint_to_draw(cage) is None


def test_one_undo_shows_the_source_again():
    add_monkey()
    bpy.ops.ed.undo_push(message="Monkey")
    cubify(result="NEW_OBJECT")
    bpy.ops.ed.undo_push(message="Cubify")
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Suzanne"]
    assert list(bpy.data.objects) == [obj] and bpy.context.object == obj
    assert obj.visible_get() and not obj.hide_render and obj.select_get()

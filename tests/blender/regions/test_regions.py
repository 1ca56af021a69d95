# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions: vertex groups with a form, an orientation and a cubeness of their own."""

import importlib

import bmesh
import bpy
import numpy as np
import pytest
from live_steps import bits, check_same_as_cubify, confirm, tick_to_rest
from lumps import FLIP_X, add_lump, partner_of
from rich_mesh import position_of
from scene import add_copy, add_monkey, add_triangles, bmesh_of, cubify, select
from solids import add_solid, share_facing

OPTIONS = {"refine": "OFF", "max_iterations": 150, "solidity": 0.0}


def add_ball(subdivisions=4, name="Ball"):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
    bpy.context.object.name = name
    return bpy.context.object


def add_group(obj, name, weight_of):
    """Add a vertex group with weights by a function of positions (n,3)."""
    group = obj.vertex_groups.new(name=name)
    for index, weight in enumerate(np.clip(weight_of(position_of(obj.data)), 0.0, 1.0)):
        if weight > 0.0:
            group.add([index], float(weight), "REPLACE")
    return group


def upper(V):
    return V[:, 2] > 0.3


def blended(V):
    return 0.5 + 2.0 * V[:, 2]


def add_region(obj, group, **settings):
    select(obj)
    assert bpy.ops.cubic_craft.region_add(group=group) == {"FINISHED"}
    region = obj.cubic_craft.regions[-1]
    for name, value in settings.items():
        setattr(region, name, value)
    return region


def face_middles(obj):
    found = np.empty((len(obj.data.polygons), 3))
    obj.data.polygons.foreach_get("center", found.ravel())
    return found


@pytest.mark.parametrize("weights", [upper, blended])
def test_each_part_has_its_own_form(part, weights):
    forms = part("form.body").forms
    ball = add_ball()
    heights = face_middles(ball)[:, 2]
    before = bits(ball)
    add_group(ball, "Top", weights)
    add_region(ball, "Top", form="OCTAHEDRON", cubeness=1.5)
    cubify(cubeness=1.5, **OPTIONS)
    gem, box = forms.octahedron().normals, forms.cube().normals
    for form, other, where in ((gem, box, heights > 0.5), (box, gem, heights < -0.4)):
        facing = [share_facing(ball, sides, 12.0, where) for sides in (form, other)]
        assert facing[0] > 0.6 > facing[1]
    bpy.ops.cubic_craft.restore()
    assert bits(ball) == before


def test_a_region_with_the_settings_of_the_object_changes_nothing():
    one = add_triangles()
    other = add_copy(one)
    add_group(other, "Part", lambda V: V[:, 2])
    add_region(other, "Part")
    cubify(**OPTIONS)
    select(one)
    cubify(**OPTIONS)
    np.testing.assert_array_equal(position_of(other.data), position_of(one.data))


def test_a_region_of_everything_is_the_object_with_its_settings():
    one = add_triangles()
    other = add_copy(one)
    add_group(other, "All", lambda V: np.ones(len(V)))
    add_region(other, "All", form="PRISM", form_sides=5, cubeness=0.7, orientation=(0.2, 0.1, 0.3))
    cubify(**OPTIONS)
    select(one)
    cubify(form="PRISM", form_sides=5, cubeness=0.7, orientation=(0.2, 0.1, 0.3), **OPTIONS)
    np.testing.assert_allclose(position_of(other.data), position_of(one.data), atol=1e-6)


@pytest.mark.parametrize("form", ["CUBE", "TETRAHEDRON"])
def test_halves_with_regions_stay_mirror_images(form):
    lump = add_lump()
    partner = partner_of(position_of(lump.data), 1e-6)
    add_group(lump, "Sides", lambda V: 2.0 * np.abs(V[:, 0]) - 0.5)
    add_region(lump, "Sides", form=form, orientation=(0.3, 0.1, 0.2), cubeness=0.8)
    cubify(symmetry=(True, False, False), **OPTIONS)
    after = position_of(lump.data)
    np.testing.assert_array_equal(after[partner], after * FLIP_X)


def test_the_form_of_a_region_is_mirrored_by_a_modifier():
    one = add_lump()
    with bmesh_of(one.data) as edited:
        left = [vertex for vertex in edited.verts if vertex.co.x < -1e-6]
        bmesh.ops.delete(edited, geom=left, context="VERTS")
    one.modifiers.new("Mirror", "MIRROR")
    other = add_copy(one)
    add_group(other, "All", lambda V: np.ones(len(V)))
    add_region(other, "All", form="TETRAHEDRON", orientation=(0.3, 0.1, 0.2))
    cubify(**OPTIONS)
    select(one)
    cubify(form="TETRAHEDRON", orientation=(0.3, 0.1, 0.2), **OPTIONS)
    np.testing.assert_allclose(position_of(other.data), position_of(one.data), atol=1e-6)


def test_shares_never_add_up_to_more_than_all(extension):
    """Where weights do, they are scaled, so the order of the regions does not matter."""
    obj = add_ball(1)
    weights = {"One": 1.0, "Other": 0.6, "Third": 0.4}
    for name, weight in weights.items():
        add_group(obj, name, lambda V, weight=weight: np.full(len(V), weight))
        add_region(obj, name)
    addon = f"{extension.__name__}.cubic_craft_addon"
    settings = importlib.import_module(f"{addon}.settings.properties").settings_of(obj, handles=())
    shares = importlib.import_module(f"{addon}.regions.region").region_shares(obj, settings.regions)
    assert shares is not None
    np.testing.assert_allclose(shares, np.tile([0.0, 0.5, 0.3, 0.2], (len(shares), 1)), atol=1e-6)


def test_the_map_scales_regions_too():
    ball = add_ball(4)
    add_group(ball, "Top", upper)
    add_group(ball, "Map", lambda V: V[:, 2] < 0.0)
    add_region(ball, "Top", form="OCTAHEDRON", cubeness=1.0)
    rest = position_of(ball.data).copy()
    cubify(map_group="Map", **OPTIONS)
    np.testing.assert_array_equal(
        position_of(ball.data)[rest[:, 2] >= 0.0], rest[rest[:, 2] >= 0.0]
    )


def test_the_switch_turns_all_regions_off():
    one = add_triangles()
    other = add_copy(one)
    add_group(other, "Top", upper)
    add_region(other, "Top", form="OCTAHEDRON")
    other.cubic_craft.use_regions = False
    cubify(**OPTIONS)
    select(one)
    cubify(**OPTIONS)
    assert bits(one) == bits(other)


def test_facets_of_each_region_are_made_planar():
    ball = add_ball()
    add_group(ball, "Top", upper)
    add_region(ball, "Top", form="OCTAHEDRON", cubeness=2.0)
    cubify(cubeness=2.0, **OPTIONS)
    heights = face_middles(ball)[:, 2]
    assert bpy.ops.cubic_craft.flatten(angle=0.4, tolerance=0.1) == {"FINISHED"}
    normals = np.empty((len(ball.data.polygons), 3))
    ball.data.polygons.foreach_get("normal", normals.ravel())
    gem = np.abs(np.abs(normals) - 1.0 / np.sqrt(3.0)).max(axis=1) < 1e-3
    box = (np.abs(np.abs(normals) - 1.0) < 1e-3).any(axis=1)
    assert np.count_nonzero(gem & (heights > 0.0)) > 50
    assert np.count_nonzero(box & (heights < 0.0)) > 50


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda obj, region: obj.vertex_groups.clear(), 'has no vertex group "Top"; pick another'),
        (lambda obj, region: setattr(region, "group", ""), "region 1 of .* has no vertex group"),
        (
            lambda obj, region: setattr(region, "form", "OBJECT"),
            'no object is set for the form of the region "Top"',
        ),
    ],
)
def test_what_a_region_lacks_is_said(part, damage, words):
    monkey = add_monkey()
    add_group(monkey, "Top", upper)
    region = add_region(monkey, "Top")
    before = bits(monkey)
    damage(monkey, region)
    with pytest.raises(ValueError, match=words):  # as the panel asks
        part("regions.region").object_regions(monkey)
    with pytest.raises(RuntimeError, match=words):
        cubify()
    assert bits(monkey) == before


def test_a_region_may_have_the_form_of_an_object():
    ball, form = add_ball(4), add_solid("cone", location=(9, 0, 0))
    add_group(ball, "Top", upper)
    add_region(ball, "Top", form="OBJECT", form_object=form, cubeness=1.0)
    select(ball)
    cubify(**OPTIONS)
    first = bits(ball)
    ball.cubic_craft.regions[0].form = "DIRECTIONS"
    cubify(**OPTIONS)
    assert bits(ball) != first


def test_a_region_follows_the_name_of_its_group():
    monkey = add_monkey()
    group = add_group(monkey, "Top", upper)
    region = add_region(monkey, "Top")
    monkey.update_tag()
    bpy.context.view_layer.update()
    group.name = "Crown"
    monkey.update_tag()
    bpy.context.view_layer.update()
    assert region.group == "Crown"


def test_changes_of_a_region_are_noticed(part):
    changes_since, last_run = part("run.up_to_date").changes_since, part("mesh_bridge").last_run
    monkey = add_monkey()
    add_group(monkey, "Top", upper)
    region = add_region(monkey, "Top", form="PRISM")
    cubify(**OPTIONS)
    assert changes_since(monkey, last_run(monkey)) == []
    region.form_weights = (1.0, 2.0, 3.0)  # a prism has none
    assert changes_since(monkey, last_run(monkey)) == []
    for name, value in (("form_sides", 5), ("cubeness", 0.2), ("orientation", (0, 0, 1))):
        before = getattr(region, name)
        before = before if isinstance(before, int | float) else tuple(before)
        setattr(region, name, value)
        assert changes_since(monkey, last_run(monkey)) == ["Regions"]
        setattr(region, name, before)
    assert changes_since(monkey, last_run(monkey)) == []
    monkey.cubic_craft.use_regions = False
    assert "Regions" in changes_since(monkey, last_run(monkey))


def test_live_follows_a_region(live, begin):
    obj = add_triangles()
    add_group(obj, "Top", blended)
    region = add_region(obj, "Top", form="OCTAHEDRON")
    session = begin(obj)
    tick_to_rest(session)
    before = bits(obj)
    region.form = "PYRAMID"
    session.wake()
    tick_to_rest(session)
    assert bits(obj) != before
    before = bits(obj)
    obj.vertex_groups["Top"].add(list(range(100)), 0.0, "REPLACE")
    obj.data.update()
    session.wake()
    tick_to_rest(session)
    live.live_properties().use_regions = False
    tick_to_rest(session)
    live.live_properties().use_regions = True
    tick_to_rest(session)
    confirm(live, session)
    check_same_as_cubify(obj)


def test_adding_and_removing(extension):
    monkey = add_monkey()
    select(monkey)
    assert (
        not bpy.ops.cubic_craft.region_add.poll() and not bpy.ops.cubic_craft.region_remove.poll()
    )
    for name in ("One", "Two"):
        monkey.vertex_groups.new(name=name)
    monkey.vertex_groups.active_index = 1
    monkey.cubic_craft.form, monkey.cubic_craft.cubeness = "PYRAMID", 0.25
    assert bpy.ops.cubic_craft.region_add() == {"FINISHED"}
    assert bpy.ops.cubic_craft.region_add() == {"FINISHED"}
    regions = monkey.cubic_craft.regions
    assert [region.group for region in regions] == ["Two", "One"]
    assert regions[1].form == "PYRAMID" and regions[1].cubeness == 0.25
    with pytest.raises(RuntimeError, match="Every vertex group already is a region"):
        bpy.ops.cubic_craft.region_add()
    with pytest.raises(RuntimeError, match='"One" already is a region'):
        bpy.ops.cubic_craft.region_add(group="One")
    assert monkey.cubic_craft.active_region == 1
    assert bpy.ops.cubic_craft.region_remove() == {"FINISHED"}
    assert [region.group for region in regions] == ["Two"] and monkey.cubic_craft.active_region == 0
    assert len(monkey.vertex_groups) == 2


def test_a_region_from_the_selection():
    monkey = add_monkey()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    with pytest.raises(RuntimeError, match="All vertices are selected"):
        bpy.ops.cubic_craft.region_from_selection()
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="No vertex is selected"):
        bpy.ops.cubic_craft.region_from_selection()
    bpy.ops.object.mode_set(mode="OBJECT")
    for vertex in monkey.data.vertices:
        vertex.select = vertex.co.z > 0.3
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.cubic_craft.region_from_selection() == {"FINISHED"}
    assert monkey.mode == "OBJECT"
    region = monkey.cubic_craft.regions[0]
    index = monkey.vertex_groups[region.group].index
    members = [v.index for v in monkey.data.vertices if any(g.group == index for g in v.groups)]
    assert members == [v.index for v in monkey.data.vertices if v.co.z > 0.3]

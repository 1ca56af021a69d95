# SPDX-License-Identifier: GPL-3.0-or-later
"""Shade Edges Sharp: sharp edges of crisp shapes, which follow them."""

import bpy
import numpy as np
import pytest
from scene import add_monkey, cubify


def sharp(mesh):
    """Return which edges are sharp, or None."""
    marks = mesh.attributes.get("sharp_edge")
    return None if marks is None else np.array([each.value for each in marks.data])


def expected(mesh):
    """Return which edges turn by more than 30 degrees."""
    copy = mesh.copy()
    copy.set_sharp_from_angle(angle=np.radians(30.0))
    found = sharp(copy)
    bpy.data.meshes.remove(copy)
    return found


@pytest.fixture
def monkey():
    obj = add_monkey()
    obj.data.shade_smooth()
    cubify(cubeness=0.4)
    return obj


def test_marks_follow_the_shape_until_restore(monkey):
    mesh = monkey.data
    assert bpy.ops.cubic_craft.shade_edges() == {"FINISHED"}
    first = sharp(mesh)
    assert first.sum() > 20 and np.array_equal(first, expected(mesh))
    cubify(cubeness=0.4, orientation=(0.0, 0.0, 0.6))
    assert not np.array_equal(sharp(mesh), first)
    assert np.array_equal(sharp(mesh), expected(mesh))
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert sharp(mesh) is None and not list(mesh.keys())


def test_a_second_click_takes_them_back_and_apply_keeps_them(monkey):
    mesh = monkey.data
    bpy.ops.cubic_craft.shade_edges()
    bpy.ops.cubic_craft.shade_edges()
    assert sharp(mesh) is None
    bpy.ops.cubic_craft.shade_edges()
    marks = sharp(mesh)
    bpy.ops.cubic_craft.apply()
    assert np.array_equal(sharp(mesh), marks) and not list(mesh.keys())


def test_marks_that_the_artist_has_removed_do_not_keep_restore_from_its_work(monkey):
    mesh = monkey.data
    bpy.ops.cubic_craft.shade_edges()
    mesh.attributes.remove(mesh.attributes["sharp_edge"])
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert sharp(mesh) is None and not list(mesh.keys())


def test_what_looks_as_the_artist_wants_is_not_touched(monkey, part):
    seen, mesh = part("ui.seen"), monkey.data
    subdivision = monkey.modifiers.new("Subdivision", "SUBSURF")
    assert not seen.is_rounded(monkey), "to be round is what it is for"
    subdivision.show_viewport = False
    assert seen.is_rounded(monkey)
    mesh.edges[7].use_edge_sharp = True
    assert not seen.is_rounded(monkey) and not bpy.ops.cubic_craft.shade_edges.poll()
    mesh.attributes.remove(mesh.attributes["sharp_edge"])
    mesh.shade_flat()
    assert not seen.is_rounded(monkey)
    mesh.shade_smooth()
    cubify(crispness=0.0)
    assert not seen.is_rounded(monkey), "it has no edges"

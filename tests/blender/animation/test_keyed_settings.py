# SPDX-License-Identifier: GPL-3.0-or-later
"""A frame is solved with the values that all settings have in it, not with those of the first."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from solver.method import Computation
from solver.setting import declared

import bpy  # isort: skip
from rig import FRAMES, bending_ball, read_pc2, shown  # isort: skip
from scene import add_empty, add_monkey, select  # isort: skip

LAST = 3
"""the last frame, and the second with the values that count"""
NEAR = 0.05
"""of the difference that the setting makes: as far as two ways to the same frame may end apart"""
CASES = {
    # setting: value in the first frame, and from the second on
    "cubeness": (0.2, 0.6),
    "crispness": (0.3, 0.9),
    "form": ("CUBE", "OCTAHEDRON"),
    "form_sides": (3, 6),
    "form_weights": ((1.0, 1.0, 1.0), (0.0, 0.0, 1.0)),
    "orientation": ((0.0, 0.0, 0.0), (0.5, 0.4, 0.0)),
    "space": ("WORLD", "OBJECT"),
    "use_handles": (False, True),
    "use_regions": (True, False),
    "map_invert": (False, True),
    "solidity": (0.0, 3.0),
    "keep_pose": (False, True),
    "detail": (0.0, 0.3),
    "detail_strength": (0.0, 2.0),
    "rotation": ("KEEP", "FREE"),
    "hold_rest": (False, True),
    "floor": ("OFF", "ON"),
    "handles[0].is_cubic": (True, False),
    "handles[0].mode": ("PINNED", "FOLLOW"),
    "handles[0].threshold": (0.9, 0.4),
    "regions[0].cubeness": (0.0, 1.0),
    "regions[0].form": ("CUBE", "OCTAHEDRON"),
    "regions[0].form_sides": (3, 6),
    "regions[0].form_weights": ((1.0, 1.0, 1.0), (0.0, 0.0, 1.0)),
    "regions[0].orientation": ((0.0, 0.0, 0.0), (0.5, 0.4, 0.0)),
}


@pytest.fixture
def bending(empty_file):
    return bending_ball()


@pytest.fixture
def limb(empty_file):
    """Return a bumpy limb that bends, with a handle, a region and a map that are not used yet."""
    obj = bending_ball()
    obj.cubic_craft.crispness = 0.0  # or sides stay with their triangles as before
    points = np.empty((len(obj.data.vertices), 3), np.float32)
    obj.data.vertices.foreach_get("co", points.ravel())
    points *= 1.0 + 0.06 * np.sin(9.0 * points[:, :1]) * np.sin(8.0 * points[:, 1:2] + 1.0)
    points *= (0.45, 0.55, 1.0)
    obj.data.vertices.foreach_set("co", points.ravel())
    z = points[:, 2]
    weights = {"Top": z - 0.2, "Half": 0.5 + points[:, 1], "Band": 1.0 - 2.0 * np.abs(z)}
    for name, values in weights.items():
        group = obj.vertex_groups.new(name=name)
        for index, weight in enumerate(np.clip(values, 0.0, 1.0).tolist()):
            group.add([index], weight, "REPLACE")
    return obj


def add_handle(obj):
    """Let the top follow an empty that is moved in all frames."""
    bpy.ops.cubic_craft.handle_add(group="Top")
    obj.cubic_craft.handles[0].is_cubic = False
    empty = add_empty("Target")
    obj.cubic_craft.handles[0].target = empty
    empty.location = (0.4, 0.2, 0.3)


def add_region(obj):
    region = obj.cubic_craft.regions.add()
    region.group, region.cubeness = "Band", 0.9
    return region


def prepare(obj, name):
    """Let a setting have an effect."""
    settings = obj.cubic_craft
    name, _, of_item = name.partition("[0].")
    if name in ("use_handles", "hold_rest", "handles"):
        add_handle(obj)
    if of_item == "mode":
        settings.map_group = "Half"  # a handle that moves leaves nothing still
    if name in ("use_regions", "regions"):
        add_region(obj)
    for owner in (settings, *settings.regions[:1]):
        if "form_sides" in (name, of_item):
            owner.form = "PRISM"
        if "form_weights" in (name, of_item):
            owner.form = "BOX"
    if name == "map_invert":
        settings.map_group = "Half"
    if name == "space":
        obj.rotation_euler = (0.4, 0.3, 0.0)
    if name == "floor":
        obj.location.z = 1.0 - min(vertex.co.z for vertex in obj.data.vertices)


def owner_of(obj, name):
    """Return what has a setting, and its name there."""
    path, _, last = name.rpartition(".")
    return (obj.cubic_craft.path_resolve(path) if path else obj.cubic_craft), last


def last_frame(part, objects, name, *keys):
    """Return the positions (n,3) in the last frame, with a setting of the first keyed."""
    obj = objects[0]
    obj.animation_data_clear()
    owner, last = owner_of(obj, name)
    for frame, value in enumerate(keys, start=1):
        setattr(owner, last, value)
        assert owner.keyframe_insert(last, frame=frame)
    animated = part("animation.animated")
    scene = bpy.context.scene
    scene.frame_set(1)
    made = [animated.Animated(one, part("mesh_bridge").make_seen(one)) for one in objects]
    group = animated.AnimatedGroup(made, part("animation.sources").settings_of_sources(objects))
    for frame in range(1, LAST + 1):
        scene.frame_set(frame)
        frames = drained(group.solve())
    return frames.results(0.0)[0]


def drained(generator):
    while True:
        try:
            next(generator)
        except StopIteration as end:
            return end.value


def test_no_setting_that_can_be_keyed_is_forgotten_here(extension, part, empty_file):
    known = bpy.types.Object.bl_rna.properties["cubic_craft"].fixed_type.properties
    names = (name for name in part("settings.overrides").ALL if known[name].type != "STRING")
    keyed = {name for name in names if known[name].is_animatable}
    refused = set(part("animation.sources").OF_ALL_FRAMES)
    left_out = set(part("settings.values").IN_ANIMATION) - {"start"}
    checked = {name for name in CASES if "[" not in name}
    assert keyed == checked | left_out | set(declared(Computation)) | refused


@pytest.mark.thorough(8)
@pytest.mark.parametrize("name", CASES)
def test_a_frame_has_the_values_of_that_frame(extension, part, limb, name):
    prepare(limb, name)
    check(part, [limb], name)


def test_so_have_objects_that_are_solved_together_and_move(extension, part, limb):
    hat = limb.copy()
    bpy.context.scene.collection.objects.link(hat)
    hat.location.z = 1.3
    carrier = add_empty("Carrier")
    for frame, carrier.rotation_euler.z, carrier.scale.x in ((1, 0.0, 1.0), (LAST, 0.5, 1.2)):
        carrier.keyframe_insert("rotation_euler", frame=frame)
        carrier.keyframe_insert("scale", frame=frame)
    limb.parent = hat.parent = carrier
    check(part, [limb, hat], "solidity")


def check(part, objects, name):
    first, last = CASES[name]
    keyed = last_frame(part, objects, name, first, last)
    wanted = last_frame(part, objects, name, last)
    other = last_frame(part, objects, name, first)
    makes, off = (float(np.sqrt(((x - wanted) ** 2).sum(axis=1).mean())) for x in (other, keyed))
    assert makes > 0.002, "the setting has no effect here"
    assert off < NEAR * makes


def test_what_a_frame_depends_on_is_a_part_of_its_moment(part, empty_file):
    read, obj = part("read.member"), add_monkey()
    member = read.read_member(obj, part("settings.properties").settings_of(obj))
    shape = read.ShapeRead(member.shape.original + 1.0, member.shape.triangles)
    others = (
        {"settings": replace(member.settings, cubeness=0.9)},
        {"shape": shape},
        {"alone": SimpleNamespace(key="another")},
        {"bones": SimpleNamespace(pose="bent")},
    )
    moments = [part("animation.animated")._moment(replace(member, **o)) for o in ({}, *others)]
    assert len(set(map(repr, moments))) == len(moments)


def test_animated_settings_of_the_active_object_count_for_all(extension, bending, tmp_path):
    other = add_monkey("Other")
    for frame, cubeness in ((1, 0.0), (FRAMES, 0.4)):
        bending.cubic_craft.cubeness = cubeness
        bending.cubic_craft.keyframe_insert("cubeness", frame=frame)
    other.cubic_craft.cubeness = 1.0
    select(bending, other)
    bpy.context.scene.frame_set(FRAMES)
    bpy.ops.cubic_craft.bake_animation(folder=str(tmp_path))
    moved = np.abs(read_pc2(tmp_path / "Other.pc2") - shown(other, 1)).max(axis=(1, 2))
    assert moved[0] < 0.02 and moved[-1] > 0.1


@pytest.mark.parametrize("way", ["key", "driver", "track", "region"])
def test_the_panel_names_the_settings_that_are_animated(part, empty_file, way):
    sources = part("animation.sources")
    obj = add_monkey()
    obj.keyframe_insert("location", frame=1)
    obj.driver_add("scale")
    assert not sources.animated_settings(obj)
    settings = obj.cubic_craft
    if way == "driver":
        obj.driver_add("cubic_craft.max_iterations")
        assert [*sources.animated_settings(obj).values()] == ["Max Iterations"]
        return
    if way == "region":
        settings.regions.add().keyframe_insert("cubeness", frame=1)
        assert [*sources.animated_settings(obj).values()] == ["Regions"]
        return
    settings.keyframe_insert("cubeness", frame=1)
    settings.keyframe_insert("orientation", frame=1)
    if way == "track":
        strips, action = obj.animation_data.nla_tracks.new().strips, obj.animation_data.action
        slot = getattr(obj.animation_data, "action_slot", None)
        strip = strips.new("All", 1, action)
        if slot is not None:
            strip.action_slot = slot
        obj.animation_data.action = None
    assert [*sources.animated_settings(obj).values()] == ["Cubeness", "Orientation"]


@pytest.mark.parametrize("name", ["together", "refine"])
def test_what_cannot_be_animated_is_refused_by_name(extension, bending, tmp_path, name):
    bending.cubic_craft.keyframe_insert(name, frame=1)
    label = bending.cubic_craft.bl_rna.properties[name].name
    with pytest.raises(RuntimeError, match=f'"Ball": {label} cannot be animated'):
        bpy.ops.cubic_craft.bake_animation(folder=str(tmp_path))
    assert not [*tmp_path.iterdir()]

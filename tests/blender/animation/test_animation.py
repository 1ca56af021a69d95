# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify Animation: each frame is cubic, steady, played back, and kept when it is stopped."""

import importlib
import math
import os
import tracemalloc

import numpy as np
import pytest

import bpy  # isort: skip
from mathutils import Matrix  # isort: skip
from rig import FRAMES, bending_ball, flatness, read_pc2, shown  # isort: skip
from scene import select  # isort: skip

SUFFIXES = (".pc2", ".abc", ".usdc")


@pytest.fixture
def bending(empty_file):
    return bending_ball()


def bake(folder, **options):
    return bpy.ops.cubic_craft.bake_animation(folder=str(folder), **options)


def film(obj):
    """Return the visible positions in all frames."""
    return np.array([shown(obj, frame) for frame in range(1, FRAMES + 1)])


@pytest.fixture
def bakes(part):
    """Return a function that makes a Bake of objects, for tests that stop it."""

    def make(folder, *sources):
        module = part("animation.bake")
        options = module.BakeOptions(1, FRAMES, folder)
        return module.Bake(
            part("settings.overrides").SettingsOverrides({}).settings_for, sources, options
        )

    return make


def advance(work, frame):
    """Continue a Bake until it begins a frame."""
    for step in work.steps():
        if step.texts[-1].startswith(f"Frame {frame} "):
            return
    raise AssertionError("it has ended before")


@pytest.mark.thorough(2)
@pytest.mark.parametrize("file_format", ["CACHE", "ALEMBIC", "USD", "SHAPE_KEYS"])
def test_every_frame_is_cubic_and_played_back(extension, bending, tmp_path, file_format):
    if file_format == "CACHE":
        bending.cubic_craft.refine = "AUTO"  # the default
    before, mesh = film(bending), bending.data
    stored = [tuple(vertex.co) for vertex in mesh.vertices]
    bpy.context.scene.frame_set(3)
    assert bake(tmp_path) == {"FINISHED"}
    assert bpy.context.scene.frame_current == 3
    assert [tuple(vertex.co) for vertex in mesh.vertices] == stored
    cached = read_pc2(tmp_path / "Ball.pc2")
    cubic = bpy.context.object
    assert cubic.name == "Ball Cubic" and cubic.select_get() and bending.hide_get()
    if file_format != "CACHE":
        bending.cubic_craft.cubeness = 0.2
        assert bake(tmp_path) == {"FINISHED"}
        bending.cubic_craft.cubeness = 0.4
        assert bake(tmp_path, format=file_format) == {"FINISHED"}  # of the object it was baked from
        assert bpy.context.object == cubic
        assert [o.name for o in bpy.data.objects if o.type == "MESH"] == ["Ball", "Ball Cubic"]
    after = film(cubic)
    np.testing.assert_allclose(after, cached, atol=1e-6)
    for old, new in zip(before, after, strict=True):
        assert flatness(new, mesh) > flatness(old, mesh) + 0.3
        np.testing.assert_allclose(new.mean(axis=0), old.mean(axis=0), atol=0.05)
    assert not [path for path in tmp_path.iterdir() if path.suffix not in SUFFIXES]


@pytest.mark.thorough(2)
@pytest.mark.parametrize("file_format", ["CACHE", "ALEMBIC", "USD", "SHAPE_KEYS"])
@pytest.mark.parametrize("stretching", [(200, 100), (30, 70)])
def test_what_is_stretched_in_time_plays_as_its_source(
    extension, empty_file, tmp_path, file_format, stretching
):
    scene, plane = bpy.context.scene, flat_faces("Ball", 2.0)
    scene.frame_start, scene.frame_end = 3, 3 + FRAMES
    scene.render.frame_map_old, scene.render.frame_map_new = stretching
    modifier = plane.modifiers.new("Wide", "SIMPLE_DEFORM")
    modifier.deform_method = "STRETCH"
    for frame, modifier.factor in ((1, 1.0), (2 * FRAMES, 5.0)):
        modifier.keyframe_insert("factor", frame=frame)
    frames = range(3, 4 + FRAMES)
    before = np.array([shown(plane, frame) for frame in frames])
    assert bake(tmp_path, format=file_format) == {"FINISHED"}
    after = np.array([shown(bpy.context.object, frame) for frame in frames])
    np.testing.assert_allclose(after, before, atol=1e-4)
    assert np.ptp(after, axis=0).max() > 0.2, "it does not move"


def test_other_stretching_begins_anew_and_too_much_is_refused(extension, bending, bakes, tmp_path):
    work = bakes(tmp_path, bending)
    advance(work, 4)
    work.discard()
    render = bpy.context.scene.render
    render.frame_map_new = 200
    other = bakes(tmp_path, bending)
    advance(other, 1)
    other.discard()
    render.frame_map_old, render.frame_map_new = 1, 101
    with pytest.raises(RuntimeError, match="Time Stretching by more than 100 times"):
        bake(tmp_path)


def test_the_baked_object_keeps_uvs_materials_and_groups(extension, bending, tmp_path):
    bending.data.materials.append(bpy.data.materials.new("Clay"))
    bake(tmp_path)
    cubic = bpy.context.object
    assert [layer.name for layer in cubic.data.uv_layers] == ["UVMap"]
    assert [slot.name for slot in cubic.material_slots] == ["Clay"]
    assert [group.name for group in cubic.vertex_groups] == ["Low", "High"]
    assert [modifier.type for modifier in cubic.modifiers] == ["MESH_CACHE"]


def test_objects_that_are_kept_together(extension, bending, tmp_path):
    hat = bending.copy()
    hat.data = bending.data.copy()
    hat.name = "Hat"
    hat.data.transform(Matrix.Translation((0.0, 0.0, 1.0)) @ Matrix.Scale(0.4, 4))
    bpy.context.scene.collection.objects.link(hat)
    bpy.context.scene.frame_end = 4
    select(bending, hat)
    assert bake(tmp_path) == {"FINISHED"}
    assert sorted(path.name for path in tmp_path.iterdir()) == ["Ball.pc2", "Hat.pc2"]
    assert {obj.name for obj in bpy.context.selected_objects} == {"Ball Cubic", "Hat Cubic"}
    for file_format in ("CACHE", "SHAPE_KEYS"):
        assert bake(tmp_path, format=file_format) == {"FINISHED"}
        for name in ("Ball", "Hat"):
            played = shown(bpy.data.objects[f"{name} Cubic"], 4)
            np.testing.assert_allclose(played, read_pc2(tmp_path / f"{name}.pc2")[3], atol=1e-6)


def flat_faces(name, size):
    """Add a plane of one face, which takes no time."""
    bpy.ops.mesh.primitive_plane_add(size=size)
    bpy.context.object.name = name
    return bpy.context.object


@pytest.mark.thorough(2)
@pytest.mark.parametrize("names", [("Eye.L", "Eye_L"), ("Bär", "Bör"), ("arm", "Arm")])
@pytest.mark.parametrize("is_one_click", [True, False])
def test_objects_whose_names_give_one_file_have_their_own(
    extension, empty_file, tmp_path, names, is_one_click
):
    objects = [flat_faces(name, size) for size, name in enumerate(names, 1)]
    bpy.context.scene.frame_end = 2
    for chosen in [objects] if is_one_click else [[obj] for obj in objects]:
        select(*chosen)
        assert bake(tmp_path) == {"FINISHED"}
    files = sorted(path.name for path in tmp_path.iterdir())
    assert len(files) == len({name.casefold() for name in files}) == 2
    for size, obj in enumerate(objects, 1):
        played = shown(bpy.data.objects[f"{obj.name} Cubic"], 1)
        np.testing.assert_allclose(np.ptp(played, axis=0)[:2], size, atol=1e-4)
    select(*(bpy.data.objects[f"{obj.name} Cubic"] for obj in objects))
    assert bake(tmp_path) == {"FINISHED"}
    assert sorted(path.name for path in tmp_path.iterdir()) == files, "names have changed"


@pytest.mark.thorough(1)
@pytest.mark.parametrize("file_format", ["CACHE", "ALEMBIC", "SHAPE_KEYS"])
def test_a_file_that_another_object_plays_is_not_replaced(
    extension, empty_file, tmp_path, file_format
):
    old = flat_faces("Ball", 1.0)
    bpy.context.scene.frame_end = 2
    bake(tmp_path)
    cubic, written = bpy.context.object, (tmp_path / "Ball.pc2").read_bytes()
    old.name = "Leg"
    flat_faces("Ball", 2.0)
    for _ in range(2):  # and it replaces its own
        assert bake(tmp_path, format=file_format) == {"FINISHED"}
    assert (tmp_path / "Ball.pc2").read_bytes() == written
    np.testing.assert_allclose(np.ptp(shown(cubic, 1), axis=0)[:2], 1.0, atol=1e-4)
    more = {"CACHE": ["Ball.2.pc2"], "ALEMBIC": ["Ball.abc"], "SHAPE_KEYS": []}[file_format]
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([*more, "Ball.pc2"])


def test_names_of_files(extension, empty_file, part):
    names = part("environment.file_names")
    long = "身体" * 10
    items = [bpy.data.objects.new(name, None) for name in ("a.b", "a_b", "A_B", "c", long * 3)]
    stems = list(names.file_stems(items).values())
    assert stems[3] == "c"
    assert len({stem.casefold() for stem in stems}) == len(stems)
    assert all(stem.casefold().startswith("a_b.") for stem in stems[:3])
    assert names.file_stem(long) == long
    assert names.file_stem(long * 9) != names.file_stem(long * 8)
    assert len(names.file_stem(long * 9).encode()) < 120


def test_a_text_that_grows_is_baked(extension, empty_file, tmp_path):
    bpy.ops.object.text_add()
    text = bpy.context.object
    text.data.body = "I"
    for frame, depth in ((1, 0.05), (4, 0.3)):
        text.data.extrude = depth
        text.data.keyframe_insert("extrude", frame=frame)
    bpy.context.scene.frame_end = 4
    assert bake(tmp_path) == {"FINISHED"}
    cached = read_pc2(tmp_path / "Text.pc2")
    depths = np.ptp(cached[:, :, 2], axis=1)
    np.testing.assert_allclose(depths, [0.1, 0.2666, 0.4333, 0.6], atol=0.06)


@pytest.mark.parametrize("is_keyed", [False, True])
def test_a_stopped_bake_keeps_its_frames_and_continues_bit_for_bit(
    extension, bending, bakes, tmp_path, is_keyed
):
    if is_keyed:
        for frame, bending.cubic_craft.solidity in ((1, 0.0), (FRAMES, 1.0)):
            bending.cubic_craft.keyframe_insert("solidity", frame=frame)
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    bake(whole)
    work = bakes(parts, bending)
    advance(work, 6)
    work.stop()
    summary, problems = work.write(is_alone=True)
    work.discard()
    assert f"Frames 1 to 5 of {FRAMES}" in summary and not problems
    assert len(read_pc2(parts / "Ball.pc2")) == 5
    assert bake(parts) == {"FINISHED"}
    assert [path.name for path in parts.iterdir()] == ["Ball.pc2"]
    np.testing.assert_array_equal(read_pc2(parts / "Ball.pc2"), read_pc2(whole / "Ball.pc2"))


def test_after_other_settings_it_begins_anew(extension, bending, bakes, tmp_path):
    work = bakes(tmp_path, bending)
    advance(work, 4)
    work.discard()
    assert [path.name for path in tmp_path.iterdir()] == ["Ball.unfinished"]
    bending.cubic_craft.cubeness = 1.0
    other = bakes(tmp_path, bending)
    advance(other, 1)
    other.discard()


def test_what_another_bake_works_on_is_left_to_it(extension, bending, bakes, tmp_path):
    bpy.context.scene.frame_end = FRAMES
    work = bakes(tmp_path, bending)
    advance(work, 3)
    with pytest.raises(RuntimeError, match=r'"Ball\.unfinished" is being written by another'):
        bake(tmp_path)
    work.discard()
    assert [path.name for path in tmp_path.iterdir()] == ["Ball.unfinished"]
    assert bake(tmp_path) == {"FINISHED"}
    assert [path.name for path in tmp_path.iterdir()] == ["Ball.pc2"]


@pytest.fixture
def recorded(extension, part, tmp_path):
    """Return a function that continues a recording of three vertices, whose frames are numbers."""
    solver = importlib.import_module(f"{extension.__name__}.solver")
    turns = np.tile(np.eye(3), (3, 1, 1))
    state = solver.SequenceState(*(np.zeros(3) for _ in solver.SequenceState._fields))

    def make(frames):
        recording = part("animation.recording").Recording(tmp_path / "R", {}, 3)
        known = recording.count
        for number in frames:
            positions = np.full((3, 3), float(number))
            recording.append(solver.frame_of(positions, turns, positions), state, "")
        recording.save_state()
        pieces = [piece.inputs[:, 0, 0] for _, piece in recording.pieces(slice(0, 3))]
        recording.release()
        return known, np.concatenate(pieces).tolist()

    return make


def test_frames_that_are_not_those_saved_are_solved_again(recorded, tmp_path):
    assert recorded([0, 1, 2]) == (0, [0.0, 1.0, 2.0])
    path = tmp_path / "R" / "frames.f32"
    frames = path.read_bytes()
    size = len(frames) // 3
    path.write_bytes(frames + frames[:size])  # as when ended before the next save
    assert recorded([3]) == (3, [0.0, 1.0, 2.0, 3.0])
    path.write_bytes(frames[:size] + frames)  # another process has written, too
    assert recorded([0]) == (0, [0.0])
    path.write_bytes(b"")
    assert recorded([0]) == (0, [0.0])
    (tmp_path / "R" / "state.npz").write_bytes(b"PK half of it")
    assert recorded([0]) == (0, [0.0])


def test_a_mesh_that_changes_its_vertices_is_baked_until_then(extension, bending, tmp_path):
    modifier = bending.modifiers.new("Mask", "MASK")
    modifier.vertex_group = "High"
    for frame, is_on in ((1, False), (5, True)):
        modifier.show_viewport = is_on
        modifier.keyframe_insert("show_viewport", frame=frame)
    assert bake(tmp_path) == {"FINISHED"}
    assert len(read_pc2(tmp_path / "Ball.pc2")) == 4


def test_nothing_is_left_of_a_bake_that_cannot_begin(extension, bending, tmp_path):
    objects, hidden = list(bpy.data.objects), bending.hide_get()
    with pytest.raises(RuntimeError, match=r"the last frame comes before the first"):
        bake(tmp_path, frame_start=5, frame_end=4)
    with pytest.raises(RuntimeError, match=r"Save the \.blend file first"):
        bake("//here")
    (tmp_path / "file").touch()
    with pytest.raises(RuntimeError, match="cannot be made"):
        bake(tmp_path / "file" / "folder")
    bending.data.vertices[0].co.x = math.nan
    with pytest.raises(RuntimeError, match="finite"):
        bake(tmp_path)
    assert list(bpy.data.objects) == objects and bending.hide_get() == hidden
    assert bpy.context.scene.frame_current == 1


def test_it_is_there_after_the_file_was_saved_and_opened(extension, bending, reopen, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    assert bake("//baked") == {"FINISHED"}
    before = film(bpy.context.object)
    cubic = reopen("Ball Cubic")
    assert cubic.modifiers[0].filepath == f"//baked{os.sep}Ball.pc2"
    np.testing.assert_array_equal(film(cubic), before)


@pytest.mark.thorough(3)
@pytest.mark.parametrize("name", ["read_point_cache", "_play_cache", "_play_file", "_play_keys"])
@pytest.mark.parametrize("is_again", [False, True])
def test_what_fails_in_the_end_changes_nothing(
    extension, bending, part, tmp_path, monkeypatch, name, is_again
):
    bpy.context.scene.frame_end = 2
    if is_again:
        bake(tmp_path)
    before = everything_in(bpy.context.scene)
    playback = part("animation.playback")

    def fail(*_, **__):
        raise OSError("the disk is gone")

    monkeypatch.setattr(playback, name, fail)
    formats = {"_play_file": "ALEMBIC", "_play_keys": "SHAPE_KEYS"}
    with pytest.raises(RuntimeError, match="the disk is gone"):
        bake(tmp_path, format=formats.get(name, "CACHE"))
    assert everything_in(bpy.context.scene) == before
    monkeypatch.undo()
    assert bake(tmp_path) == {"FINISHED"}, "what was solved is lost"


def everything_in(scene):
    """Return all that a bake might change."""
    objects = [
        (obj.name, obj.hide_get(), obj.hide_render, obj.select_get(), obj.data.name)
        + tuple((modifier.name, modifier.type) for modifier in obj.modifiers)
        for obj in scene.objects
    ]
    meshes = sorted(mesh.name for mesh in bpy.data.meshes)
    return objects, meshes, scene.frame_current, bpy.context.object.name


def test_the_memory_is_the_same_for_any_number_of_frames(extension, part, tmp_path, monkeypatch):
    module = part("animation.recording")
    monkeypatch.setattr(module, "_PIECE", 400_000)
    solver = importlib.import_module(f"{extension.__name__}.solver")
    vertices, peaks = 100, []
    turns = np.tile(np.eye(3), (vertices, 1, 1))

    def recorded(count):
        recording = module.Recording(tmp_path / str(count), {}, vertices)
        for number in range(count):
            positions = np.full((vertices, 3), float(number))
            recording.append(solver.frame_of(positions, turns, positions), None, "")
        return lambda: (piece for _, piece in recording.pieces(slice(0, vertices)))

    for pieces in map(recorded, (100, 1000)):
        tracemalloc.start()
        solver.least_width(pieces)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.5 * peaks[0]


def test_a_point_cache_that_was_cut_off_is_refused(part, tmp_path):
    cache, path = part("animation.point_cache"), tmp_path / "a.pc2"
    with cache.new_point_cache(path, 3, 4) as positions:
        positions[:] = np.arange(36, dtype=np.float32).reshape(3, 4, 3)
    assert cache.read_point_cache(path)[2, 3].tolist() == [33.0, 34.0, 35.0]
    whole = path.read_bytes()
    for content, words in ((whole[:-1], "is incomplete"), (whole[1:], "is not a PC2 file")):
        path.write_bytes(content)
        with pytest.raises(Exception, match=words):
            cache.read_point_cache(path)


@pytest.mark.parametrize("way", ["exclude", "hide_viewport"])
def test_an_original_that_blender_does_not_evaluate_is_refused_first(
    extension, bending, tmp_path, way
):
    scene, kept = bpy.context.scene, bpy.data.collections.new("Kept")
    scene.frame_end = 2
    assert bake(tmp_path) == {"FINISHED"}
    first, cubic = (tmp_path / "Ball.pc2").read_bytes(), bpy.context.object
    scene.collection.children.link(kept)
    kept.objects.link(bending)
    scene.collection.objects.unlink(bending)
    collection = bpy.context.view_layer.layer_collection.children["Kept"]
    setattr(collection, way, True)
    select(cubic)
    with pytest.raises(RuntimeError, match='"Ball" or its collection is disabled or excluded'):
        bake(tmp_path)
    assert bpy.context.object == cubic and (tmp_path / "Ball.pc2").read_bytes() == first
    setattr(collection, way, False)
    bpy.context.view_layer.update()
    assert bake(tmp_path) == {"FINISHED"}
    assert (tmp_path / "Ball.pc2").read_bytes() == first

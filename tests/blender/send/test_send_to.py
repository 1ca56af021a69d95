# SPDX-License-Identifier: GPL-3.0-or-later
"""Send To: files in which the order of vertices and their groups are found again."""

import bpy
import numpy as np
import pytest
from flat_balls import add_ball
from glb import Glb, to_blender
from rich_mesh import add_rich_monkey, points_of, position_of
from scene import add_copy, add_monkey, cubify, edit_mode, reports_of, select
from snapshot import differences, snapshot_object

TARGETS = {"GLTF": ".glb", "FBX": ".fbx", "STL": ".stl"}

by_target = pytest.mark.parametrize("target", TARGETS)


def send(target, path, **options):
    return bpy.ops.cubic_craft.send_to(target=target, filepath=str(path), **options)


def weights_of(obj, name):
    index = obj.vertex_groups[name].index
    weights = np.zeros(len(obj.data.vertices))
    for vertex in obj.data.vertices:
        for element in vertex.groups:
            if element.group == index:
                weights[vertex.index] = element.weight
    return weights


def in_faces(mesh):
    return np.unique([corner.vertex_index for corner in mesh.loops])


def add_armature(obj, *names):
    """Add an armature with these bones one over the other, which poses the object."""
    bpy.ops.object.armature_add()
    armature = bpy.context.object
    with_bones(armature, names)
    obj.modifiers.new("Armature", "ARMATURE").object = armature
    obj.parent = armature
    height = position_of(obj.data)[:, 2]
    share = (height - height.min()) / np.ptp(height)
    for name, weights in zip(names, (1 - share, share), strict=True):
        group = obj.vertex_groups.new(name=name)
        for number, weight in enumerate(weights.tolist()):
            group.add([number], weight, "REPLACE")
    return armature


def with_bones(armature, names):
    bpy.ops.object.mode_set(mode="EDIT")
    bones = armature.data.edit_bones
    while bones:
        bones.remove(bones[0])
    for number, name in enumerate(names):
        bone = bones.new(name)
        bone.head, bone.tail = (0, 0, number), (0, 0, number + 1)
    bpy.ops.object.mode_set(mode="OBJECT")


def imported(path):
    before = set(bpy.data.objects)
    bpy.ops.import_scene.fbx(filepath=str(path))
    return {obj.type: obj for obj in set(bpy.data.objects) - before}


def read_stl(path):
    data = path.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    assert len(data) == 84 + 50 * count
    rows = np.frombuffer(data, np.uint8, offset=84).reshape(count, 50)
    return rows[:, 12:48].copy().view(np.float32).reshape(count, 3, 3)


def test_gltf_has_the_order_of_vertices(tmp_path):
    obj = add_rich_monkey(keys=False)
    cubify(cubeness=0.5)
    obj.modifiers.clear()
    send("GLTF", tmp_path / "monkey.glb")
    primitives = Glb(tmp_path / "monkey.glb").mesh(obj.name)
    assert len(primitives) == 2, "one for each material"
    found = []
    for primitive in primitives:
        vertices = np.rint(primitive["_VERTEX"]).astype(int)
        placed = to_blender(primitive["POSITION"])
        np.testing.assert_allclose(placed, position_of(obj.data)[vertices], atol=1e-6)
        found.append(vertices)
    found = np.concatenate(found)
    assert len(found) > len(obj.data.vertices), "split at seams and hard edges"
    assert np.array_equal(np.unique(found), in_faces(obj.data))


def test_gltf_has_the_groups(tmp_path):
    obj = add_rich_monkey(keys=False)
    obj.vertex_groups["Empty"].name = "pin"  # glTF writes capitals
    obj.modifiers.clear()
    send("GLTF", tmp_path / "monkey.glb")
    groups = {"_GROUP_PIN": "Pin", "_GROUP_MAP": "Map", "_GROUP_PIN_2": "pin"}
    for primitive in Glb(tmp_path / "monkey.glb").mesh(obj.name):
        vertices = np.rint(primitive["_VERTEX"]).astype(int)
        for attribute, name in groups.items():
            np.testing.assert_allclose(
                primitive[attribute], weights_of(obj, name)[vertices], atol=1e-6
            )
    send("GLTF", tmp_path / "without.glb", groups=False)
    assert not [
        name for p in Glb(tmp_path / "without.glb").mesh(obj.name) for name in p if "GROUP" in name
    ]


def test_gltf_has_bones_and_their_weights(tmp_path):
    obj = add_monkey()
    armature = add_armature(obj, "Lower", "Upper")
    armature.hide_set(True)
    select(obj)
    cubify()
    send("GLTF", tmp_path / "posed.glb")
    assert armature.hide_get() and not armature.select_get()
    glb = Glb(tmp_path / "posed.glb")
    names = [glb.json["nodes"][number]["name"] for number in glb.json["skins"][0]["joints"]]
    assert set(names) == {"Lower", "Upper"}
    (primitive,) = glb.mesh(obj.name)
    assert not [name for name in primitive if "GROUP" in name], "these groups are of bones"
    vertices = np.rint(primitive["_VERTEX"]).astype(int)
    for name in names:
        is_bone = primitive["JOINTS_0"] == names.index(name)
        weights = np.where(is_bone, primitive["WEIGHTS_0"], 0).sum(axis=1)
        np.testing.assert_allclose(weights, weights_of(obj, name)[vertices], atol=1e-5)


def test_gltf_has_shape_keys(tmp_path):
    obj = add_monkey()
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Smile")
    for number in range(0, 500, 5):
        key.data[number].co.z += 0.1
    cubify()
    obj.modifiers.new("Mirror", "MIRROR")
    printed = reports_of(lambda: send("GLTF", tmp_path / "keys.glb"))
    assert 'the modifiers of "Suzanne" were not' in printed
    (primitive,) = Glb(tmp_path / "keys.glb").mesh(obj.name)
    vertices = np.rint(primitive["_VERTEX"]).astype(int)
    smile = to_blender(primitive["POSITION"] + primitive["targets"][0])
    np.testing.assert_allclose(smile, points_of(obj.data, "Smile")[vertices], atol=1e-5)


def test_fbx_keeps_the_order_of_vertices_and_the_groups(tmp_path):
    obj = add_rich_monkey(keys=False)
    cubify(cubeness=0.5)
    obj.modifiers.clear()
    send("FBX", tmp_path / "monkey.fbx")
    back = imported(tmp_path / "monkey.fbx")["MESH"]
    assert len(back.data.vertices) == len(obj.data.vertices)
    np.testing.assert_allclose(position_of(back.data), position_of(obj.data), atol=1e-5)
    faces = [[list(face.vertices) for face in mesh.polygons] for mesh in (obj.data, back.data)]
    assert faces[0] == faces[1]
    corners = [corner.vertex_index for corner in back.data.loops]
    for name in ("Pin", "Map"):
        values = np.empty(4 * len(back.data.loops), np.float32)
        layer = back.data.color_attributes[f"_GROUP_{name}"]
        layer.data.foreach_get("color_srgb", values)
        expected = weights_of(obj, name)[corners]
        np.testing.assert_allclose(values.reshape(-1, 4)[:, 0], expected, atol=0.003)


def test_fbx_keeps_bones_without_leaves(tmp_path):
    obj = add_monkey()
    add_armature(obj, "Lower", "Upper")
    select(obj)
    send("FBX", tmp_path / "posed.fbx")
    back = imported(tmp_path / "posed.fbx")
    assert set(back["ARMATURE"].data.bones.keys()) == {"Lower", "Upper"}
    for name in ("Lower", "Upper"):
        np.testing.assert_allclose(weights_of(back["MESH"], name), weights_of(obj, name), atol=1e-5)


@pytest.mark.parametrize(
    ("options", "factor"),
    [({}, 1000), ({"scale": "MILLIMETERS"}, 1), ({"scale": "SIZE", "size": 80.0}, 40)],
)
def test_stl_is_closed_and_in_millimeters(tmp_path, options, factor):
    obj = add_ball()
    obj.scale.y = -1  # the exporter turns the faces over
    cubify()
    printed = reports_of(lambda: send("STL", tmp_path / "ball.stl", **options))
    assert "Warning" not in printed
    corners = read_stl(tmp_path / "ball.stl")
    assert len(corners) == 2 * len(obj.data.polygons)
    side = max(obj.dimensions)
    if options.get("scale") == "SIZE":
        factor = 80.0 / side
    assert np.ptp(corners.reshape(-1, 3), axis=0).max() == pytest.approx(side * factor, rel=1e-5)
    a, b, c = np.moveaxis(corners.astype(float), 1, 0)
    assert np.einsum("ij,ij->", a, np.cross(b, c)) > 0, "inside out"


@by_target
@pytest.mark.parametrize("keys", [True, False])
def test_nothing_changes(tmp_path, target, keys):
    other = add_monkey("Other")
    obj = add_rich_monkey(keys=keys)
    cubify()
    shared = add_copy(obj, is_linked=True)
    select(obj, other)
    shared.select_set(True)
    bpy.context.scene.frame_set(7, subframe=0.5)
    before = snapshot_object(obj)
    datas = {name: len(getattr(bpy.data, name)) for name in ("objects", "meshes", "scenes")}
    selected = set(bpy.context.selected_objects)
    assert send(target, tmp_path / "some") == {"FINISHED"}
    assert differences(before, snapshot_object(obj)) == []
    assert {name: len(getattr(bpy.data, name)) for name in datas} == datas
    assert set(bpy.context.selected_objects) == selected
    assert bpy.context.object == obj
    assert (bpy.context.scene.frame_current, bpy.context.scene.frame_subframe) == (7, 0.5)
    assert [path.name for path in tmp_path.iterdir()] == [f"some{TARGETS[target]}"]


@by_target
def test_a_failure_changes_nothing(tmp_path, target, part, monkeypatch):
    def fail(filepath, **options):
        with open(filepath, "w") as file:  # noqa: PTH123 - as the exporters do
            file.write("half of")
        raise RuntimeError("Error: the disk is full")

    obj = add_rich_monkey(keys=False)
    path = tmp_path / f"monkey{TARGETS[target]}"
    path.write_text("from before")
    monkeypatch.setattr(part("send.file"), "exporter", lambda target: fail)
    before = snapshot_object(obj)
    with pytest.raises(RuntimeError, match="cannot be written: the disk is full"):
        send(target, path)
    assert differences(before, snapshot_object(obj)) == []
    assert obj.select_get() and bpy.context.object == obj
    assert path.read_text() == "from before" and len(list(tmp_path.iterdir())) == 1


def test_an_exporter_that_is_off_is_named(tmp_path):
    add_monkey()
    bpy.ops.preferences.addon_disable(module="io_scene_gltf2")
    try:
        with pytest.raises(RuntimeError, match='enable the add-on "glTF 2'):
            send("GLTF", tmp_path / "monkey.glb")
    finally:
        bpy.ops.preferences.addon_enable(module="io_scene_gltf2")


@by_target
def test_the_suffix_is_that_of_the_target(tmp_path, target):
    add_ball()
    for name in ("a.v2", "a.v2.glb", "a.v2.fbx"):
        send(target, tmp_path / name)
        assert [path.name for path in tmp_path.iterdir()] == [f"a.v2{TARGETS[target]}"]


# Last, as Blender 4.2 may crash when it exports glTF after an Edit Mode (docs/reliability.md).


def test_refusals(tmp_path):
    obj = add_monkey()
    with pytest.raises(RuntimeError, match="there is no folder"):
        send("GLTF", tmp_path / "none" / "monkey.glb")
    with pytest.raises(RuntimeError, match="Type the name"):
        send("GLTF", "")
    (tmp_path / "folder.stl").mkdir()
    with pytest.raises(RuntimeError, match="is a folder"):
        send("STL", tmp_path / "folder")
    obj.data.clear_geometry()
    with pytest.raises(RuntimeError, match="has no faces"):
        send("FBX", tmp_path / "monkey.fbx")
    bpy.ops.mesh.primitive_cube_add()
    with edit_mode(bpy.context.object), pytest.raises(RuntimeError, match="Switch to Object Mode"):
        send("STL", tmp_path / "monkey.stl")

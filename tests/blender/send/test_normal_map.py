# SPDX-License-Identifier: GPL-3.0-or-later
"""Bake Normal Map: what the map says of the surface is what the cubic mesh has there."""

import bpy
import numpy as np
import pytest
from flat_balls import add_ball
from mathutils.bvhtree import BVHTree
from scene import add_monkey, cubify, edit_mode, reports_of, select
from snapshot import differences, snapshot_mesh, snapshot_object

LOST = 4.0  # times: how much closer the map brings the normals at the median
NEAR = 10.0  # degrees


def add_detailed(name="Suzanne", **where):
    """Add a smooth monkey of 2,012 vertices, cubified."""
    obj = add_monkey(name, **where)
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 1
    bpy.ops.object.modifier_apply(modifier="Subdivision")
    bpy.ops.object.shade_smooth()
    cubify()
    return obj


def add_rough():
    """Add a smooth monkey after a few iterations, for what does not depend on its shape."""
    obj = add_monkey()
    bpy.ops.object.shade_smooth()
    cubify(max_iterations=2)
    return obj


def fold_uvs(obj):
    """Lay one half of the UV map of an object over the other."""
    layer = obj.data.uv_layers.active
    values = corner_values(layer.uv, "vector", 2)
    values[:, 0] = np.abs(values[:, 0] - 0.5)
    layer.uv.foreach_set("vector", values.ravel())


def bake(**options):
    return bpy.ops.cubic_craft.bake_normal_map(**{"resolution": 64, **options})


def pixels(image):
    width, height = image.size
    values = np.empty((height, width, 4), np.float32)
    image.pixels.foreach_get(values.ravel())
    return values[..., :3]


def corner_values(items, name, size):
    values = np.empty(size * len(items), np.float32)
    items.foreach_get(name, values)
    return values.reshape(-1, size)


def triangles_of(mesh):
    mesh.calc_loop_triangles()
    vertices = np.empty(3 * len(mesh.loop_triangles), np.int32)
    corners = vertices.copy()
    mesh.loop_triangles.foreach_get("vertices", vertices)
    mesh.loop_triangles.foreach_get("loops", corners)
    return vertices.reshape(-1, 3), corners.reshape(-1, 3)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def angles(low, image, high, count=600):
    """Return the angles in degrees between the normals of the high-poly mesh and those of the map.

    And those without the map: both at points on the low-poly mesh. All in object space.
    """
    rng = np.random.default_rng(3)
    mesh = low.data
    name = mesh.uv_layers.active.name
    mesh.calc_tangents(uvmap=name)
    loops = mesh.loops
    N, T = corner_values(loops, "normal", 3), corner_values(loops, "tangent", 3)
    sign = corner_values(loops, "bitangent_sign", 1)
    uv = corner_values(mesh.uv_layers[name].uv, "vector", 2)
    V = corner_values(mesh.vertices, "co", 3)
    F, corners = triangles_of(mesh)
    areas = np.linalg.norm(np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), axis=1)
    chosen = rng.choice(len(F), count, p=areas / areas.sum())
    shares = rng.dirichlet((1, 1, 1), count)[..., None]
    points, places = ((shares * values).sum(1) for values in (V[F[chosen]], uv[corners[chosen]]))
    normal, tangent = ((shares * a[corners[chosen]]).sum(1) for a in (N, T))
    bitangent = sign[corners[chosen][:, 0]] * np.cross(normal, tangent)
    map_ = pixels(image)
    x, y = (places * map_.shape[0]).astype(int).clip(0, map_.shape[0] - 1).T
    x_, y_, z_ = np.moveaxis(map_[y, x] * 2 - 1, -1, 0)[..., None]
    mapped = unit(x_ * tangent + y_ * bitangent + z_ * normal)
    truth = nearest_normals(high, points)
    return [
        np.degrees(np.arccos(np.clip((unit(a) * truth).sum(1), -1, 1))) for a in (mapped, normal)
    ]


def nearest_normals(mesh, points):
    """Return the smooth normals of a mesh where it is nearest to points."""
    V, N = corner_values(mesh.vertices, "co", 3), corner_values(mesh.corner_normals, "vector", 3)
    F, corners = triangles_of(mesh)
    tree = BVHTree.FromPolygons(V.tolist(), F.tolist())
    found = [tree.find_nearest(point) for point in points.tolist()]
    faces = np.array([face for _, _, face, _ in found])
    a, b, c = np.moveaxis(V[F[faces]].astype(float), 1, 0)
    p = np.array([place for place, *_ in found])
    whole = np.cross(b - a, c - a)
    size = (whole * whole).sum(1)
    u, v = ((np.cross(*e) * whole).sum(1) / size for e in ((c - b, p - b), (a - c, p - c)))
    shares = np.stack([u, v, 1 - u - v], axis=1)[..., None]
    return unit((shares * N[corners[faces]]).sum(1))


@pytest.mark.thorough(1)
@pytest.mark.parametrize("overlap", [True, False])
def test_the_map_has_the_normals_of_the_cubic_mesh(overlap):
    obj = add_detailed(location=(3, 2, 1), rotation=(0.3, 0.2, 1.0))
    if overlap:
        fold_uvs(obj)
    before = snapshot_mesh(obj.data)
    printed = reports_of(lambda: bake(triangles=800, resolution=512))
    assert differences(before, snapshot_mesh(obj.data)) == []
    low, image = bpy.context.object, bpy.data.images["Suzanne Normal"]
    assert low.name == "Suzanne Low" and low.matrix_world == obj.matrix_world
    assert obj.hide_get() and not low.hide_get() and low.select_get()
    assert 700 <= len(low.data.polygons) <= 800 and "triangles" in printed
    assert all(len(face.vertices) == 3 for face in low.data.polygons)
    assert low.data.uv_layers.active.name == ("Normal Map" if overlap else "UVMap")
    assert image.colorspace_settings.name == "Non-Color" and tuple(image.size) == (512, 512)
    values = pixels(image)
    assert abs(values[..., :2].mean() - 0.5) < 0.02
    assert values[..., 2].mean() > 0.9 and values[..., 0].std() > 0.02
    with_map, without = angles(low, image, obj.data)
    assert np.median(with_map) < NEAR
    assert np.median(with_map) < np.median(without) / LOST


def bends(mesh):
    """Return the lengths of the edges of a mesh, and its bends there in degrees."""
    normals = np.array([face.normal for face in mesh.polygons])
    faces = {}
    for face in mesh.polygons:
        for key in face.edge_keys:
            faces.setdefault(key, []).append(normals[face.index])
    V = corner_values(mesh.vertices, "co", 3)
    pairs = [(key, two) for key, two in faces.items() if len(two) == 2]
    lengths = [np.linalg.norm(V[a] - V[b]) for (a, b), _ in pairs]
    cosines = [one @ other for _, (one, other) in pairs]
    return np.array(lengths), np.degrees(np.arccos(np.clip(cosines, -1, 1)))


@pytest.mark.thorough(1)
@pytest.mark.parametrize("triangles", [300, 1000])
def test_edges_of_levels_of_detail_lie_between_sides(triangles):
    """They are in a side, without a bend, or between sides, with a clear one."""
    add_detailed()
    bake(triangles=triangles)
    lengths, angles = bends(bpy.context.object.data)
    assert lengths[(angles > 5) & (angles < 25)].sum() < 0.29 * lengths.sum()


@pytest.mark.parametrize(("is_cut", "angle", "is_hard"), [(0, 40, 0), (1, 40, 1), (1, 20, 0)])
def test_edges_between_islands_are_hard_at_smaller_angles(part, is_cut, angle, is_hard):
    rise = np.tan(np.radians(angle))
    mesh = bpy.data.meshes.new("Bent")
    places = [(0, 0, 0), (0, 1, 0), (-1, 0, 0), (1, 0, rise)]
    mesh.from_pydata(places, [], [(0, 1, 2), (1, 0, 3)])
    corners = np.array([(0, 0), (0, 1), (-1, 0), (0, 1), (0, 0), (1, 0)], np.float32)
    corners[3:, 0] += 2.0 * is_cut
    mesh.uv_layers.new(name="UVMap").uv.foreach_set("vector", corners.ravel())
    part("send.low_poly").set_hard_edges(mesh, "UVMap")
    assert sum(edge.use_edge_sharp for edge in mesh.edges) == is_hard


def test_the_material_shows_the_map(part):
    obj = add_rough()
    skin = bpy.data.materials.new("Skin")
    if bpy.app.version < (5, 0):
        skin.use_nodes = True
    obj.data.materials.append(skin)
    fold_uvs(obj)
    bake()
    low = bpy.context.object
    material = low.material_slots[0].material
    assert material.name == "Skin Low" and obj.material_slots[0].material == skin
    assert "Normal Map" not in skin.node_tree.nodes
    has_normal_map = part("send.targets").has_normal_map
    assert has_normal_map(low) and not has_normal_map(obj), "a sent file needs tangents for it"
    (shader,) = [n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled"]
    normal = shader.inputs["Normal"].links[0].from_node
    texture = normal.inputs["Color"].links[0].from_node
    assert normal.uv_map == "Normal Map" and normal.space == "TANGENT"
    assert texture.image.name == "Suzanne Normal"
    assert texture.inputs["Vector"].links[0].from_node.uv_map == "Normal Map"
    rendered = [layer.name for layer in low.data.uv_layers if layer.active_render]
    assert rendered == ["UVMap"], "the textures of the artist stay where they are"


def test_a_mesh_without_uv_and_material_gets_both():
    obj = add_rough()
    obj.data.uv_layers.remove(obj.data.uv_layers[0])
    bake()
    low = bpy.context.object
    uv = corner_values(low.data.uv_layers["UVMap"].uv, "vector", 2)
    assert uv.min() >= 0 and uv.max() <= 1
    assert low.material_slots[0].material.name == "Suzanne Low"
    assert obj.mode == "OBJECT" and not obj.data.uv_layers


def test_scene_and_settings_are_kept():
    obj = add_rough()
    scene = bpy.context.scene
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.render.bake.cage_extrusion = 0.25
    scene.frame_set(12)
    before = {name: len(getattr(bpy.data, name)) for name in ("scenes", "objects", "meshes")}
    bake()
    assert bpy.context.object.data.uv_layers.active.name == "UVMap", "its charts do not overlap"
    assert scene.render.engine == "BLENDER_WORKBENCH"
    assert scene.render.bake.cage_extrusion == 0.25 and scene.frame_current == 12
    after = {name: len(getattr(bpy.data, name)) for name in before}
    assert after == {
        "scenes": before["scenes"],
        "objects": before["objects"] + 1,
        "meshes": before["meshes"] + 1,
    }
    assert obj.mode == "OBJECT" and bpy.context.scene == scene


def test_a_modifier_and_an_armature():
    """The first is a part of the low-poly mesh, the second poses it."""
    obj = add_rough()
    with edit_mode(obj) as edited:
        for vertex in [vertex for vertex in edited.verts if vertex.co.x < -1e-4]:
            edited.verts.remove(vertex)
    group = obj.vertex_groups.new(name="Bone")
    group.add(range(len(obj.data.vertices)), 1.0, "REPLACE")
    bpy.ops.object.armature_add()
    armature = bpy.context.object
    armature.pose.bones[0].location.z = 5
    obj.modifiers.new("Mirror", "MIRROR")
    obj.modifiers.new("Armature", "ARMATURE").object = armature
    select(obj)
    cubify(max_iterations=2)
    bake()
    low = bpy.context.object
    assert [modifier.type for modifier in low.modifiers] == ["ARMATURE"]
    x, _, z = corner_values(low.data.vertices, "co", 3).T
    assert x.min() == pytest.approx(-x.max(), rel=0.02), "mirrored"
    assert abs(z).max() < 3, "not posed twice"
    assert all(vertex.groups for vertex in low.data.vertices)


def key_points(key):
    return corner_values(key.data, "co", 3)


@pytest.mark.thorough(1)
@pytest.mark.parametrize(("triangles", "off"), [(300, 0.025), (1000, 0.017), (3000, 0.0075)])
def test_faces_keep_their_expressions_at_each_level_of_detail(triangles, off):
    add_detailed()
    obj = bpy.context.object
    bpy.ops.cubic_craft.restore()
    V = corner_values(obj.data.vertices, "co", 3)
    obj.shape_key_add(name="Basis", from_mix=False)
    for number in range(20):
        near = np.exp(-((V - V[97 * number]) ** 2).sum(1) / 0.08)[:, None]
        key = obj.shape_key_add(name=f"Key {number}", from_mix=False)
        key.points.foreach_set("co", (V + near * [0.0, 0.2, 0.1]).astype(np.float32).ravel())
    cubify(result="MESH")
    blocks = obj.data.shape_keys.key_blocks
    base, F = key_points(blocks[0]), triangles_of(obj.data)[0]
    bake(triangles=triangles)
    low = bpy.context.object
    assert 0.8 * triangles < len(low.data.polygons) <= triangles
    keys = low.data.shape_keys.key_blocks
    assert keys.keys() == blocks.keys()
    rest = key_points(keys[0])
    tree = BVHTree.FromPolygons(base.tolist(), F.tolist())
    around = F[[tree.find_nearest(point)[2] for point in rest.tolist()]]
    size = np.ptp(base, axis=0).max()
    margin = 0.01 * size
    still, farther = gaps(base, keys[0], low), []
    for old, new in zip(blocks[1:], keys[1:], strict=True):
        offsets, moved = (key_points(old) - base)[around], key_points(new) - rest
        is_near = (moved > offsets.min(axis=1) - margin) & (moved < offsets.max(axis=1) + margin)
        assert is_near.mean() > 0.99
        farther.append(gaps(key_points(old), new, low) - still)
    assert np.percentile(farther, 99.9) < off * size


def gaps(points, key, low):
    """Return how far points are from the surface of an object that a key moves."""
    tree = BVHTree.FromPolygons(key_points(key).tolist(), triangles_of(low.data)[0].tolist())
    return np.array([tree.find_nearest(point)[3] for point in points.tolist()])


def test_triangles_are_split_where_a_key_moves_them(part):
    split = part("send.split")
    x, y = (each.ravel() for each in np.meshgrid(*[np.linspace(0.0, 1.0, 41)] * 2))
    V = np.stack([x, y, 0.0 * x], axis=1)
    a = np.flatnonzero((x < 1.0) & (y < 1.0))
    F = np.concatenate([np.stack([a, a + 1, a + 42], 1), np.stack([a, a + 42, a + 41], 1)])
    bump = np.exp(-((V - [0.3, 0.3, 0.0]) ** 2).sum(axis=1) / 0.01)[:, None] * [0.0, 0.0, 0.2]
    mesh = bpy.data.meshes.new("Square")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2), (0, 2, 3)])
    uv = mesh.uv_layers.new(name="UVMap")
    uv.uv.foreach_set("vector", np.array([0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1], np.float32))
    still = split.OldSurface(V, F, {"Still": 0.0 * bump, "All": 0.0 * bump + 1.0})
    assert split.split_for_keys(mesh, still, 100) == 0
    surface = split.OldSurface(V, F, {"Bump": bump})
    added = split.split_for_keys(mesh, surface, 100)
    assert 90 < added <= 100 and len(mesh.polygons) == 2 + added
    P = corner_values(mesh.vertices, "co", 3)
    centers = np.array([P[list(face.vertices)].mean(axis=0) for face in mesh.polygons])
    is_far = np.linalg.norm(centers - [0.3, 0.3, 0.0], axis=1) > 0.4
    assert is_far.sum() < 0.2 * len(centers)
    assert sum(face.area for face in mesh.polygons) == pytest.approx(1.0)
    places = corner_values(mesh.uv_layers[0].uv, "vector", 2)
    np.testing.assert_allclose(places, P[[loop.vertex_index for loop in mesh.loops], :2], atol=1e-6)
    worst = split._errors(mesh, surface, np.arange(len(V))).max()
    assert worst < 0.02, "of a bump of 0.2"


def test_lips_that_touch_still_part():
    for z in (-0.5, 0.5):
        bpy.ops.mesh.primitive_cube_add(size=1.0, location=(0.0, 0.0, z))
    select(*bpy.context.scene.objects[-2:])
    bpy.ops.object.join()
    obj = bpy.context.object
    bpy.ops.object.transform_apply(location=True)
    obj.shape_key_add(name="Basis", from_mix=False)
    key = obj.shape_key_add(name="Open", from_mix=False)
    V = key_points(key)
    is_upper = np.arange(len(V)) >= len(V) // 2
    if V[is_upper, 2].mean() < V[~is_upper, 2].mean():
        is_upper = ~is_upper
    key.points.foreach_set("co", (V + np.where(is_upper, 1.0, 0.0)[:, None] * [0, 0, 1]).ravel())
    cubify(result="MESH", refine="OFF")
    bake()
    keys = bpy.context.object.data.shape_keys.key_blocks
    rest, opened = (key_points(keys[name]) for name in ("Basis", "Open"))
    lifted = (opened - rest)[:, 2]
    assert sorted(np.round(lifted).tolist()) == [0.0] * 8 + [1.0] * 8
    assert rest[lifted > 0.5, 2].mean() == pytest.approx(0.5 + rest[:, 2].mean(), abs=0.05)


def test_the_file_lies_beside_the_blend_file(tmp_path, reopen):
    add_rough()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    taken = tmp_path / "Suzanne_Normal.png"
    taken.write_bytes(b"of the artist")
    bake()
    assert taken.read_bytes() == b"of the artist"
    image = bpy.data.images["Suzanne Normal"]
    assert image.filepath == "//Suzanne_Normal_2.png" and image.packed_file is None
    values = pixels(image)
    reopen("Suzanne Low")
    image = bpy.data.images["Suzanne Normal"]
    assert image.colorspace_settings.name == "Non-Color"
    np.testing.assert_allclose(pixels(image), values, atol=1e-3)


def test_refusals():
    obj = add_monkey()
    with pytest.raises(RuntimeError, match="cubify it first"):
        bake()
    cubify()
    with edit_mode(obj), pytest.raises(RuntimeError, match="Switch to Object Mode"):
        bake()
    with edit_mode(obj) as edited:
        for vertex in list(edited.verts):
            edited.verts.remove(vertex)
    with pytest.raises(RuntimeError, match="has fewer than 3 vertices"):
        bake()


def test_without_cycles(part, monkeypatch):
    add_ball()
    cubify()
    bpy.ops.preferences.addon_disable(module="cycles")
    try:
        with pytest.raises(RuntimeError, match="enable the add-on Cycles"):
            bake()
    finally:
        bpy.ops.preferences.addon_enable(module="cycles")


@pytest.mark.parametrize(
    "place", ["low_poly.choose_uv", "normal_map.bake_normals", "normal_map._keep"]
)
def test_a_failure_leaves_nothing(part, monkeypatch, place):
    def fail(*_):
        raise ValueError("no luck")

    obj = add_rough()
    module, name = place.split(".")
    monkeypatch.setattr(part(f"send.{module}"), name, fail)
    kinds = ("scenes", "objects", "meshes", "images", "materials")
    before = snapshot_object(obj), [len(getattr(bpy.data, kind)) for kind in kinds]
    with pytest.raises(RuntimeError, match="Nothing has changed: no luck"):
        bake()
    assert differences(before[0], snapshot_object(obj)) == []
    assert [len(getattr(bpy.data, kind)) for kind in kinds] == before[1]
    assert bpy.context.object == obj and obj.select_get() and not obj.hide_get()

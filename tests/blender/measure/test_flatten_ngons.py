# SPDX-License-Identifier: GPL-3.0-or-later
"""Flatten Facets to n-gons: a new object with one face per side, and what the artist has set."""

import bpy
import numpy as np
import pytest
from flat_balls import PLANAR, add_ball, flatten, planar_share
from rich_mesh import position_of
from scene import add_monkey, cubify, select


def uvs_of(mesh):
    """Return the UVs of all corners, as a set."""
    return {tuple(corner.uv) for corner in mesh.uv_layers.active.data}


def largest(mesh, share=0.05):
    """Return the faces with at least a share of the surface."""
    area = sum(face.area for face in mesh.polygons)
    return [face for face in mesh.polygons if face.area > share * area]


def test_facets_become_ngons_with_their_uvs():
    obj = add_ball()
    group = obj.vertex_groups.new(name="All")
    group.add(range(len(obj.data.vertices)), 0.5, "REPLACE")
    obj.modifiers.new("Bevel", "BEVEL")
    cubify(refine="AUTO")
    faces = len(obj.data.polygons)
    assert flatten(dissolve=True) == {"FINISHED"}
    made = bpy.context.object
    assert made.name == "Ball Facets" and made.select_get() and not obj.select_get()
    assert len(obj.data.polygons) == faces and planar_share(obj) > PLANAR
    assert bpy.context.selected_objects == [made] and made.users_collection == obj.users_collection
    large = largest(made.data)
    assert len(large) == 6 and len(made.data.polygons) < 0.3 * faces
    assert len(uvs_of(made.data)) > 10 and uvs_of(made.data) <= uvs_of(obj.data)
    assert not any(face.use_smooth for face in made.data.polygons)
    # nothing of the shape is lost: the same sides, of about the same size
    area = sum(face.area for face in made.data.polygons)
    assert area == pytest.approx(sum(face.area for face in obj.data.polygons), rel=0.03)
    for face in large:
        V = position_of(made.data)[list(face.vertices)]
        assert np.ptp(V @ np.round(face.normal)) < 1e-6
    assert made.modifiers["Bevel"] and made.data.vertices[0].groups[0].weight == 0.5
    # it is a mesh like any other, and the source still has its original
    assert not [a.name for a in made.data.attributes if a.name.startswith("cubic_craft")]
    assert "cubic_craft_note" not in made.data and made.cubic_craft.status == ""
    assert obj.hide_get() and bpy.ops.cubic_craft.show_source() == {"FINISHED"}
    select(obj)
    assert bpy.ops.cubic_craft.restore.poll()


@pytest.mark.thorough(2)
@pytest.mark.parametrize("border", ["seam", "sharp", "material", "uv"])
def test_ngons_end_at_the_borders_of_the_artist(border):
    obj = add_ball()
    cubify(refine="AUTO")
    mesh = obj.data
    flatten()
    is_half = np.array([face.center.x > 0 for face in mesh.polygons])
    if border == "material":
        for name in ("One", "Two"):
            mesh.materials.append(bpy.data.materials.new(name))
        mesh.polygons.foreach_set("material_index", is_half.astype(np.int32))
    elif border == "uv":
        for face in np.flatnonzero(is_half):
            for corner in mesh.polygons[face].loop_indices:
                mesh.uv_layers.active.data[corner].uv.x += 2.0
    else:
        V = position_of(mesh)
        for edge in mesh.edges:
            if np.abs(V[list(edge.vertices), 0]).max() < 0.01:
                setattr(edge, "use_seam" if border == "seam" else "use_edge_sharp", True)
    mesh.update()
    flatten(dissolve=True)
    made = bpy.context.object.data
    large = largest(made, 0.03)
    assert len(large) == 10  # two halves of each side but those at the ends
    V = position_of(made)
    for face in large:
        x = V[list(face.vertices), 0]
        assert x.min() > -0.01 or x.max() < 0.01


def test_uvs_do_not_bridge_a_seam_that_ends_on_a_side(part):
    add_monkey()  # two ends of the UV map of its head meet at its back
    bpy.context.object.modifiers.new("Subdivision", "SUBSURF").levels = 1
    bpy.ops.object.modifier_apply(modifier="Subdivision")
    cubify()
    flatten(dissolve=True)
    mesh = bpy.context.object.data
    mesh.calc_loop_triangles()
    uv = np.array([corner.uv for corner in mesh.uv_layers.active.data])
    corners = np.array([triangle.loops for triangle in mesh.loop_triangles])
    assert part("send.uv_overlap").overlap(uv[corners]) < 0.01


def test_ngons_keep_shape_keys_with_their_settings_and_drivers():
    obj = add_ball()
    obj.shape_key_add(name="Basis", from_mix=False)
    V = position_of(obj.data)
    smile, wide = (obj.shape_key_add(name=name, from_mix=False) for name in ("Smile", "Wide"))
    wide.relative_key, wide.slider_max, smile.value = smile, 2.0, 0.5
    up = np.where(V[:, 2:] > 0.3, [0.0, 0.0, 0.5], 0.0)
    smile.points.foreach_set("co", (V + up).astype(np.float32).ravel())
    wide.points.foreach_set("co", (V + up + [0.25, 0.0, 0.0]).astype(np.float32).ravel())
    wide.driver_add("value").driver.expression = "1.5"
    cubify(result="MESH", refine="OFF")
    flatten(dissolve=True)
    made = bpy.context.object
    keys = made.data.shape_keys.key_blocks
    assert keys.keys() == ["Basis", "Smile", "Wide"] and keys["Wide"].relative_key == keys["Smile"]
    assert keys["Wide"].slider_max == 2.0 and keys["Smile"].value == 0.5
    assert [d.data_path for d in made.data.shape_keys.animation_data.drivers] == [
        'key_blocks["Wide"].value'
    ]
    z = position_of(made.data)[:, 2]
    lifted = np.linalg.norm(offsets_of(keys["Smile"])[z > 0.6], axis=1)
    assert np.median(lifted) == pytest.approx(0.5, abs=5e-3) and lifted.min() > 0.4
    assert (offsets_of(keys["Smile"])[z < -0.2] == 0.0).all()
    lengths = np.linalg.norm(offsets_of(keys["Wide"]), axis=1)
    np.testing.assert_allclose(lengths, 0.25, atol=0.04)  # turned, each as its place


def offsets_of(key):
    ends = [np.array([point.co for point in of.points]) for of in (key, key.relative_key)]
    return ends[0] - ends[1]


@pytest.mark.parametrize(
    ("edges", "layer"), [("NONE", None), ("CREASES", "crease_edge"), ("BEVEL", "bevel_weight_edge")]
)
def test_a_crisp_ball_becomes_a_box_with_weights_at_its_edges(edges, layer):
    obj = add_ball()
    cubify(crispness=1.0, detail_strength=0.0, cubeness=1.0, refine="OFF")
    obj.data.shade_smooth()
    assert flatten(dissolve=True, edges=edges, tolerance=0.05) == {"FINISHED"}
    made = bpy.context.object.data
    assert len(made.polygons) < 40 and not any(face.use_smooth for face in made.polygons)
    assert max(len(face.vertices) for face in made.polygons) <= 64
    found = {name for name in ("crease_edge", "bevel_weight_edge") if name in made.attributes}
    assert found == ({layer} if layer else set())
    if layer:
        weights = made.attributes[layer].data
        faces = {edge.index: [] for edge in made.edges}
        for face in made.polygons:
            for corner in face.loop_indices:
                faces[made.loops[corner].edge_index].append(np.array(face.normal))
        for edge, (one, other) in faces.items():
            assert weights[edge].value == (one @ other < np.cos(np.radians(10.0)))

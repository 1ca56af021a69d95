# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen is taken with ``--with-modifiers``: modifiers applied, texts as meshes."""

import json

import numpy as np
import pytest
from headless import headless_ok, headless_shared, make_blend, run_to_blend

MAKE = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_cube_add()
bpy.context.object.modifiers.new("Subdivision", "SUBSURF").levels = 3
bpy.ops.mesh.primitive_monkey_add(location=(4, 0, 0))
bpy.context.object.parent = bpy.data.objects["Cube"]
bpy.ops.object.text_add(location=(0, 3, 0))
bpy.context.object.data.extrude = 0.1
bpy.ops.mesh.primitive_uv_sphere_add()
bpy.context.object.name = "Cutter"
bpy.context.object.hide_render = True
cut = bpy.data.objects["Suzanne"].modifiers.new("Cut", "BOOLEAN")
cut.object, cut.show_viewport = bpy.context.object, False
bpy.ops.mesh.primitive_uv_sphere_add()
bpy.context.object.name = "In Tools"
tools = bpy.data.collections.new("Tools")
tools.hide_render = True
bpy.context.scene.collection.children.link(tools)
bpy.context.collection.objects.unlink(bpy.context.object)
tools.objects.link(bpy.data.objects["In Tools"])
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""
FAST = ("--device", "numpy", "--max-iterations", 20, "--together", "parts")


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    return make_blend(MAKE, tmp_path_factory.mktemp("seen") / "seen.blend")


def test_what_is_seen_is_taken_in_place_of_the_meshes(source, tmp_path):
    report, found = run_to_blend(source, tmp_path, *FAST, "--with-modifiers")
    assert report["settings"]["with_modifiers"] is True
    counts = {entry["name"]: entry["vertices"] for entry in report["objects"]}
    assert set(counts) == {"Cube", "Suzanne", "Text"}
    assert counts["Cube"] == 386 and counts["Suzanne"] == 507 and counts["Text"] > 20
    ball = np.asarray(found["Cube"][0])
    assert len(ball) == 386
    sizes = np.abs(ball).max(axis=1)  # of a ball from 0.58 to 1, of a cube all alike
    assert sizes.min() > 0.8 * sizes.max(), "the ball has not become cubic"


def test_without_it_the_meshes_below_are_taken_and_what_is_not_rendered_is_left_out(
    source, tmp_path
):
    """As what a Boolean modifier cuts with, which the report of the test above lacks, too."""
    done = headless_ok(source, *FAST, "--no-render", "--report", "report.json", cwd=tmp_path)
    report = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    counts = {entry["name"]: entry["vertices"] for entry in report["objects"]}
    assert counts == {"Cube": 8, "Suzanne": 507}
    for name in ("Cutter", "In Tools"):
        assert f'"{name}" is left out: it is hidden, is not rendered or has no faces' in done.stderr


FASTEST = ("--device", "numpy", "--max-iterations", 3, "--keep-apart", "off", "--refine", "off")
COVERED = """
import sys, bpy
import numpy as np
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_monkey_add()
obj, points = bpy.context.object, np.empty(3 * 507, np.float32)
obj.data.attributes["position"].data.foreach_get("vector", points)
if "played" in sys.argv[1]:
    head = b"POINTCACHE2\\0" + np.array([1, 507], "<i4").tobytes()
    head += np.array([0, 1], "<f4").tobytes() + np.array([1], "<i4").tobytes()
    open(sys.argv[1] + ".pc2", "wb").write(head + points.tobytes())
    cache = obj.modifiers.new("Cache", "MESH_CACHE")
    cache.cache_format, cache.filepath = "PC2", sys.argv[1] + ".pc2"
else:
    obj.data.attributes.new("was", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", points)
    tree = bpy.data.node_groups.new("Was", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    begin, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    put = tree.nodes.new("GeometryNodeSetPosition")
    named = tree.nodes.new("GeometryNodeInputNamedAttribute")
    named.data_type, named.inputs["Name"].default_value = "FLOAT_VECTOR", "was"
    tree.links.new(begin.outputs[0], put.inputs["Geometry"])
    tree.links.new(named.outputs["Attribute"], put.inputs["Position"])
    tree.links.new(put.outputs[0], end.inputs[0])
    obj.modifiers.new("Was", "NODES").node_group = tree
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""


def test_of_what_a_cache_plays_the_seen_shape_is_taken(tmp_path):
    source = make_blend(COVERED, tmp_path / "played.blend")
    done = headless_shared(
        source, *FASTEST, "--no-render", "--save-mesh", "out.blend", cwd=tmp_path
    )
    assert done.returncode == 0 and '"Suzanne": what is seen is taken' in done.stdout + done.stderr


def test_no_picture_of_the_original_is_passed_off_as_a_result(tmp_path):
    source = make_blend(COVERED, tmp_path / "nodes.blend")
    refused = headless_shared(source, *FASTEST, "--output", "p.png", cwd=tmp_path)
    assert refused.returncode == 2 and not (tmp_path / "p.png").exists()
    line = refused.stderr.splitlines()[-1]
    assert '"Suzanne": one of its modifiers' in line and "--with-modifiers" in line
